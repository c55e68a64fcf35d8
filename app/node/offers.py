"""The nodes of this user that run on this machine, and thresholds sent to one of these or of another machine."""

from __future__ import annotations

import contextlib
import http.client
import json
import os
import re
import socket
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from urllib.parse import urlsplit

from pydantic import BaseModel, ConfigDict, ValidationError

from lineseg.unfinished import is_old

from ..bounds import Name, Values

FOLDER, PATH = "nodes", "/api/node"
TOKEN = "LINESEG_NODE_TOKEN"
ADDRESS = re.compile(r"http://([A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\]):[0-9]{1,5}/?")
FOUND_SECONDS = 0.2
# A method that the node has not run before may have to be compiled.
SEND_SECONDS = 90.0
LARGEST_ANSWER = 64 * 1024
MOST_OFFERS = 64


class Strict(BaseModel):
    """Refuses unknown fields and other types."""

    model_config = ConfigDict(extra="forbid", strict=True)


class Offer(Strict):
    """A running node: where it takes thresholds, with which token, and the laser whose scans it reads."""

    address: Name
    token: Name
    source: Name


class PutAsked(Strict):
    """Thresholds for a node."""

    method: Name
    params: Values


class NodeState(Strict):
    """What a node runs."""

    source: str
    method: str
    params: dict[str, int | float]


def is_node(address: str) -> bool:
    """Whether this is the address of a node, as it prints it."""
    return ADDRESS.fullmatch(address) is not None


def running_nodes(folder: Path) -> list[Offer]:
    """The nodes announced in the folder of the user's data. What a killed node left is removed."""
    found = []
    for file in sorted((folder / FOLDER).glob("*.json"))[:MOST_OFFERS]:
        with contextlib.suppress(OSError):
            try:
                offer = Offer.model_validate_json(file.read_text(encoding="utf-8"))
            except (ValidationError, UnicodeDecodeError):
                offer = None
            if offer is not None and is_node(offer.address) and _answers(offer.address):
                found.append(offer)
            elif offer is not None or is_old(file):
                # A new file may just be written.
                file.unlink()
    return found


def named_nodes(addresses: Sequence[str]) -> Iterator[Offer]:
    """The nodes of other machines that the user named; their token is in the environment."""
    for address in addresses:
        if is_node(address):
            yield Offer(address=address.rstrip("/"), token=os.environ.get(TOKEN, ""), source="")


def send_to_node(offer: Offer, method: str, params: dict[str, int | float]) -> NodeState:
    """What the node runs afterwards. Raises ValueError if it refuses, OSError if it does not answer."""
    headers = {"Authorization": f"Bearer {offer.token}", "Content-Type": "application/json"}
    try:
        with _connected(offer.address) as connection:
            connection.request("PUT", PATH, json.dumps({"method": method, "params": params}), headers)
            answer = connection.getresponse()
            text = answer.read(LARGEST_ANSWER)
    except (OSError, http.client.HTTPException) as error:
        raise OSError(
            f"{offer.address} does not answer ({error or type(error).__name__}); is the node running?"
        ) from None
    try:
        if answer.status == http.client.OK:
            return NodeState.model_validate_json(text)
        raise ValueError(f"{offer.address} says: {json.loads(text)['message']}{_token_hint(answer.status)}")
    except (ValidationError, json.JSONDecodeError, TypeError, KeyError):
        raise OSError(f"{offer.address} answers, but it is not a node of lineseg") from None


@contextlib.contextmanager
def _connected(address: str) -> Iterator[http.client.HTTPConnection]:
    """A connection that ends after SEND_SECONDS, whatever comes; its own time limit begins anew with each byte."""
    parts = urlsplit(address)
    connection = http.client.HTTPConnection(parts.hostname or "", parts.port or 80, timeout=SEND_SECONDS)
    connection.connect()
    giving_up = threading.Timer(SEND_SECONDS, _hang_up, (connection.sock,))
    giving_up.daemon = True
    giving_up.start()
    try:
        yield connection
    finally:
        giving_up.cancel()
        connection.close()


def _hang_up(connection: socket.socket) -> None:
    with contextlib.suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)


def _token_hint(status: int) -> str:
    return f"; give the node's token to this server as {TOKEN}" if status == http.client.FORBIDDEN else ""


def _answers(address: str) -> bool:
    parts = urlsplit(address)
    try:
        socket.create_connection((parts.hostname or "", parts.port or 80), FOUND_SECONDS).close()
    except OSError:
        return False
    return True
