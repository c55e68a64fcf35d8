"""Sends to the robot on request: segments of the live scans, and thresholds as parameters of a node."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Annotated, Any, Literal

from fastapi import FastAPI
from pydantic import BaseModel, ConfigDict, Field
from starlette.exceptions import HTTPException

from lineseg import Params

from ..bounds import Name, Number
from ..live.address import place_of
from ..live.node_params import Sent, send_params
from ..live.source import Publishing
from ..session.sessions import Sessions
from ..shelf.library import Library
from ..told.answers import Robots
from .slow import SlowWork

AT_ONCE, SECONDS = 4, 20.0
ROS_NAME = re.compile(r"/?[A-Za-z_~][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*")


class Asked(BaseModel):
    """Refuses unknown fields."""

    model_config = ConfigDict(extra="forbid", strict=True)


class PublishAsked(Asked):
    session: Name
    on: bool
    topic: Name = "/lineseg/segments"


class SendAsked(Asked):
    """The node to send to; extensions: include thresholds that the authors' program does not have."""

    address: Name
    node: Name
    ros: Literal[1, 2] = 2
    extensions: bool = False
    params: Annotated[dict[Name, int | Number], Field(max_length=64)] = {}


def add_back(app: FastAPI, library: Library, sessions: Sessions, named: Sequence[str]) -> None:
    """Routes of /api/robot. named: the addresses that may be reached, and no others."""
    sending = SlowWork("robots", AT_ONCE, SECONDS)

    @app.get("/api/robot")
    async def robots() -> Robots:
        return {"addresses": list(named)}

    @app.post("/api/robot/segments")
    async def publish(asked: PublishAsked) -> dict[str, Any]:
        session = sessions.get(asked.session)
        if session is None:
            raise HTTPException(404, "the server no longer knows this tab; reload the page")
        view = session.view
        source = library.live.get(view.recording)
        if source is None:
            raise HTTPException(400, "segments can only be published for a live source; open a robot first")
        try:
            topic = ros_name("topic", asked.topic)
            source.publish(session.id, Publishing(session.id, topic, view.method, view.params) if asked.on else None)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        return {"topic": topic, "on": asked.on}

    @app.post("/api/robot/params")
    async def params(asked: SendAsked) -> dict[str, list[Sent]]:
        try:
            node = ros_name("node", asked.node)
            params = Params().but(**asked.params)
            address = _named(asked.address, named)
            sent = await sending.run(send_params, address, node, params, asked.ros, asked.extensions)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        except OSError as error:
            raise HTTPException(502, str(error)) from None
        return {"sent": sent}


def _named(address: str, named: Sequence[str]) -> str:
    """The named address that means the same. Answers 403 if there is none."""
    place = place_of(address)
    found = next((url for url in named if place_of(url) == place), None)
    if found is None:
        raise HTTPException(
            403, f"{address} was not named when lineseg was started; start it with --robot {address} to send there"
        )
    return found


def ros_name(what: str, name: str) -> str:
    """Checks for an absolute ROS name."""
    if not ROS_NAME.fullmatch(name):
        raise ValueError(f"{what} is {name[:80]!r}; give an absolute ROS name such as /line_extraction")
    return "/" + name.lstrip("/")
