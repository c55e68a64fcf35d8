"""Process a whole recording on all cores: scores for every frame, and what looks wrong in the worst one."""

import sys

from lineseg import SCORES, open_recording, survey, why, with_disputes, worst_first

recording = open_recording(sys.argv[1] if sys.argv[1:] else "sample_scans/laboratory.npz")
surveyed = with_disputes(recording, survey(recording))
print(f"{len(surveyed.segments)} segments in {len(recording)} frames")
for name in ("coverage", "rms", "change"):
    values = surveyed.score(name)
    print(f"  {SCORES[name].label}: {values.min():.3f} to {values.max():.3f} {SCORES[name].unit}")

assert surveyed.scores is not None  # survey(recording, scores=False) is faster but gives none
frame = int(worst_first(surveyed.scores)[0])
print(f"Frame {frame} is the most suspicious:")
for remark in why(recording, frame, scores=surveyed.scores)[:3]:
    print(f"  {remark.text}")
