"""Sends to the robot on request: segments of the live scans, and thresholds as parameters of a node."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

from fastapi import FastAPI
from pydantic import BaseModel, ConfigDict
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from lineseg import Params

from ..bounds import Name, Values
from ..bridges.address import place_of
from ..bridges.node_params import Sent, send_params
from ..live.source import Publishing
from ..node.offers import SEND_SECONDS, NodeState, Offer, is_node, named_nodes, running_nodes, send_to_node
from ..session.sessions import Sessions
from ..shelf.library import Library
from ..told.answers import Robots, RunningNode
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


class ToNodeAsked(Asked):
    """Thresholds for a node of lineseg."""

    address: Name
    method: Name = "region-growing"
    params: Values = {}


class SendAsked(Asked):
    """The node to send to; extensions: include thresholds that the authors' program does not have."""

    address: Name
    node: Name
    ros: Literal[1, 2] = 2
    extensions: bool = False
    params: Values = {}


def add_back(app: FastAPI, library: Library, sessions: Sessions, named: Sequence[str], folder: Path) -> None:
    """Routes of /api/robot. named: the addresses that may be reached, and no others; folder: of the user's data."""
    sending = SlowWork("robots", AT_ONCE, SECONDS)
    to_nodes = SlowWork("nodes", AT_ONCE, SEND_SECONDS)
    nodes = [each for each in named if is_node(each)]
    bridges = [each for each in named if not is_node(each)]

    def offers() -> list[Offer]:
        return [*named_nodes(nodes), *running_nodes(folder)]

    @app.get("/api/robot")
    async def robots() -> Robots:
        found = await run_in_threadpool(offers)
        return {
            "addresses": bridges,
            "nodes": [RunningNode(address=offer.address, source=offer.source) for offer in found],
        }

    @app.post("/api/robot/node")
    async def to_node(asked: ToNodeAsked) -> NodeState:
        offer = next((each for each in await run_in_threadpool(offers) if each.address == asked.address), None)
        if offer is None:
            raise HTTPException(404, f"no node runs at {asked.address}; start one, or choose another")
        try:
            return await to_nodes.run(send_to_node, offer, asked.method, dict(asked.params))
        except ValueError as error:
            raise HTTPException(400, str(error)) from None
        except OSError as error:
            raise HTTPException(502, str(error)) from None

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
            address = _named(asked.address, bridges)
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
