"""Gives a recording without truth the walls that many of its scans agree on."""

from __future__ import annotations

from collections.abc import Callable

from ..scan import Recording
from .account import Notes

# The kind of the notice that says how the truth was made, and of the one that says not to trust it.
BY_VIEWS, DOUBTFUL = "truth by many views", "doubtful truth"


def with_walls(recording: Recording, notes: Notes, progress: Callable[[int, int], None]) -> Recording:
    """The recording with the truth by many views; one that has its truth keeps it.

    Raises ValueError, which says why, where no truth can be made.
    """
    from ..many_views import truth_by_many_views

    if recording.wall is not None:
        notes.notice(BY_VIEWS, f"{recording.name} has the true wall of each beam, which stays its truth.")
        return recording
    found = truth_by_many_views(recording, progress)
    notes.notice(BY_VIEWS if found.trusted else DOUBTFUL, f"Truth by many views: {found.text}")
    return found.recording


def with_walls_if_any(
    recording: Recording, progress: Callable[[int, int], None] | None = None
) -> tuple[Recording, str]:
    """The recording with the truth by many views if it has no other and this one is usable, and what to say of it.

    The second is why there is none where scans have poses; "" where nothing was tried, because there is a truth, there
    are no poses, or the Reading rules it out.
    """
    from ..many_views import truth_by_many_views

    if recording.wall is not None:
        return recording, recording.wall_source
    account = recording.account
    if (account is not None and account.given.walls is not None) or recording.poses is None:
        return recording, ""
    try:
        found = truth_by_many_views(recording, progress)
    except ValueError as error:
        return recording, str(error)
    if not found.usable:
        return recording, f"{found.text} --walls by-views takes it nevertheless."
    return found.recording, found.text
