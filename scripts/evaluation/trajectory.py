# SPDX-License-Identifier: BSD-3-Clause
"""A trajectory and its two file formats, TUM and EuRoC csv."""

import os
from dataclasses import dataclass, replace

import numpy as np

LEAST_POSES = 3  # required by an alignment
TRUTH_IN_FOLDER = os.path.join("state_groundtruth_estimate0", "data.csv")  # in an ASL folder
TRUTHS_IN_FOLDER = (TRUTH_IN_FOLDER, os.path.join("mocap0", "data.csv"))  # EuRoC, TUM VI
UNITS = {"seconds": 1.0, "milliseconds": 1e3, "microseconds": 1e6, "nanoseconds": 1e9}
RESTART = "# the world frame starts anew"  # the comment of run_offline and the nodes


class TrajectoryError(Exception):
    """A file or a pair of trajectories that cannot be evaluated; the text is one clear line."""


@dataclass
class Trajectory:
    """Poses of the body in temporal order, in one or more consecutive world frames."""

    stamps: np.ndarray  # (n,) [s], strictly increasing
    positions: np.ndarray  # (n, 3) [m]
    rotations: np.ndarray  # (n, 3, 3) body to world
    worlds: int = 1
    shift: float = 0.0  # added to the timestamps of the file [s]
    steps_left_out: tuple = ()  # of a ground truth, around which it is ignored

    def __len__(self):
        return len(self.stamps)

    @property
    def duration(self):
        return self.stamps[-1] - self.stamps[0]

    @property
    def distances(self):
        """Length of the path up to each pose (n,) [m]."""
        steps = np.linalg.norm(np.diff(self.positions, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def path_length(self):
        return float(self.distances[-1])

    def select(self, indices):
        return replace(self, stamps=self.stamps[indices], positions=self.positions[indices],
                       rotations=self.rotations[indices])

    def shifted(self, seconds):
        return replace(self, stamps=self.stamps + seconds, shift=self.shift + seconds)

    def neighbors(self, stamps):
        """Returns the indices of the poses before and after each timestamp; the outermost beyond
        both ends."""
        after = np.clip(np.searchsorted(self.stamps, stamps), 1, len(self) - 1)
        return after - 1, after

    def at(self, stamps):
        """Interpolates the poses at other timestamps, linearly and by slerp; the outermost poses
        beyond both ends."""
        before, after = self.neighbors(stamps)
        gaps = self.stamps[after] - self.stamps[before]
        share = np.clip((stamps - self.stamps[before]) / gaps, 0, 1)[:, None]
        positions = (1 - share) * self.positions[before] + share * self.positions[after]
        quaternions = _slerp(quaternions_of(self.rotations[before]),
                             quaternions_of(self.rotations[after]), share)
        return replace(self, stamps=stamps, positions=positions,
                       rotations=rotations_of(quaternions))

    def transformed(self, rotation, translation):
        """Transforms the motion to another world frame: p' = rotation * p + translation."""
        return replace(self, positions=self.positions @ rotation.T + translation,
                       rotations=rotation @ self.rotations)

    def inverse(self):
        """Returns the poses of the world in the body."""
        rotations = np.swapaxes(self.rotations, 1, 2)
        return replace(self, rotations=rotations,
                       positions=-np.einsum("nij,nj->ni", rotations, self.positions))


def with_rolled_quaternions(trajectory, places):
    """Reinterprets quaternions that were read in another order than that of the file: `places` is
    -1 for files with w x y z that were read as x y z w, and 1 for the opposite."""
    return replace(trajectory, rotations=rotations_of(
        np.roll(quaternions_of(trajectory.rotations), places, axis=1)))


def read_trajectory(path, least=LEAST_POSES):
    """Reads `stamp[s] x y z qx qy qz qw` (TUM) or `stamp[ns],x,y,z,qw,qx,qy,qz,...` (EuRoC csv).
    Raises TrajectoryError with fewer than `least` poses."""
    if os.path.isdir(path):
        raise TrajectoryError(f"{path}: a folder; give a file in it, such as trajectory.tum, first"
                              " and the ground truth second")
    if not os.path.isfile(path):
        raise TrajectoryError(f"{path}: no such file")
    rows, worlds, begins = [], 0, True
    with open(path, encoding="utf-8-sig", errors="replace") as file:
        for number, line in enumerate(file, start=1):
            begins |= line.startswith(RESTART)
            if line.strip() and not line.lstrip().startswith("#"):
                rows.append(_parse_row(line, f"{path}:{number}", rows[-1][0] if rows else None))
                worlds, begins = worlds + begins, False
    if len(rows) < least:
        raise TrajectoryError(f"{path}: {len(rows)} poses, at least {least} are needed")
    table = np.array(rows).reshape(-1, 8)
    if len(rows) > 1:
        _check_unit(path, table[:, 0], is_csv="," in line)
    return Trajectory(table[:, 0], table[:, 1:4], rotations_of(table[:, 4:8]), worlds)


def read_truth(path):
    """Reads a trajectory as read_trajectory() does, or the ground truth in an ASL folder or its
    mav0/."""
    if not os.path.isdir(path):
        return read_trajectory(path)
    files = [os.path.join(path, parent, name)
             for name in TRUTHS_IN_FOLDER for parent in ("mav0", "")]
    for file in filter(os.path.isfile, files):
        return read_trajectory(file)
    raise TrajectoryError(f"{path}: a folder without {files[0]}; give a TUM file or EuRoC csv")


def _parse_row(line, where, previous_stamp):
    """Returns one row as [stamp, x, y, z, qx, qy, qz, qw]; `where` names it in error messages."""
    is_csv = "," in line
    words = line.split(",") if is_csv else line.split()
    if len(words) < 8 or (not is_csv and len(words) != 8):
        expected = "at least 8 columns (EuRoC csv)" if is_csv else "8 columns (TUM)"
        raise TrajectoryError(f"{where}: {len(words)} columns, expected {expected}"
                              f"{_column_hint(line, len(words))}")
    if is_csv and len(line.split()) == 8 and all("," in word.strip(",") for word in line.split()):
        raise TrajectoryError(f"{where}: decimal commas; replace them by points")
    try:
        row = [float(word) for word in words[:8]]
    except ValueError as error:
        hint = "; begin a heading with #" if previous_stamp is None else ""
        raise TrajectoryError(f"{where}: not a number ({error}){hint}") from None
    if is_csv:
        row = [row[0] * 1e-9, *row[1:4], *row[5:8], row[4]]
    if not np.all(np.isfinite(row)):
        raise TrajectoryError(f"{where}: NaN or infinite value")
    if np.linalg.norm(row[4:8]) < 1e-6:
        raise TrajectoryError(f"{where}: the quaternion is zero")
    if previous_stamp is not None and row[0] <= previous_stamp:
        raise TrajectoryError(f"{where}: the stamp does not increase")
    return row


def _column_hint(line, columns):
    if ";" in line:
        return "; replace the semicolons by spaces"
    if columns == 12:
        return "; 12 look like KITTI poses without stamps: convert them, with times.txt, to TUM"
    if columns == 4:
        return "; for positions without attitudes, append 0 0 0 1"
    return ""


def _check_unit(path, stamps, is_csv):
    """Raises TrajectoryError if the timestamps as read [s] show that the file has another unit."""
    expected = "nanoseconds" if is_csv else "seconds"
    interval = np.median(np.diff(stamps))
    if 1e-4 < interval < 1e2 and (is_csv or stamps[0] < 1e11):
        return
    first, interval = stamps[0] * UNITS[expected], interval * UNITS[expected]  # as in the file
    looks_like = [unit for unit, per_second in UNITS.items() if unit != expected
                  and 1e-4 < interval / per_second < 2.0 and first / per_second < 1e10]
    looks_like.sort(key=lambda unit: 1e9 < first / UNITS[unit] < 4e9)  # an epoch of today, last
    if looks_like[-1:] == ["seconds"]:
        raise TrajectoryError(f"{path}: has commas, but its stamps look like seconds; for rows of"
                              " stamp x y z qx qy qz qw, replace the commas by spaces (EuRoC csv"
                              " has nanoseconds, and qw before qx)")
    if looks_like:
        factor = UNITS[expected] / UNITS[looks_like[-1]]
        raise TrajectoryError(f"{path}: its stamps look like {looks_like[-1]} instead of"
                              f" {expected}; multiply the first column by {factor:g}")


def rotations_of(quaternions):
    """Returns rotation matrices (n, 3, 3) of quaternions (n, 4) in the order x y z w, of any
    length."""
    x, y, z, w = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    return np.stack([
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
    ], axis=1).reshape(-1, 3, 3)


def quaternions_of(rotations):
    """Returns unit quaternions (n, 4) in the order x y z w, with w >= 0, of rotation matrices (n,
    3, 3).

    The quaternion is the eigenvector of the largest eigenvalue of a symmetric matrix
    [BarItzhack2000], which is accurate for all angles; formulas with the trace need case
    distinctions.
    """
    trace = np.trace(rotations, axis1=1, axis2=2)
    matrices = np.empty((len(rotations), 4, 4))
    matrices[:, :3, :3] = rotations + np.swapaxes(rotations, 1, 2) \
        - trace[:, None, None] * np.eye(3)
    matrices[:, :3, 3] = matrices[:, 3, :3] = np.stack(
        [rotations[:, 2, 1] - rotations[:, 1, 2], rotations[:, 0, 2] - rotations[:, 2, 0],
         rotations[:, 1, 0] - rotations[:, 0, 1]], axis=1)
    matrices[:, 3, 3] = trace
    quaternions = np.linalg.eigh(matrices)[1][:, :, -1]
    return quaternions * np.where(quaternions[:, 3:] < 0, -1.0, 1.0)


def _slerp(first, second, share):
    """Interpolates between unit quaternions at shares (n, 1) of the rotation; returns quaternions
    (n, 4) of any length."""
    second = second * np.where(np.sum(first * second, axis=1, keepdims=True) < 0, -1.0, 1.0)
    angles = 2 * np.arctan2(np.linalg.norm(second - first, axis=1, keepdims=True),
                            np.linalg.norm(second + first, axis=1, keepdims=True))
    # sinc(x / pi) = sin(x) / x. The common divisor sin(angle), zero without a rotation, is omitted.
    return ((1 - share) * np.sinc((1 - share) * angles / np.pi) * first
            + share * np.sinc(share * angles / np.pi) * second)
