"""Segments as sensor_msgs/PointCloud2, one point each, with the stamp and the frame of their scan."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from lineseg.covariance import Noise, covariances
from lineseg.readers.laser_scan import LaserScan
from lineseg.scan import Scan
from lineseg.segment import Extraction

from .cdr import CdrWriter
from .outgoing import header_fields, write_header

# sensor_msgs/PointField
INT32, FLOAT32 = 5, 7
# x, y, z: the start of the segment, where viewers draw the point; x2, y2: its end.
POINT = np.dtype(
    [(name, "<f4") for name in ("x", "y", "z", "x2", "y2", "rho", "theta", "length")]
    + [("points", "<i4"), ("rms", "<f4"), ("first", "<i4"), ("last", "<i4")]
    + [(name, "<f4") for name in ("var_rho", "cov_rho_theta", "var_theta")]
)


@dataclass(frozen=True)
class Cloud:
    """noise: of the laser, for the covariance of (rho, theta); None: each segment's own, see `own_noise`."""

    extraction: Extraction
    scan: LaserScan
    beams: Scan
    noise: Noise | None = None
    type: ClassVar[str] = "sensor_msgs/PointCloud2"
    encodings: ClassVar[tuple[str, ...]] = ("cdr", "ros1", "json")

    def fields(self, ros1: bool = False) -> dict[str, Any]:
        points = self.points()
        return {
            "header": header_fields(self.scan, ros1),
            "height": 1,
            "width": len(points),
            "fields": [
                {"name": name, "offset": offset, "datatype": kind, "count": 1} for name, offset, kind in _described()
            ],
            "is_bigendian": False,
            "point_step": POINT.itemsize,
            "row_step": points.nbytes,
            "data": points.tobytes(),
            "is_dense": True,
        }

    def cdr(self) -> bytes:
        points = self.points()
        cdr = CdrWriter()
        write_header(cdr, self.scan)
        cdr.numbers("2I", 1, len(points))
        cdr.same(_described_as_cdr())
        cdr.numbers("?", False)
        cdr.numbers("2I", POINT.itemsize, points.nbytes)
        cdr.sequence(points.view(np.uint8))
        cdr.numbers("?", True)
        return cdr.bytes()

    def points(self) -> NDArray[np.void]:
        """(segments,) of POINT."""
        segments = self.extraction.segments
        matrices = self._covariances()[:, (0, 0, 1), (0, 1, 1)].tolist()
        rows = [
            (*each.start, 0.0, *each.end, each.rho, each.theta, each.length, each.points, each.rms, each.first,
             each.last, *matrix)
            for each, matrix in zip(segments, matrices, strict=True)
        ]  # fmt: skip
        return np.array(rows, POINT)

    def _covariances(self) -> NDArray[np.float64]:
        return covariances(self.beams, self.extraction, self.noise or own_noise(self.extraction, self.beams))


def own_noise(extraction: Extraction, scan: Scan) -> Noise:
    """The noise of each beam, estimated from the distances of its segment's points to the line.

    The variance of n points is n·rms² / (n − 2), for a line has two parameters. It is taken to be the same across and
    along a beam: a bearing of σ / r.
    """
    sigmas = [each.rms * math.sqrt(each.points / max(each.points - 2, 1)) for each in extraction.segments]
    sigma = np.array([*sigmas, 0.0])[extraction.labels]
    ranges = np.where(scan.valid, scan.ranges, 1.0)
    return Noise(sigma, sigma / ranges)


@cache
def _described_as_cdr() -> bytes:
    cdr = CdrWriter()
    cdr.numbers("I", len(_described()))
    for name, offset, kind in _described():
        cdr.text(name)
        cdr.numbers("I", offset)
        cdr.numbers("B", kind)
        cdr.numbers("I", 1)
    return cdr.body()


def _described() -> list[tuple[str, int, int]]:
    """Name, offset and datatype of each field."""
    assert POINT.fields is not None
    return [(name, offset, INT32 if kind.kind == "i" else FLOAT32) for name, (kind, offset, *_) in POINT.fields.items()]
