"""Reads the file of a tab in a thread of its own: its first scans are shown while the rest is read."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial

from lineseg import Recording
from lineseg.failing import mistake
from lineseg.readers import Cancelled, Notice
from lineseg.readers.account import Findings

from ..newest import Newest
from ..shelf.library import Library
from ..told.messages import Loading
from ..view import View
from .loading import is_file, opened

POLL = 0.05
log = logging.getLogger(__name__)
Tell = Callable[[Loading], None]


class _File:
    """A file on its way: what was read of it, now or before, and how it ended."""

    def __init__(self, view: View, before: Recording | None) -> None:
        self.view = view
        self.recording = before
        self.error: BaseException | None = None
        self.ended = self.stopped = self.cut = False

    def enough_for(self, view: View) -> bool:
        """Whether the frame of a View was read, or no more will be."""
        part = self.recording
        return self.ended or (part is not None and view.frame <= part.number(len(part) - 1))


class ReadingOn:
    """name: of the thread. tell: hears how far it is. grown: called in the thread when there is more to show, or when
    the rest cannot be read. Both may block.
    """

    def __init__(self, name: str, library: Library, tell: Tell, grown: Callable[[], None]) -> None:
        self._library, self._tell, self._grown = library, tell, grown
        self._changed = threading.Condition()
        self._file: _File | None = None
        self._thread = Newest(name, self._read)

    def recording(self, view: View, wanted: Callable[[], bool], before: Recording | None = None) -> Recording:
        """The recording of a View, or its first scans, if the View's frame is one of them; waits for them.

        before: what was read of the file before it was left, which is shown until there is more. Raises Cancelled once
        it is not `wanted`, and what `opened` raises.
        """
        file = self._begun(view, before)
        if file is None:
            return opened(self._library, view, self._tell, wanted)
        while not file.enough_for(view):
            if not wanted():
                self._leave()
                raise Cancelled
            with self._changed:
                self._changed.wait_for(lambda: file.enough_for(view), POLL)
        if file.ended and not file.cut:
            # The library is asked again when something changes. Not now: a file that another program is writing, or has
            # deleted, would be read again and again.
            self._leave()
        if file.recording is None:
            assert file.error is not None
            raise file.error
        return file.recording

    def newer(self, shown: Recording) -> bool:
        """Whether there is more than this, which was shown of the file that was read last."""
        file = self._file
        return file is None or file.recording is not shown

    def stop(self) -> bool:
        """Read no further, and keep what was read. Returns whether something is shown of a file that is being read."""
        with self._changed:
            file = self._file
            if file is None or file.ended or file.recording is None:
                return False
            file.stopped = True
            return True

    def forget(self) -> None:
        """Read what was left of a file when it is next asked for."""
        with self._changed:
            if self._file is not None and self._file.ended:
                self._file = None

    def close(self) -> None:
        self._leave()
        self._thread.close()

    def _leave(self) -> None:
        with self._changed:
            self._file = None

    def _begun(self, view: View, before: Recording | None) -> _File | None:
        """The file of a View on its way; None if it is open already, or if there is no file. Others are left."""
        with self._changed:
            if self._file is not None and self._file.view.place == view.place:
                return self._file
            self._file = None
            if not is_file(view) or self._library.open_already(view.recording, view.read_as) is not None:
                return None
            self._file = _File(view, before)
            self._thread.put(self._file)
            return self._file

    def _read(self, file: _File) -> None:
        def wanted() -> bool:
            return self._file is file and not file.stopped

        def show(part: Recording) -> None:
            with self._changed:
                if file.recording is not None and len(part) < len(file.recording):
                    return
                file.recording = part
                self._changed.notify_all()
            self._grown()

        def tell(loading: Loading) -> None:
            if wanted():
                self._tell(loading.model_copy(update={"behind": file.recording is not None}))

        recording = error = None
        try:
            recording = opened(self._library, file.view, tell, wanted, show)
        except (Cancelled, ValueError, OSError) as raised:
            error = raised
        except Exception as raised:
            log.exception("reading %s failed", file.view.recording)
            error = ValueError(mistake(raised))
        with self._changed:
            if recording is None and file.recording is not None:
                file.cut = True
                recording = _cut_short(file.recording, None if file.stopped else str(error))
            file.recording, file.error, file.ended = recording, error, True
            waited = self._file is file
            self._changed.notify_all()
        if waited:
            self._grown()


def _cut_short(part: Recording, why: str | None) -> Recording:
    """What was read of a file, with a notice that it is not all."""
    account = part.account
    if account is not None:
        reason = "you stopped it" if why is None else why.rstrip(".")
        said = f"Only the first {len(part):,} scans were read: {reason}. Reload the page to read all."
        account = replace(account, find=partial(_noticed, account.findings, Notice("not all", said)))
    return replace(part, partial=False, account=account)


def _noticed(findings: Findings, notice: Notice) -> Findings:
    return findings._replace(notices=(notice, *findings.notices))
