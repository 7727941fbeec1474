# SPDX-License-Identifier: BSD-3-Clause
"""Figures computed by evo itself, if it is installed."""

import importlib.util

import numpy as np


def is_available():
    return importlib.util.find_spec("evo") is not None


def evo_statistics(estimate, truth):
    """Returns statistics of APE [m], APE rotation [deg] and RPE over 1 m [m] for paired, aligned
    trajectories, under the names that `evaluate()` uses."""
    from evo.core.metrics import APE, RPE, PoseRelation, Unit
    wanted = {
        "ape_m": APE(PoseRelation.translation_part),
        "ape_rotation_deg": APE(PoseRelation.rotation_angle_deg),
        "rpe_1m_m": RPE(PoseRelation.translation_part, delta=1.0, delta_unit=Unit.meters),
    }
    pair = (_to_evo(truth), _to_evo(estimate))
    return {name: _process(metric, pair) for name, metric in wanted.items()}


def _process(metric, pair):
    metric.process_data(pair)
    figures = metric.get_all_statistics()
    names = ("rmse", "mean", "median", "std", "min", "max")
    return dict({name: float(figures[name]) for name in names}, count=len(metric.error))


def _to_evo(trajectory):
    from evo.core.trajectory import PoseTrajectory3D
    poses = np.tile(np.eye(4), (len(trajectory), 1, 1))
    poses[:, :3, :3] = trajectory.rotations
    poses[:, :3, 3] = trajectory.positions
    return PoseTrajectory3D(poses_se3=list(poses), timestamps=trajectory.stamps)
