# SPDX-License-Identifier: BSD-3-Clause
"""Detects frequent mistakes in two trajectory files and suggests remedies."""

import os

import numpy as np

from . import metrics
from .trajectory import with_rolled_quaternions

_WRONG_ATTITUDE = 20.0  # larger errors [deg] need an explanation
_RIGHT_ATTITUDE = 5.0  # smaller ones [deg] are not by chance
_OTHER_UNIT = 30.0  # ratio of scales that no estimate has
_STILL = 0.1  # deviation of positions [m] below which no scale is defined
_INVERTED = 5.0  # ratio of position errors that shows inverted poses
_DENSER = 3.0  # ratio of pose rates above which a file is likely to be the ground truth


def notes(paths, estimate, truth, align, max_difference):
    """Returns all notes on the two files, the estimate's first; see metrics.associate() and
    metrics.alignment() for the last two arguments."""
    pair = metrics.associate(estimate, truth, max_difference)
    found = (_swapped(*paths, estimate, truth), _quaternion_order(*paths, *pair, align),
             _unit(paths[0], *pair), _inverted(paths[0], *pair))
    return [note for note in found if note]


def _swapped(estimate_path, truth_path, estimate, truth):
    """Returns a note if the first file is the ground truth, by neighboring files or by rate and
    time."""
    estimate_is_run, truth_is_run = (
        os.path.isfile(os.path.join(os.path.dirname(path), "summary.json")) or poses.worlds > 1
        for path, poses in ((estimate_path, estimate), (truth_path, truth)))
    denser = _rate(estimate) > _DENSER * _rate(truth)
    around = estimate.stamps[0] <= truth.stamps[0] and estimate.stamps[-1] >= truth.stamps[-1]
    if estimate_is_run or not (truth_is_run or (denser and around)):
        return None
    return (f"{estimate_path} looks like the ground truth and {truth_path} like the estimate; give"
            " the estimate first")


def _unit(estimate_path, estimate, truth):
    if np.std(truth.positions, axis=0).max() < _STILL:
        return None
    scale = metrics.scale(estimate, truth)
    if 1 / _OTHER_UNIT < scale < _OTHER_UNIT:
        return None
    return (f"the positions of {estimate_path} are {scale:.3g} times those of the ground truth; are"
            " both in meters?")


def _inverted(estimate_path, estimate, truth):
    """Returns a note if the inverse poses of the estimate fit far better."""
    def error(poses):
        rotation, translation = metrics.alignment(poses, truth, "se3")
        errors = metrics.position_errors(poses.transformed(rotation, translation), truth)
        return np.sqrt(np.mean(errors ** 2))

    as_is, inverted = error(estimate), error(estimate.inverse())
    if as_is < max(_STILL, _INVERTED * inverted):
        return None
    return (f"APE is {as_is:.2g} m, but {inverted:.2g} m if the poses of {estimate_path} are those"
            " of the world in the body; invert them")


def _rate(trajectory):
    return 1.0 / np.median(np.diff(trajectory.stamps))


def _quaternion_order(estimate_path, truth_path, estimate, truth, align):
    """Returns a note if the attitudes of paired trajectories agree with another component order of
    the quaternions. The alignment uses positions only, which do not depend on the order."""
    rotation, translation = metrics.alignment(estimate, truth, align)

    def attitude_error(estimate, truth):
        aligned = estimate.transformed(rotation, translation)
        return np.median(metrics.rotation_errors(aligned, truth))

    error = attitude_error(estimate, truth)
    if error < _WRONG_ATTITUDE:
        return None
    for places, order in ((-1, "qw qx qy qz"), (1, "qx qy qz qw")):
        other_estimate, other_truth = (with_rolled_quaternions(trajectory, places)
                                       for trajectory in (estimate, truth))
        for which, first, second in ((estimate_path, other_estimate, truth),
                                     (truth_path, estimate, other_truth),
                                     ("both files", other_estimate, other_truth)):
            left = attitude_error(first, second)
            if left < _RIGHT_ATTITUDE:
                return (f"attitudes differ by {error:.0f} deg, but by {left:.1f} deg if the"
                        f" quaternions of {which} are {order}; reorder the columns (TUM has"
                        " qx qy qz qw, EuRoC csv qw qx qy qz)")
    return None
