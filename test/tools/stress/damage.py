# SPDX-License-Identifier: BSD-3-Clause
"""The effect of a fault on a trajectory."""

from dataclasses import dataclass

import numpy as np

from evaluation import metrics
from evaluation.run_results import read_estimate
from evaluation.trajectory import RESTART, Trajectory, TrajectoryError


@dataclass
class Damage:
    ape: float  # RMSE [m]; each world frame is aligned separately
    jump: float  # largest position error before a restart, aligned up to the fault [m]
    restarts: list  # times since the fault [s]
    coverage: float  # share of the true time with a pose


def read_worlds(path):
    """Returns the trajectories between restarts, and the timestamp of the last pose before each
    restart."""
    poses = read_estimate(path)
    starts, row = [0], 0
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith(RESTART):
                starts.append(row)
            elif not line.startswith("#"):
                row += 1
    ends = starts[1:] + [len(poses)]
    worlds = [poses.select(np.arange(start, end)) for start, end in zip(starts, ends)
              if end > start]
    return worlds, [poses.stamps[end - 1] for end in starts[1:] if end > 0]


def assess(path, truth, fault_at):
    """`fault_at` [s] is in IMU time. Raises TrajectoryError if nothing can be compared."""
    worlds, restarts = read_worlds(path)
    poses = read_estimate(path)
    squares = np.concatenate([_squared_errors(world, truth) for world in worlds])
    if not len(squares):
        raise TrajectoryError(f"{path}: no world frame is long enough")
    return Damage(float(np.sqrt(squares.mean())), _jump(worlds, truth, fault_at),
                  [stamp - fault_at for stamp in restarts], metrics.coverage(poses, truth))


def _squared_errors(world, truth):
    try:
        estimate, true = metrics.associate(world, truth)
        rotation, translation = metrics.alignment(estimate, true, "se3")
    except TrajectoryError:
        return np.zeros(0)
    return metrics.position_errors(estimate.transformed(rotation, translation), true) ** 2


def _jump(worlds, truth, fault_at):
    for world in worlds:
        if world.stamps[0] < fault_at < world.stamps[-1]:
            return _error_after(world, truth, fault_at)
    return 0.0


def _error_after(world: Trajectory, truth, fault_at):
    estimate, true = metrics.associate(world, truth)
    before = estimate.stamps <= fault_at
    if before.sum() < 3:
        return 0.0
    rotation, translation = metrics.alignment(estimate.select(before), true.select(before), "yaw")
    errors = metrics.position_errors(estimate.transformed(rotation, translation), true)
    return float(errors[~before].max(initial=0.0))
