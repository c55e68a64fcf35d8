"""Sends to the robot on request: segments of the live scans, and thresholds as parameters of a node."""

from __future__ import annotations

import re
from typing import Annotated, Any, Literal

from fastapi import FastAPI
from pydantic import BaseModel, ConfigDict, Field
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from lineseg import Params

from ..bounds import Name, Number
from ..live.node_params import Sent, send_params
from ..live.source import Publishing
from ..session.sessions import Sessions
from ..shelf.library import Library

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


def add_back(app: FastAPI, library: Library, sessions: Sessions) -> None:
    """Routes of /api/robot."""

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
            topic = _ros_name("topic", asked.topic)
            source.publish(session.id, Publishing(session.id, topic, view.method, view.params) if asked.on else None)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        return {"topic": topic, "on": asked.on}

    @app.post("/api/robot/params")
    async def params(asked: SendAsked) -> dict[str, list[Sent]]:
        try:
            node = _ros_name("node", asked.node)
            params = Params().but(**asked.params)
            sent = await run_in_threadpool(send_params, asked.address, node, params, asked.ros, asked.extensions)
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        except OSError as error:
            raise HTTPException(502, str(error)) from None
        return {"sent": sent}


def _ros_name(what: str, name: str) -> str:
    """Checks for an absolute ROS name."""
    if not ROS_NAME.fullmatch(name):
        raise ValueError(f"{what} is {name[:80]!r}; give an absolute ROS name such as /line_extraction")
    return "/" + name.lstrip("/")
