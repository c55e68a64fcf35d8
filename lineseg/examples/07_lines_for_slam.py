"""Input for a SLAM front end: lines as (ρ, θ) with covariance, matched with those of the next frame."""

import sys

import numpy as np

from lineseg import Noise, covariances, extract, open_recording

NOISE = Noise(range=0.01)  # standard deviation of a range [m], from the laser's data sheet
GATE = 9.21  # 99 % of true pairs have a smaller squared Mahalanobis distance (χ², 2 degrees of freedom)

recording = open_recording(sys.argv[1] if sys.argv[1:] else "sample_scans/hallway.npz")


def lines_of(frame):
    """(lines, 2) of ρ [m] and θ [rad], and their covariances (lines, 2, 2)."""
    scan = recording[frame]
    found = extract(scan)
    polar = np.array([(segment.rho, segment.theta) for segment in found.segments]).reshape(-1, 2)
    return polar, covariances(scan, found, NOISE)


(before, spread_before), (now, spread_now) = lines_of(0), lines_of(1)
poses = np.zeros((2, 3)) if recording.poses is None else recording.poses[:2]  # or the robot's odometry
(x, y, turn), heading = poses[1] - poses[0], poses[0, 2]
for (rho, theta), spread in zip(before, spread_before, strict=True):
    ahead = (
        rho - x * np.cos(theta + heading) - y * np.sin(theta + heading),
        theta - turn,
    )  # seen from the new pose
    apart = now - ahead
    apart[:, 1] = (apart[:, 1] + np.pi) % (2 * np.pi) - np.pi
    distances = np.einsum("ni,nij,nj->n", apart, np.linalg.inv(spread_now + spread), apart)
    sigma_rho, sigma_theta = np.sqrt(np.diag(spread))
    again = f"line {distances.argmin()} of the next frame" if distances.min() < GATE else "not in the next frame"
    print(f"ρ = {rho:.3f} ± {sigma_rho:.4f} m, θ = {theta:6.3f} ± {sigma_theta:.4f} rad: {again}")
