"""Add lines to a rerun recording (rerun.io), next to your other data. Needs the extra `rerun`."""

import sys

import rerun as rr

import lineseg
import lineseg.rerun

recording = lineseg.open_recording(sys.argv[1] if sys.argv[1:] else "sample_scans/hallway.npz")
target = sys.argv[2] if sys.argv[2:] else "lines.rrd"

rr.init("my_robot")
rr.save(target)
for frame in range(0, len(recording), 10):
    scan = recording[frame]
    rr.set_time("frame", sequence=frame)
    # The pose of the laser: this transform applies to points and lines alike.
    if recording.poses is not None:
        x, y, heading = recording.poses[frame]
        rr.log(
            "laser", rr.Transform3D(translation=[x, y, 0], rotation_axis_angle=rr.RotationAxisAngle([0, 0, 1], heading))
        )
    lineseg.rerun.log("laser", lineseg.extract(scan), scan)
rr.disconnect()
print(f"{target}: every tenth of {len(recording)} frames; `rerun {target}` shows them")
