# SPDX-License-Identifier: BSD-3-Clause
"""Whether the errors of a trajectory are as large as its stated covariance says."""

import warnings

import numpy as np

from . import metrics
from .trajectory import TrajectoryError

_COLUMNS = 22  # of covariance.csv: a stamp and the upper triangle of 6 x 6


class NoPoseThenError(TrajectoryError):
    """The trajectory has no pose at that time."""


def read_covariances(path, stamps):
    """Covariances (n, 6, 6) of the poses at `stamps` [s]: position in the world, then rotation in
    the body, from the covariance.csv of `run_offline`."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of files without rows; the check below says it
            table = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    except (OSError, ValueError) as error:
        raise TrajectoryError(f"{path}: {error}") from None
    if table.shape[1] != _COLUMNS or len(table) < 2:
        raise TrajectoryError(f"{path}: not the covariance.csv of run_offline")
    stated = table[:, 0] * 1e-9
    if not metrics.are_among(stamps, stated).all():
        raise TrajectoryError(f"{path}: has no covariance for some poses, is of another trajectory")
    rows = metrics.nearest_indices(stated, stamps)
    row, column = np.triu_indices(6)
    covariances = np.empty((len(rows), 6, 6))
    covariances[:, row, column] = covariances[:, column, row] = table[rows, 1:]
    return covariances


def position_nees(estimate, truth, covariances, seconds):
    """Squared error of the way from the first pose to the one `seconds` later, in units of its
    covariance: 3 on average where that is true [BarShalom2001].

    The trajectories are paired. Both poses have errors, the first one those of a start; they are
    taken as independent, so their covariances add. Headings agree as the positions up to the pose
    in question do: ground truth may state headings that its own path does not have. So the figure
    is a little too small, as a part of the error is aligned away.
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
