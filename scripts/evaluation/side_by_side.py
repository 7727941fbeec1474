# SPDX-License-Identifier: BSD-3-Clause
"""A table of several estimates over the same ground truth."""

import os

from . import metrics
from .markdown import Table

HEADING = ["estimate", "APE [m]", "coverage [%]", "first pose [s]", "common APE [m]", "scale [%]"]


def side_by_side(estimates, truth, align, max_diff, max_gap):
    """Returns a table. `estimates`: trajectories by file, in the order of the rows.

    APE is the RMSE after alignment. The common APE is that over the time for which all estimates
    have poses, because a late start flatters the APE. Scale is the error of the estimate's size
    after alignment with scale [%].
    """
    begin = max(estimate.stamps[0] for estimate in estimates.values())
    end = min(estimate.stamps[-1] for estimate in estimates.values())
    rows = []
    for file, estimate in estimates.items():
        common = estimate.select((estimate.stamps >= begin) & (estimate.stamps <= end))
        pair = metrics.associate(estimate, truth, max_diff)
        rows.append([os.path.relpath(file), f"{_ape(pair, align):.4f}",
                     f"{100 * metrics.coverage(estimate, truth, max_gap):.1f}",
                     f"{estimate.stamps[0] - truth.stamps[0]:.2f}",
                     f"{_ape(metrics.associate(common, truth, max_diff), align):.4f}",
                     f"{100 * (metrics.scale(*pair) - 1):+.2f}"])
    return str(Table(HEADING, rows))


def _ape(pair, align):
    estimate, truth = pair
    aligned = estimate.transformed(*metrics.alignment(estimate, truth, align))
    return metrics.statistics(metrics.position_errors(aligned, truth))["rmse"]
