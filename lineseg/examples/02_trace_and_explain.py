"""How a result came about: each decision with its numbers, and why a beam does or does not belong to a segment."""

import sys
from itertools import islice

from lineseg import open_recording, trace, what_if

recording = open_recording(sys.argv[1] if sys.argv[1:] else "sample_scans/hallway.npz")
scan = recording[0]
traced = trace(scan)  # traced.extraction is what extract(scan) returns

print(f"{len(traced)} decisions; the first three:")
for decision in islice(traced, 3):
    print(f"  {decision.phase}: {decision.text}")

beam = int((scan.valid & (traced.extraction.labels < 0)).argmax())
print(f"beam {beam} is the first without a segment: {traced.explain(beam).text}")

print("Changing any one of these thresholds would be enough:")
for answer in what_if(scan, beam):
    if answer.value is not None:
        print(f"  {answer.text}")
