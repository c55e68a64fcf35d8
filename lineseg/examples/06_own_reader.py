"""Write your own reader for a format that lineseg does not know: here one JSON object per sweep, in millimetres."""

import json
import tempfile
from pathlib import Path

import numpy as np

from lineseg import Recording, extract, open_recording, readers
from lineseg.readers.source import Reader, Source, Sweeps


class Millimetres(Reader):
    format = "JSON lines of millimetres"
    suffixes = (".mm",)
    expects = 'lines such as {"mm": [1000, 1001, 0], "t": 0.1}'

    @staticmethod
    def recognises(head: bytes) -> bool:
        return head.startswith(b'{"mm"')

    @staticmethod
    def read(source: Source) -> Recording:
        sweeps = Sweeps()
        for _number, line in source.lines():
            row = json.loads(line)
            sweeps.add(np.array(row["mm"]) / 1000, -np.pi / 2, np.pi / (len(row["mm"]) - 1), stamp=row["t"])
        return sweeps.recording(source, format=Millimetres.format)


readers.READERS = (Millimetres, *readers.READERS)  # first in the list, because the last reader accepts any text

bearings = np.linspace(-np.pi / 2, np.pi / 2, 181)
wall = [round(2000 / ahead) if ahead > 0.5 else 0 for ahead in np.cos(bearings)]  # 2 m away
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "wall.mm"
    file.write_text("".join(json.dumps({"mm": wall, "t": 0.1 * k}) + "\n" for k in range(3)))
    recording = open_recording(file)
print(f"{recording.format}: {len(recording)} scans; {extract(recording[0]).segments[0].rho:.3f} m to the wall")
