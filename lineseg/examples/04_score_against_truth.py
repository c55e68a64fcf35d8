"""How good are the lines? If the walls are known, segments are matched with the true lines."""

import sys

import numpy as np

from lineseg import Agreement, Params, agreements, open_recording

recording = open_recording(sys.argv[1] if sys.argv[1:] else "sample_scans/hallway.npz")
if recording.wall is None:
    sys.exit(f"{recording.name} does not say which wall each beam hit; a simulated recording does")
some = recording.only(np.arange(0, len(recording), 10))


def tell(what, found):
    total = Agreement.of_all(found)
    print(
        f"{what}: {total.true_rate:.0%} of the true lines found, {total.false_rate:.0%} of the segments false, ", end=""
    )
    print(f"half of the endpoints are within {1000 * total.endpoint_error():.0f} mm")


for epsilon in (0.01, 0.03, 0.1):
    tell(f"ε = {epsilon:.2f} m", filter(None, agreements(some, Params(epsilon=epsilon))))
tell("RANSAC", filter(None, agreements(some, method="ransac")))
