"""`lineseg view`: serves the page."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from tyro.conf import OmitArgPrefixes, Positional, arg

from lineseg.readers import Reading

from ..bridges.address import Address, is_address
from .flag_types import Several, Switch, Unset, lessons_folder
from .reading import ReadingFlags, files_of, reading_of
from .sources import address_of, list_topics
from .token import token_of

if TYPE_CHECKING:
    from ..server import Settings
    from ..session.shown import Watch


def view(
    sources: Positional[Annotated[Several[str], arg(metavar="[FILE ...]")]] = (),
    *,
    reading: OmitArgPrefixes[ReadingFlags],  # type: ignore[valid-type]
    lessons: Unset[Path] = None,
    keep: int = 3000,
    host: Annotated[str, arg(metavar="ADDRESS")] = "127.0.0.1",
    port: int = 8765,
    token: Annotated[Unset[str], arg(metavar="TEXT")] = None,
    token_file: Unset[Path] = None,
    no_browser: Switch = False,
    robot: Annotated[Several[str], arg(metavar="ADDRESS ...")] = (),
    allow_embedding: Annotated[Several[str], arg(metavar="ORIGIN ...")] = (),
    rerun: Switch = False,
) -> None:
    """Show the page in the browser.

    Args:
        sources: recordings to open: bags, logs, arrays, tables or other text, also compressed (default: the samples).
            Or, to watch lasers live, their addresses: ws://robot:9090 (rosbridge), ws://robot:8765
            (Foxglove), each with #/TOPIC if it has several lasers, ros2:/scan or ros2://DOMAIN/scan (DDS; ros2: lists
            the topics), zenoh:/scan or zenoh://router:7447/scan (Zenoh).
        reading: how to read the files; of a robot, only the topic can be chosen.
        lessons: folder of lessons to offer besides those of the program; sample_scans/lessons/README.md tells how to
            write one. What is wrong with a file there is said in this terminal.
        keep: number of scans to keep of each laser; older ones are dropped.
        host: address to listen on; any but the loopback requires a token.
        port: TCP port; 0 picks a free one.
        token: password that browsers must send (default: the environment variable LINESEG_TOKEN, or a random one where
            the page needs one). Other users of this machine see it in the list of processes; prefer --token-file.
        token_file: file that holds the token.
        no_browser: do not open a browser.
        robot: addresses to which the page may send parameters, besides the robot that is watched and the nodes of this
            machine: of rosbridge, or of a `lineseg node`, as it prints it, whose token is in LINESEG_NODE_TOKEN.
        allow_embedding: sites whose pages may show this page in a frame, such as https://course.example.org. Where the
            page needs a token, these must be of the same site, or the browser keeps the token back.
        rerun: also stream the view to rerun's viewer on port 9876; starts the viewer if none is running.
    """
    how = reading_of(reading)
    robots = _robots(sources, how)
    if any(list_topics(laser) for laser in robots):
        return
    files, how = _files(sources, how)
    from ..server import Settings

    settings = Settings(
        files=files,
        reading=how,
        robots=robots,
        lessons=lessons_folder(lessons),
        may_send=robot,
        keep=keep,
        host=host,
        port=port,
        token=token_of(token, token_file),
        open_browser=not no_browser,
        embedders=allow_embedding,
    )
    _serve(settings, rerun)


def _serve(settings: Settings, rerun: bool) -> None:
    """Serve until interrupted; rerun: also stream the view to rerun's viewer."""
    from ..server import serve

    with _streaming(rerun) as watch:
        serve(
            replace(settings, watch=watch),
            lambda address: print(f"lineseg is at {address} (Ctrl-C stops it)", flush=True),
        )


@contextlib.contextmanager
def _streaming(rerun: bool) -> Iterator[Watch | None]:
    """What is told of all that is shown, if rerun's viewer is to show it."""
    if not rerun:
        yield None
        return
    from ..rerun.live import live_rerun

    with live_rerun() as stream:
        yield stream.show


def _files(sources: Sequence[str], how: Reading) -> tuple[tuple[Path, ...], Reading]:
    """The files among the sources, and how they are read."""
    named = [source for source in sources if not is_address(source)]
    if not named:
        return (), Reading()
    files = tuple(file.resolve() for file in files_of(named))
    return files, _beside(how, files)


def _beside(how: Reading, files: Sequence[Path]) -> Reading:
    """The Reading, whose trajectory the page knows by its name alone."""
    if how.poses is None or not set(how.poses) & {"/", "\\", ":"}:
        return how
    poses = Path(how.poses).resolve()
    if elsewhere := next((file.parent for file in files if file.parent != poses.parent), None):
        raise ValueError(f"--poses is {how.poses}; the page reads it beside the recording: put it into {elsewhere}.")
    return how.but(poses=poses.name)


def _robots(sources: Sequence[str], how: Reading) -> tuple[Address, ...]:
    """The addresses among the sources. Raises ValueError for a Reading that only files can have."""
    addresses = [source for source in sources if is_address(source)]
    if addresses and (others := [name for name in how.given() if name != "topic"]):
        raise ValueError(f"{', '.join(others)} cannot be used with a robot, which says how its scans are to be read.")
    return tuple(address_of(address, how.topic) for address in dict.fromkeys(addresses))
