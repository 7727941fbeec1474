# SPDX-License-Identifier: BSD-3-Clause
"""Compares the accepted loops of a run, from its loops.csv, with ground truth."""

import csv
from dataclasses import dataclass, replace

import numpy as np

from .metrics import SAME_STAMP, are_among, nearest_indices, signed_yaw_errors
from .trajectory import TrajectoryError

# A true revisit: the body is close to an earlier pose with nearly the same orientation.
REVISIT_DISTANCE = 1.0  # [m]
REVISIT_ANGLE = np.radians(30)  # [rad]
REVISIT_PAUSE = 15.0  # [s]
SAMPLING = 0.25  # of the times at which revisits are searched [s]
CLOSED_WITHIN = 1.0  # before or after a revisit [s]
LONGEST_TRUTH_GAP = 0.2  # between true poses, for interpolation [s]


@dataclass
class Loops:
    """Accepted loops: the later pose relative to the earlier one, with the axes of the world of the
    earlier one."""

    earlier: np.ndarray  # (n,) timestamps [s]
    later: np.ndarray  # (n,) timestamps [s]
    positions: np.ndarray  # (n, 3) [m]
    yaws: np.ndarray  # (n,) [rad]

    def __len__(self):
        return len(self.later)

    def between(self, stamps):
        """Returns the loops whose both ends are in `stamps`."""
        return self._select(are_among(self.earlier, stamps) & are_among(self.later, stamps))

    def with_truth(self, truth):
        """Returns the loops whose both ends have a true pose."""
        return self._select(_is_known(self.earlier, truth) & _is_known(self.later, truth))

    def shifted(self, seconds):
        return replace(self, earlier=self.earlier + seconds, later=self.later + seconds)

    def _select(self, kept):
        return Loops(self.earlier[kept], self.later[kept], self.positions[kept], self.yaws[kept])


def read_loops(path):
    """Returns the accepted loops of a loops.csv; raises TrajectoryError if it is invalid."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = [_parse_row(row) for row in csv.DictReader(file) if row["result"] == "accepted"]
    except (OSError, KeyError, TypeError, ValueError, csv.Error) as error:
        raise TrajectoryError(f"{path}: damaged, or no loops.csv ({error})") from None
    table = np.array(rows).reshape(-1, 6)
    return Loops(table[:, 0], table[:, 1], table[:, 2:5], table[:, 5])


def _parse_row(row):
    stamps = [1e-9 * int(row[name]) for name in ("earlier_ns", "later_ns")]
    return [*stamps, *(float(row[name]) for name in ("x_m", "y_m", "z_m")),
            np.radians(float(row["yaw_deg"]))]


def loop_errors(loops, odometry, truth):
    """Returns the errors of loops between poses of `odometry` with true poses: distances [m] and
    rotations [deg], both (n,). The odometry's worlds may be rotated against that of `truth`, and
    drift."""
    earlier, earlier_turns = _true_places(loops.earlier, odometry, truth)
    later, later_turns = _true_places(loops.later, odometry, truth)
    c, s = np.cos(earlier_turns), np.sin(earlier_turns)
    x, y, z = (later - earlier).T
    positions = np.stack([c * x - s * y, s * x + c * y, z], axis=1)
    turns = loops.yaws - (earlier_turns - later_turns)
    return (np.linalg.norm(loops.positions - positions, axis=1),
            np.abs(np.degrees(np.arctan2(np.sin(turns), np.cos(turns)))))


def _true_places(stamps, odometry, truth):
    """Returns true positions, and the rotation of the odometry's world against the true one
    [rad]."""
    true = truth.at(stamps)
    estimated = odometry.select(nearest_indices(odometry.stamps, stamps))
    return true.positions, signed_yaw_errors(estimated, true)


def _is_known(stamps, truth):
    """Returns whether each timestamp is that of a true pose, or in a short gap between two."""
    before, after = truth.neighbors(stamps)
    inside = (truth.stamps[before] <= stamps) & (stamps <= truth.stamps[after])
    is_short = truth.stamps[after] - truth.stamps[before] <= LONGEST_TRUTH_GAP + SAME_STAMP
    return (inside & is_short) | are_among(stamps, truth.stamps)


def revisits(truth):
    """Returns times (n,) [s], at intervals of SAMPLING, at which the body revisits a pose of at
    least REVISIT_PAUSE before, and whether it has been elsewhere in between, (n,), which is false
    at standstill. Ignores gaps of the ground truth."""
    times = np.arange(truth.stamps[0], truth.stamps[-1], SAMPLING)
    times = times[are_among(times, truth.stamps, SAMPLING)]
    poses = truth.select(nearest_indices(truth.stamps, times))
    before = np.searchsorted(times, times - REVISIT_PAUSE + SAMPLING / 2)
    revisited, returned = [], []
    for index in range(len(times)):
        near = _is_near(poses, index)
        if near[:before[index]].any():
            revisited.append(times[index])
            returned.append(not near[np.argmax(near):].all())
    return np.array(revisited), np.array(returned, dtype=bool)


def _is_near(poses, index):
    """Returns whether each pose up to this one is close to it."""
    until = slice(index + 1)
    distances = np.linalg.norm(poses.positions[until] - poses.positions[index], axis=1)
    traces = np.einsum("nij,ij->n", poses.rotations[until], poses.rotations[index])
    is_same_view = (traces - 1) / 2 > np.cos(REVISIT_ANGLE)
    return (distances < REVISIT_DISTANCE) & is_same_view


def closed_share(loops, revisit_times):
    """Returns the share of revisits that a loop closes; None if there are no revisits."""
    if len(revisit_times) == 0:
        return None
    if len(loops) == 0:
        return 0.0
    gaps = np.abs(revisit_times[:, None] - loops.later[None, :]).min(axis=1)
    return float(np.mean(gaps <= CLOSED_WITHIN))
