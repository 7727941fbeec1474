# SPDX-License-Identifier: BSD-3-Clause
"""Steps of a ground truth: a tracker that has lost its target jumps when it finds it again.

Ground truth drifts before a step, so errors relative to it are unreliable there.
"""

from dataclasses import dataclass, replace

import numpy as np

# Smaller steps exist: up to 8.7 mm in the shaken beginnings of EuRoC's MH_01 and MH_02.
LEAST_SIZE = 9e-3  # [m]
BEFORE, AFTER = 1.5, 0.3  # around a step, where the ground truth is unreliable [s]
_WINDOW = 5  # increments for the median velocity of the middle one
_AROUND = 0.5  # before and after an increment, for the typical deviation [s]
_LONGEST = 0.5  # longer increments are gaps with unknown motion [s]
_USUAL = 3.0  # multiples of the typical deviation, for coarsely sampled motion


@dataclass(frozen=True)
class Step:
    """A jump of a ground truth."""

    stamp: float  # of the last pose before it [s]
    time: float  # since the first pose of the ground truth [s]
    size: float  # beyond the motion at that time [m]


def find_steps(truth):
    """Returns the steps of a trajectory: increments that differ from those of the velocity around
    them by more than LEAST_SIZE and by more than the typical deviation."""
    intervals = np.diff(truth.stamps)
    increments = np.diff(truth.positions, axis=0)
    if len(intervals) < _WINDOW:
        return ()
    excess = increments - intervals[:, None] * _running_median(increments / intervals[:, None])
    deviations = np.linalg.norm(excess, axis=1)
    # Deviations of increments grow at least with the square of the interval.
    by_square = deviations / intervals ** 2
    found = [i for i in np.flatnonzero((deviations > LEAST_SIZE) & (intervals <= _LONGEST))
             if deviations[i] > LEAST_SIZE + _USUAL * intervals[i] ** 2
             * np.percentile(by_square[_around(truth.stamps, i)], 90)]
    parts = np.split(found, np.flatnonzero(np.diff(found) >= _WINDOW) + 1) if found else []
    return tuple(Step(float(truth.stamps[part[0]]), float(truth.stamps[part[0]] - truth.stamps[0]),
                      float(np.linalg.norm(excess[part].sum(axis=0)))) for part in parts)


def without_steps(truth):
    """Returns the ground truth with its steps marked, so that associate() drops the pairs around
    them."""
    return replace(truth, steps_left_out=find_steps(truth))


def trusted(stamps, steps):
    """Returns whether each timestamp is outside the times around all steps."""
    result = np.ones(len(stamps), dtype=bool)
    for step in steps:
        result &= (stamps < step.stamp - BEFORE) | (stamps > step.stamp + AFTER)
    return result


def affecting(steps, stamps):
    """Returns the steps whose surrounding times overlap the timestamps of a trajectory."""
    return tuple(step for step in steps if step.stamp + AFTER >= stamps[0]
                 and step.stamp - BEFORE <= stamps[-1])


def describe(steps):
    """Describes times and sizes of steps in words."""
    return (", ".join(f"{1000 * step.size:.0f} mm at {step.time:.1f} s" for step in steps)
            + " after its first pose")


def _running_median(velocities):
    """Returns the median over _WINDOW rows around each row; at both ends over the outermost
    window."""
    count = len(velocities) - _WINDOW + 1
    windows = np.stack([velocities[i:i + count] for i in range(_WINDOW)], axis=-1)
    first = np.clip(np.arange(len(velocities)) - _WINDOW // 2, 0, len(windows) - 1)
    return np.median(windows, axis=-1)[first]


def _around(stamps, index):
    return slice(*np.searchsorted(stamps[:-1], stamps[index] + np.array([-_AROUND, _AROUND])))
