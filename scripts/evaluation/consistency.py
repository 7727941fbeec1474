# SPDX-License-Identifier: BSD-3-Clause
"""Tests whether the errors of a trajectory agree with its estimated covariance."""

import warnings

import numpy as np

from . import metrics
from .trajectory import TrajectoryError

_COLUMNS = 22  # of covariance.csv: a timestamp and the upper triangle of 6 x 6


class NoPoseThenError(TrajectoryError):
    """The trajectory has no pose at that time."""


def read_covariances(path, stamps):
    """Returns the covariances (n, 6, 6) of the poses at `stamps` [s]: position in the world, then
    rotation in the body, from the covariance.csv of `run_offline`."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # files without rows are reported below
            table = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    except StopIteration:  # of NumPy 1.19, if there is no line
        table = np.empty((0, 0))
    except (OSError, ValueError) as error:
        raise TrajectoryError(f"{path}: {error}") from None
    if table.shape[1] != _COLUMNS or len(table) < 2:
        raise TrajectoryError(f"{path}: not the covariance.csv of run_offline")
    stated = table[:, 0] * 1e-9
    if not metrics.are_among(stamps, stated).all():
        raise TrajectoryError(f"{path}: has no covariance for some poses, belongs to another"
                              " trajectory")
    rows = metrics.nearest_indices(stated, stamps)
    row, column = np.triu_indices(6)
    covariances = np.empty((len(rows), 6, 6))
    covariances[:, row, column] = covariances[:, column, row] = table[rows, 1:]
    return covariances


def position_nees(estimate, truth, covariances, seconds):
    """Returns the NEES of the displacement from the first pose to the one `seconds` later: 3 on
    average for a consistent covariance [BarShalom2001].

    The trajectories are paired. The covariances of both poses, assumed independent, are added.
    Headings are aligned by the positions up to the second pose, since the headings of ground truth
    may contradict its own path. The alignment removes a part of the error, so the NEES is slightly
    too small.
    """
    last = metrics.nearest_indices(estimate.stamps, estimate.stamps[:1] + seconds)[0]
    if abs(estimate.stamps[last] - estimate.stamps[0] - seconds) > 0.1:
        raise NoPoseThenError(f"no pose {seconds:g} s after the first, the last one is"
                              f" {estimate.duration:.2f} s after it")
    stretch = np.arange(last + 1)
    rotation, _ = metrics.alignment(truth.select(stretch), estimate.select(stretch), "yaw")
    error = (estimate.positions[last] - estimate.positions[0]
             - rotation @ (truth.positions[last] - truth.positions[0]))
    covariance = covariances[0][:3, :3] + covariances[last][:3, :3]
    return float(error @ np.linalg.solve(covariance, error))
