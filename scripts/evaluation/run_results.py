# SPDX-License-Identifier: BSD-3-Clause
"""A trajectory as run_offline leaves it in its folder."""

import json
import math
import os

from .trajectory import LEAST_POSES, TrajectoryError, read_trajectory


def read_estimate(path, offset=None, least=LEAST_POSES):
    """The trajectory on the clock of the IMU, on which ground truth is: rows carry the stamp of the
    image, but stand for `td` later. `offset` [s] goes before the `td` of the run."""
    trajectory = read_trajectory(path, least)
    return trajectory.shifted(time_offset(path) if offset is None else offset)


def time_offset(path):
    """The `td` [s] that the run of a trajectory ended with, by the summary.json beside it; 0 where
    that is not there or states none."""
    summary = os.path.join(os.path.dirname(path), "summary.json")
    if not os.path.isfile(summary):
        return 0.0
    try:
        with open(summary, encoding="utf-8") as file:
            calibration = json.load(file).get("calibration")
        offset = 0.0 if calibration is None else float(calibration["td_s"])
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise TrajectoryError(f"{summary}: damaged ({error!r}); run again") from None
    if not math.isfinite(offset):
        raise TrajectoryError(f"{summary}: td_s is {offset}; run again")
    return offset


def check_whole(path):
    """TrajectoryError where the trajectory is only the last part of a run."""
    stem, extension = os.path.splitext(path)
    part = f"{stem}_1{extension}"
    if os.path.isfile(part):
        raise TrajectoryError("stamps of the recording jumped back, poses of before are in"
                              f" {os.path.basename(part)}")
