# SPDX-License-Identifier: BSD-3-Clause
"""Trajectory files of run_offline."""

import json
import math
import os

from .trajectory import LEAST_POSES, TrajectoryError, read_trajectory


def read_estimate(path, offset=None, least=LEAST_POSES):
    """Returns the trajectory in IMU time, like ground truth: rows have the image timestamp, but are
    valid `td` later. `offset` [s] overrides the `td` of the run."""
    trajectory = read_trajectory(path, least)
    return trajectory.shifted(time_offset(path) if offset is None else offset)


def time_offset(path):
    """Returns the final `td` [s] of the run from the summary.json next to a trajectory; 0 if it is
    missing or does not state any."""
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
    """Raises TrajectoryError if the trajectory is only the last part of a run."""
    stem, extension = os.path.splitext(path)
    part = f"{stem}_1{extension}"
    if os.path.isfile(part):
        raise TrajectoryError("timestamps of the recording jumped back, earlier poses are in"
                              f" {os.path.basename(part)}")
