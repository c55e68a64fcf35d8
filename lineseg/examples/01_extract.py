"""The line segments of one scan: where they are, how well they fit, and how to set a threshold."""

import sys

from lineseg import Params, extract, open_recording

recording = open_recording(sys.argv[1] if sys.argv[1:] else "sample_scans/hallway.npz")
scan = recording[0]
print(f"{recording.name}: {len(recording)} scans; the first has {len(scan)} beams, {scan.valid.sum()} of them valid")

found = extract(scan)
for segment in found.segments:
    (x1, y1), (x2, y2) = segment.start, segment.end
    print(
        f"({x1:6.2f}, {y1:6.2f}) to ({x2:6.2f}, {y2:6.2f}) m, {segment.points} points, rms {1000 * segment.rms:.1f} mm"
    )
print(f"{found.covered} beams belong to a segment")

# A laser with less noise allows a smaller distance between a point and its line.
stricter = extract(scan, Params(epsilon=0.015))
print(f"with ε = 0.015 m instead of {Params().epsilon} m: {len(stricter.segments)} segments")
