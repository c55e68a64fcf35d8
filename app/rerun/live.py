"""Streams the view of a session live to rerun's viewer."""

from __future__ import annotations

import contextlib
import logging
import select
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from uuid import uuid4

import numpy as np
import rerun as rr

from lineseg import Recording
from lineseg.rerun import dropped_strips, hue_of_beams, hues_of, raised, segment_strips
from lineseg.unfinished import held_folder

from ..frame.findings import Findings
from ..scene.replay import state_at
from ..view import View
from .layout import announce, parameters
from .record import seed_beams
from .viewer import executable, quiet_environment

log = logging.getLogger(__name__)
PORT = 9876
PROBE_SECONDS = 0.5
# A viewer that starts, or draws a large recording, takes nothing for a while.
SEND_SECONDS = 5.0
START_SECONDS = 20.0
CLOSE_SECONDS = 2.0


class LiveRerun:
    """Streams to the viewer on `port` of this machine, in its own thread, so no tab waits for the viewer.

    Without a viewer, frames are dropped. A new viewer gets the static part and the present frame. Timelines: `frame`,
    and `shown`, the time at which the frame was on the screen.
    """

    def __init__(self, port: int = PORT) -> None:
        self._port = port
        self._id = uuid4()
        self._changed = threading.Condition()
        self._waiting: tuple[View, Recording, str, Findings] | None = None
        self._closing = False
        self._line: socket.socket | None = None
        self._stream: rr.RecordingStream | None = None
        self._announced: object = None
        self._thread = threading.Thread(target=self._work, name="live rerun", daemon=True)
        self._thread.start()

    def show(self, view: View, recording: Recording, label: str, found: Findings) -> None:
        """Stream this; replaces an older one that is still waiting."""
        with self._changed:
            self._waiting = view, recording, label, found
            self._changed.notify_all()

    def close(self) -> None:
        with self._changed:
            self._closing = True
            self._changed.notify_all()
        self._thread.join(timeout=10)

    def _work(self) -> None:
        last = None
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closing or self._waiting is not None, timeout=PROBE_SECONDS)
                if self._closing:
                    break
                shown, self._waiting = self._waiting, None
            try:
                returned = self._connected()
                last = shown or last
                if last is not None and self._stream is not None and (shown is not None or returned):
                    self._send(*last)
            except Exception as error:
                # Until it hangs up: each attempt would leave a thread that waits for it.
                log.warning("rerun's viewer on port %d does not take what it is sent: %s", self._port, error)
                self._end_stream()
        self._hang_up()

    def _connected(self) -> bool:
        """Whether a viewer has connected since the last call; opens a stream if a viewer is running."""
        if self._line is not None and not _hung_up(self._line):
            return False
        self._hang_up()
        with contextlib.suppress(OSError):
            # Our own connection to the viewer: rerun's SDK does not report when the viewer closes.
            self._line = socket.create_connection(("127.0.0.1", self._port), timeout=PROBE_SECONDS)
        if self._line is None:
            return False
        self._stream = rr.RecordingStream("lineseg", recording_id=self._id)
        self._stream.connect_grpc(f"rerun+http://127.0.0.1:{self._port}/proxy")
        return True

    def _hang_up(self) -> None:
        self._end_stream()
        if self._line is not None:
            self._line.close()
        self._line = None

    def _end_stream(self) -> None:
        stream, self._stream, self._announced = self._stream, None, None
        if stream is not None:
            # Closing waits for a viewer that is gone or hangs, also at the end of the process.
            closing = threading.Thread(target=stream.disconnect, daemon=True)
            closing.start()
            closing.join(CLOSE_SECONDS)
            if closing.is_alive():
                rr.unregister_shutdown()

    def _send(self, view: View, recording: Recording, label: str, found: Findings) -> None:
        stream, scan = self._stream, found.scan
        assert stream is not None
        subject = view.recording, view.topic
        if self._announced != subject:
            self._announced = subject
            announce(stream, recording, label, view.method, view.params, range(len(recording)))
        stream.set_time("frame", sequence=view.frame)
        stream.set_time("shown", timestamp=time.time())
        hues = hue_of_beams(found.extraction)[scan.valid]
        stream.log("laser/points", rr.Points3D.from_fields(positions=raised(scan.xy[scan.valid]), class_ids=hues))
        ends, classes = segment_strips(found.extraction.segments), hues_of(found.extraction)
        stream.log("laser/segments", rr.LineStrips3D.from_fields(strips=ends, class_ids=classes))
        dropped = dropped_strips(scan, found.extraction.dropped)
        stream.log("laser/dropped", rr.LineStrips3D.from_fields(strips=dropped))
        seeds = raised(scan.xy[seed_beams(found.trace)])
        stream.log("laser/seeds", rr.Points3D.from_fields(positions=seeds))
        stream.log("parameters", parameters(label, view.method, view.params))
        for name, value in self._numbers(found).items():
            stream.log(f"scores/{name}", rr.Scalars(value))
        self._send_step(stream, view, found)
        stream.flush(timeout_sec=SEND_SECONDS)

    def _numbers(self, found: Findings) -> dict[str, float]:
        covered = found.extraction.covered / max(int(found.scan.valid.sum()), 1)
        return {"segments": float(len(found.extraction.segments)), "coverage": covered}

    def _send_step(self, stream: rr.RecordingStream, view: View, found: Findings) -> None:
        """The decision on the screen and the lines after it; empty if the whole result is shown."""
        ends = np.empty((0, 2, 2))
        if view.step is not None:
            decision = found.trace[view.step]
            stream.log("decisions", rr.TextLog(decision.text, level="INFO"))
            state = state_at(found, view.step)
            ends = np.stack((state.starts, state.ends), axis=1)
        stream.log("laser/replay/lines", rr.LineStrips3D.from_fields(strips=raised(ends)))


def _hung_up(line: socket.socket) -> bool:
    """Whether the other end has closed; ignores anything it sent."""
    while select.select([line], [], [], 0)[0]:
        try:
            if not line.recv(4096):
                return True
        except OSError:
            return True
    return False


@contextlib.contextmanager
def live_rerun(port: int = PORT) -> Iterator[LiveRerun]:
    """A stream to the viewer on `port`. Starts a viewer if none is running; it stays open when we exit."""
    if not answers(port):
        start_viewer(port)
    live = LiveRerun(port)
    try:
        yield live
    finally:
        live.close()


def start_viewer(port: int) -> None:
    """Start rerun's native viewer, on the loopback only. Raises OSError if it does not start."""
    folder, lock = held_folder()
    # The viewer, which outlives this process, holds the lock of its settings: once it ends they are left, and removed.
    with lock:
        flags = ["--bind", "127.0.0.1", "--port", str(port), "--expect-data-soon"]
        silent, environment = subprocess.DEVNULL, quiet_environment(folder)
        held = [] if sys.platform == "win32" else [lock.fileno()]
        program = subprocess.Popen(
            [executable(), *flags],
            env=environment,
            stdout=silent,
            stderr=silent,
            start_new_session=True,
            pass_fds=held,
        )
    late = time.monotonic() + START_SECONDS
    while not answers(port):
        if program.poll() is not None or time.monotonic() > late:
            raise OSError(
                "rerun's viewer does not start, perhaps because there is no display; start `rerun --bind 127.0.0.1` "
                "yourself, or record a file with `lineseg record`"
            )
        time.sleep(0.1)


def answers(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0
