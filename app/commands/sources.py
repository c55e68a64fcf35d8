"""Live sources on the command line."""

from __future__ import annotations

from importlib.util import find_spec

from lineseg.installation import install_command

from ..live.address import EXPECTED, Address, is_address

NEEDED = {"ros2": "cyclonedds"}
LIST_SECONDS = 2.0


def address_of(text: str, topic: str | None) -> Address:
    """Raises ValueError if it is none, or if what it needs is not installed."""
    if not is_address(text):
        raise ValueError(f"{text[:80]!r} is not the address of a robot; {EXPECTED}")
    address = Address(text, topic)
    package = NEEDED.get(address.scheme)
    if package and find_spec(package) is None:
        command = install_command(address.scheme)
        raise ValueError(f"{address.scheme}: needs the package {package}; `{command}` installs it")
    return address


def list_topics(address: Address) -> bool:
    """Print the laser topics if the address names none and has to; returns whether it did."""
    if address.scheme != "ros2" or address.topic is not None:
        return False
    from ..live.dds import laser_topics

    offers = laser_topics(address.domain, LIST_SECONDS)
    for offer in offers:
        kind = "reliable" if offer.reliable else "best effort"
        print(f"{address.url}{offer.topic}  {kind}, {'transient local' if offer.kept else 'volatile'}")
    if not offers:
        raise ValueError(
            f"no sensor_msgs/LaserScan topic showed up in {LIST_SECONDS:g} s; check that the robot publishes, and its "
            "domain: ROS_DOMAIN_ID, or ros2://DOMAIN"
        )
    return True
