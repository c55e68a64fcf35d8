"""The domain of DDS and how it is set up, from the variables of the environment that ROS 2 has for it."""

from __future__ import annotations

import os
import re
import socket
from collections.abc import Mapping
from functools import cache

from cyclonedds.core import DDSException
from cyclonedds.domain import Domain, DomainParticipant

from .address import domain_of
from .bridge import LARGEST_SAMPLE

RANGES = ("LOCALHOST", "SUBNET", "OFF", "SYSTEM_DEFAULT")
# Cyclone DDS announces itself to a peer for 30 s only; a robot may start later, and may listen to nothing else.
STEADY = "<SPDPInterval>1s</SPDPInterval><InitialLocatorPruneDelay>inf</InitialLocatorPruneDelay>"
# Every vendor but Cyclone DDS itself (1.16), which refuses definitions that others describe in other ways. The bytes of
# a ROS message do not depend on this.
OTHER_VENDORS = ",".join(f"1.{vendor}" for vendor in range(1, 33) if vendor != 16)
LENIENT = f"<Compatibility><IgnoreTypeInformation>{OTHER_VENDORS}</IgnoreTypeInformation></Compatibility>"
# Without a limit, Cyclone DDS takes samples of 2 GB.
SIZES = f"<Internal><MaxSampleSize>{LARGEST_SAMPLE} B</MaxSampleSize></Internal>"
PARTICIPANTS = "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"


def join(domain: int | None) -> DomainParticipant:
    """A new participant; `domain` None: that of ROS_DOMAIN_ID, or 0.

    Raises ValueError for a variable that cannot be, OSError if the network cannot be used.
    """
    id = domain_of(os.environ) if domain is None else domain
    uri = os.environ.get("CYCLONEDDS_URI", "")
    try:
        _domain(id, ",".join(filter(None, (discovery(os.environ), uri))))
        return DomainParticipant(id)
    except DDSException as error:
        raise OSError(f"domain {id} cannot be joined: {_why(uri) or error.msg or error}") from None


def discovery(environ: Mapping[str, str]) -> str:
    """Cyclone DDS's configuration for where to look for others, as ROS 2 would have it."""
    only_here = environ.get("ROS_LOCALHOST_ONLY") == "1"
    range = "LOCALHOST" if only_here else environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE") or "SUBNET"
    if range not in RANGES:
        raise ValueError(f"ROS_AUTOMATIC_DISCOVERY_RANGE is {range[:80]!r}; choose from {', '.join(RANGES)}")
    peers = [] if only_here or range in ("OFF", "SYSTEM_DEFAULT") else _peers(environ.get("ROS_STATIC_PEERS", ""))
    if range == "LOCALHOST":
        peers.insert(0, "localhost")
    # Cyclone DDS refuses an interface that is chosen twice.
    chosen = "NetworkInterface" in environ.get("CYCLONEDDS_URI", "")
    here = "<Interfaces><NetworkInterface address='127.0.0.1'/></Interfaces>"
    general = here if only_here and not chosen else ""
    if range in ("LOCALHOST", "OFF"):
        general += "<AllowMulticast>false</AllowMulticast>"
    found = "".join(f"<Peer Address='{peer}'/>" for peer in peers)
    others = PARTICIPANTS + f"<Peers>{found}</Peers>" if found else ""
    others = f"<Tag>off-{os.getpid()}</Tag>" if range == "OFF" else others
    general = f"<General>{general}</General>" if general else ""
    return f"<CycloneDDS><Domain>{general}<Discovery>{STEADY}{others}</Discovery>{LENIENT}{SIZES}</Domain></CycloneDDS>"


def _peers(text: str) -> list[str]:
    """ROS_STATIC_PEERS: addresses with semicolons between."""
    peers = [peer.strip() for peer in text.split(";") if peer.strip()]
    for peer in peers:
        if not re.fullmatch(r"[A-Za-z0-9.:_\[\]-]+", peer):
            raise ValueError(f"ROS_STATIC_PEERS has {peer[:80]!r}; give addresses with semicolons between")
    return peers


@cache
def _domain(id: int, config: str) -> Domain:
    """A domain is set up once in a process."""
    return Domain(id, config)


def _why(uri: str) -> str:
    """The most common reason: a configuration that names an interface which this machine does not have."""
    here = [name for _, name in socket.if_nameindex()]
    missing = [
        name for name in re.findall(r"NetworkInterface\b[^>]*\bname\s*=\s*[\"']([^\"']+)", uri) if name not in here
    ]
    if missing:
        return f"CYCLONEDDS_URI names the interface {missing[0]}; this machine has {', '.join(here) or 'none'}"
    return f"check CYCLONEDDS_URI, which is {uri[:200]!r}" if uri else ""
