# SPDX-License-Identifier: BSD-3-Clause
"""Absolute and relative pose errors with the definitions of evo (github.com/MichaelGrupp/evo)."""

import numpy as np

from .steps import describe, trusted
from .trajectory import LEAST_POSES, TrajectoryError

ALIGNMENTS = ("se3", "yaw", "none")
MAX_DIFFERENCE = 0.01  # between the timestamps of paired poses [s]
MAX_GAP = 0.5  # between poses, so that the time between them counts as covered [s]
SAME_STAMP = 1e-4  # largest difference of a timestamp between two files [s]


def associate(estimate, truth, max_difference=MAX_DIFFERENCE):
    """Pairs poses by nearest timestamps, as evo does: each pose of the shorter trajectory is paired
    with the nearest one of the longer, if it is at most `max_difference` [s] away.

    Returns both trajectories reduced to the pairs, without those around ignored steps of the ground
    truth.
    """
    swapped = len(truth) < len(estimate)
    shorter, longer = (truth, estimate) if swapped else (estimate, truth)
    nearest = nearest_indices(longer.stamps, shorter.stamps)
    near = np.abs(longer.stamps[nearest] - shorter.stamps) <= max_difference
    shorter, longer = shorter.select(near), longer.select(nearest[near])
    if len(shorter) < LEAST_POSES:
        raise TrajectoryError(
            f"{len(shorter)} poses have a partner within {max_difference} s, no overlap in time"
            f" (estimate {_span(estimate)}, ground truth {_span(truth)}); where their clocks"
            " differ, give --t-offset")
    pair = (longer, shorter) if swapped else (shorter, longer)
    return _without_steps(*pair) if truth.steps_left_out else pair


def _without_steps(estimate, truth):
    kept = trusted(truth.stamps, truth.steps_left_out)
    if kept.sum() < LEAST_POSES:
        raise TrajectoryError(f"{kept.sum()} poses remain without the time around steps of the"
                              f" ground truth, {LEAST_POSES} are needed; it has steps of"
                              f" {describe(truth.steps_left_out)}")
    return estimate.select(kept), truth.select(kept)


def nearest_indices(sorted_stamps, queries):
    """Returns the index of the timestamp nearest to each query."""
    right = np.clip(np.searchsorted(sorted_stamps, queries), 1, len(sorted_stamps) - 1)
    left_is_nearer = queries - sorted_stamps[right - 1] <= sorted_stamps[right] - queries
    return right - left_is_nearer


def are_among(queries, sorted_stamps, within=SAME_STAMP):
    """Returns whether each query is within `within` [s] of one of the timestamps."""
    nearest = sorted_stamps[nearest_indices(sorted_stamps, queries)]
    return np.abs(nearest - queries) <= within


def _span(trajectory):
    return f"{trajectory.stamps[0]:.3f} to {trajectory.stamps[-1]:.3f} s"


def alignment(estimate, truth, kind):
    """Returns rotation and translation that align `estimate` with `truth` by least squares.

    `se3`: Umeyama's closed form without scale; `yaw`: rotation about z only, the gauge freedom of
    visual-inertial odometry; `none`: identity.
    """
    if kind == "none":
        return np.eye(3), np.zeros(3)
    mean_estimate, mean_truth = estimate.positions.mean(axis=0), truth.positions.mean(axis=0)
    covariance = (truth.positions - mean_truth).T @ (estimate.positions - mean_estimate)
    rotation = _best_yaw(covariance) if kind == "yaw" else _best_rotation(covariance)
    return rotation, mean_truth - rotation @ mean_estimate


def _best_rotation(covariance):
    u, singular_values, v_transposed = np.linalg.svd(covariance)
    if singular_values[1] <= 1e-12 * max(singular_values[0], 1e-12):
        raise TrajectoryError("the positions lie on one line or point, so the rotation of the"
                              " alignment is degenerate; use --align yaw or none")
    sign = np.sign(np.linalg.det(u) * np.linalg.det(v_transposed))
    return u @ np.diag([1.0, 1.0, sign]) @ v_transposed


def _best_yaw(covariance):
    angle = np.arctan2(covariance[1, 0] - covariance[0, 1], covariance[0, 0] + covariance[1, 1])
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def position_errors(estimate, truth):
    """Returns the distances [m] between paired, aligned poses."""
    return np.linalg.norm(estimate.positions - truth.positions, axis=1)


def rotation_errors(estimate, truth):
    """Returns the angles [deg] between paired, aligned poses."""
    return _angles(_transposed(truth.rotations) @ estimate.rotations)


def yaw_errors(estimate, truth):
    """Returns absolute heading errors [deg] about the vertical axis of the ground truth's world."""
    return np.abs(np.degrees(signed_yaw_errors(estimate, truth)))


def yaw_drift(estimate, truth, seconds=1.0):
    """Returns the absolute heading error [deg] at the end, with the heading at the beginning
    aligned; beginning and end are means over the first and the last `seconds`. The trajectories
    must be paired, in worlds with z up, and not aligned, since the alignment of a short path tilts
    them."""
    unit = np.exp(1j * signed_yaw_errors(estimate, truth))
    first = unit[truth.stamps <= truth.stamps[0] + seconds].mean()
    last = unit[truth.stamps >= truth.stamps[-1] - seconds].mean()
    return float(np.abs(np.degrees(np.angle(last * np.conj(first)))))


def within_pieces(pairs, estimate, truth):
    """Returns the index pairs of `estimate` that have no ignored step of the ground truth in
    between."""
    piece = np.searchsorted([step.stamp for step in truth.steps_left_out], estimate.stamps)
    first, second = pairs
    together = piece[first] == piece[second]
    return first[together], second[together]


def local_scale_errors(estimate, truth, seconds=5.0, every=0.5, after=10.0, least_extent=0.15):
    """Returns the scale errors [%] of pieces of a trajectory, positive if too large: the inverse of
    the scale of [Umeyama1991] that fits each piece to its ground truth.

    Pieces last `seconds`, begin every `every` [s] from `after` the first pose on [s], and have a
    root mean square extent of at least `least_extent` [m]. Pieces with an ignored step of the
    ground truth are omitted. The trajectories must be paired; their alignment does not matter.
    """
    errors = []
    first, last = estimate.stamps[0] + after, estimate.stamps[-1] - seconds
    for begin in np.arange(first, last + SAME_STAMP, every):
        piece = (begin <= estimate.stamps) & (estimate.stamps <= begin + seconds)
        if piece.sum() < 3 or any(begin <= step.stamp <= begin + seconds
                                  for step in truth.steps_left_out):
            continue
        from_middle = [trajectory.positions[piece] - trajectory.positions[piece].mean(axis=0)
                       for trajectory in (estimate, truth)]
        extent = np.sqrt(np.mean(np.sum(from_middle[1] ** 2, axis=1)))
        if extent < least_extent:
            continue
        errors.append(100 * (_scale(*from_middle) - 1))
    return np.array(errors)


def scale(estimate, truth):
    """Returns the scale of a paired trajectory relative to the truth, independent of alignment."""
    return _scale(*(trajectory.positions - trajectory.positions.mean(axis=0)
                    for trajectory in (estimate, truth)))


def _scale(estimate, truth):
    """Returns the inverse of the scale in [Umeyama1991], for positions (n, 3) about their mean."""
    u, singular_values, v_transposed = np.linalg.svd(truth.T @ estimate)
    singular_values[2] *= np.sign(np.linalg.det(u) * np.linalg.det(v_transposed))
    return np.sum(estimate ** 2) / singular_values.sum()


def signed_yaw_errors(estimate, truth):
    """Returns heading errors [rad] in (-pi, pi]."""
    error = estimate.rotations @ _transposed(truth.rotations)
    return np.arctan2(error[:, 1, 0] - error[:, 0, 1], error[:, 0, 0] + error[:, 1, 1])


def pairs_by_path(trajectory, meters):
    """Returns consecutive index pairs, `meters` of the trajectory's path apart (evo_rpe -d 1 -u
    m)."""
    steps = np.linalg.norm(np.diff(trajectory.positions, axis=0, prepend=trajectory.positions[:1]),
                           axis=1)
    marks, walked = [], 0.0
    for index, step in enumerate(steps):
        walked += step
        if walked >= meters:
            marks.append(index)
            walked = 0.0
    return np.array(marks[:-1], dtype=int), np.array(marks[1:], dtype=int)


def pairs_by_time(trajectory, seconds, tolerance=0.01):
    """Returns all index pairs that are `seconds` apart, within `tolerance` [s]."""
    nearest = nearest_indices(trajectory.stamps, trajectory.stamps + seconds)
    difference = trajectory.stamps[nearest] - trajectory.stamps
    first = np.flatnonzero(np.abs(difference - seconds) <= tolerance)
    return first, nearest[first]


def relative_errors(estimate, truth, pairs):
    """Returns errors of the relative motion of each pair: translation [m] and rotation [deg]."""
    estimated_rotation, estimated_translation = _relative_motion(estimate, *pairs)
    true_rotation, true_translation = _relative_motion(truth, *pairs)
    return (np.linalg.norm(estimated_translation - true_translation, axis=1),
            _angles(_transposed(true_rotation) @ estimated_rotation))


def _relative_motion(trajectory, first, second):
    to_first = _transposed(trajectory.rotations[first])
    step = trajectory.positions[second] - trajectory.positions[first]
    return to_first @ trajectory.rotations[second], np.einsum("nij,nj->ni", to_first, step)


def coverage(estimate, truth, max_gap=MAX_GAP):
    """Returns the share of the ground truth's time span that has poses; gaps longer than `max_gap`
    [s] count as not covered."""
    begin = np.clip(estimate.stamps[:-1], truth.stamps[0], truth.stamps[-1])
    end = np.clip(estimate.stamps[1:], truth.stamps[0], truth.stamps[-1])
    return float((end - begin)[np.diff(estimate.stamps) <= max_gap].sum() / truth.duration)


def statistics(errors):
    """Returns the statistics that evo prints, or None if there are no errors."""
    if len(errors) == 0:
        return None
    return {
        "rmse": float(np.sqrt(np.mean(np.square(errors)))),
        "mean": float(np.mean(errors)),
        "median": float(np.median(errors)),
        "std": float(np.std(errors)),
        "min": float(np.min(errors)),
        "max": float(np.max(errors)),
        "count": len(errors),
    }


def _transposed(matrices):
    return np.swapaxes(matrices, 1, 2)


def _angles(rotations):
    """Returns rotation angles [deg], accurate for small angles as well."""
    twice_sine = np.linalg.norm(np.stack([rotations[:, 2, 1] - rotations[:, 1, 2],
                                          rotations[:, 0, 2] - rotations[:, 2, 0],
                                          rotations[:, 1, 0] - rotations[:, 0, 1]], axis=1), axis=1)
    twice_cosine = np.trace(rotations, axis1=1, axis2=2) - 1.0
    return np.degrees(np.arctan2(twice_sine, twice_cosine))
