"""Writes line maps as GeoJSON, SVG, DXF and NPZ."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np

from ..installation import install_command
from ..unfinished import whole_file
from .figure import FOOT, INK, Place, document, foot_of, in_rows

if TYPE_CHECKING:
    from ..line_map import LineMap

About = Mapping[str, Any]
METRES = "metres in the world of the poses; not degrees"
# The layer of a DXF drawing; its unit is metres.
LAYER, UNIT = "LINES", 6


def geojson(found: LineMap, title: str, about: About) -> bytes:
    """A FeatureCollection with a LineString for each line: length, sigma, seen, rho, theta and their covariance.

    Coordinates are metres in the world, not degrees, as its member `coordinates` says.
    """
    features = []
    normals, lengths = found.normals, found.lengths
    thetas = np.arctan2(normals[:, 1], normals[:, 0])
    rhos = (normals * found.ends[:, :2]).sum(axis=1)
    for k, (x1, y1, x2, y2) in enumerate(found.ends.tolist()):
        properties = {
            "line": k,
            "length": float(lengths[k]),
            "sigma": float(found.sigma[k]),
            "seen": int(found.seen[k]),
            "rho": float(rhos[k]),
            "theta": float(thetas[k]),
            "covariance": found.covariance[k].tolist(),
        }
        geometry = {"type": "LineString", "coordinates": [[x1, y1], [x2, y2]]}
        features.append({"type": "Feature", "geometry": geometry, "properties": properties})
    told = {"frames": found.frames, "band": found.band, "coverage": found.coverage, "doubt": found.doubt}
    told |= {"pose_shift": found.pose_noise.shift, "pose_turn": found.pose_noise.turn}
    whole = {"type": "FeatureCollection", "coordinates": METRES, "about": {**about, **told, "title": title}}
    return msgspec.json.format(msgspec.json.encode(whole | {"features": features}), indent=1)


def svg(found: LineMap, title: str, about: About) -> bytes:
    """The lines from above, x to the right and y up, with a scale bar; the title of each says its length and sigma."""
    place = Place(found.ends.reshape(-1, 2) if len(found) else np.zeros((1, 2)), FOOT, laser=False)
    drawn = []
    for (x1, y1, x2, y2), length, sigma in zip(
        found.ends.tolist(), found.lengths.tolist(), found.sigma.tolist(), strict=True
    ):
        (left, top), (right, bottom) = place(x1, y1), place(x2, y2)
        words = f"{length:.2f} m, ±{1e3 * sigma:.0f} mm"
        drawn.append(
            f'<line x1="{left:.2f}" y1="{top:.2f}" x2="{right:.2f}" y2="{bottom:.2f}"><title>{words}</title></line>'
        )
    whole = document(
        title,
        f'<g stroke="{INK}" stroke-width="2" stroke-linecap="round">',
        *drawn,
        "</g>",
        *foot_of(in_rows([("", f"{len(found)} lines")]), title, [], place),
    )
    return whole.encode()


def dxf(found: LineMap, title: str, about: About) -> bytes:
    """A drawing in metres with a LINE for each line."""
    new = drawings()
    drawing = new("R2010", units=UNIT)
    drawing.layers.add(LAYER)
    drawing.header.custom_vars.append("lineseg", title)
    for x1, y1, x2, y2 in found.ends.tolist():
        drawing.modelspace().add_line((x1, y1), (x2, y2), dxfattribs={"layer": LAYER})
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue().encode(drawing.output_encoding, "dxfreplace")


def npz(found: LineMap, title: str, about: About) -> bytes:
    """Arrays: ends (n, 4), covariance (n, 2, 2), sigma, seen (n,), and what the map says of itself."""
    arrays = {name: getattr(found, name) for name in ("ends", "covariance", "sigma", "seen", "band", "coverage")}
    content = io.BytesIO()
    np.savez_compressed(content, **arrays, title=title, about=msgspec.json.encode(about).decode())
    return content.getvalue()


# Suffix → writer.
MAP_WRITERS: dict[str, Callable[[LineMap, str, About], bytes]] = {
    "geojson": geojson,
    "svg": svg,
    "dxf": dxf,
    "npz": npz,
}


def drawings() -> Callable[..., Any]:
    """ezdxf's function that makes a drawing, or a ValueError that says what to install."""
    try:
        from ezdxf.filemanagement import new
    except ImportError:
        raise ValueError(f"a DXF drawing needs ezdxf; `{install_command('dxf')}` installs it") from None
    return new


def check_map_path(path: Path) -> None:
    """Raises ValueError or FileNotFoundError if the map cannot be written, before it is made."""
    if path.suffix.lower().removeprefix(".") not in MAP_WRITERS:
        raise ValueError(f"{path}: use a name that ends in {', '.join(f'.{format}' for format in MAP_WRITERS)}.")
    if not path.absolute().parent.is_dir():
        raise FileNotFoundError(f"{path}: the folder {path.parent} does not exist.")
    if path.suffix.lower() == ".dxf":
        drawings()


def write_map(found: LineMap, path: Path, title: str, about: About) -> None:
    """Write a line map in the format of the path's suffix; the file appears when it is complete."""
    content = MAP_WRITERS[path.suffix.lower().removeprefix(".")](found, title, about)
    with whole_file(path) as unfinished:
        unfinished.write_bytes(content)
