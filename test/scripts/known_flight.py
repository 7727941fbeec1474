# SPDX-License-Identifier: BSD-3-Clause
"""A flight with closed-form poses for the tests of scripts/evaluation."""

import os
import sys

import numpy as np

TEST = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
SCRIPTS = os.path.join(TEST, "..", "scripts")
sys.path[:0] = [SCRIPTS, os.path.join(TEST, "tools")]
from evaluation.trajectory import Trajectory, quaternions_of  # noqa: E402

START = 1403636580.0  # [s], as large as real timestamps


def rotation(axis, degrees):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def flight(rate=20.0, seconds=10.0):
    """Returns a curved motion along all axes with rotation of the body."""
    t = np.arange(0.0, seconds + 1e-9, 1.0 / rate)
    positions = np.stack([2 * np.cos(t), 3 * np.sin(0.7 * t), 0.5 * np.sin(1.3 * t)], axis=1)
    rotations = np.array([rotation((0, 0, 1), 20 * s) @ rotation((1, 0, 0), 5 * s) for s in t])
    return Trajectory(START + t, positions, rotations)


def moved(trajectory, offsets):
    return Trajectory(trajectory.stamps, trajectory.positions + offsets, trajectory.rotations)


def format_tum(trajectory):
    """Returns the trajectory as the text of a TUM file, with timestamps to the nanosecond."""
    rows = np.column_stack([trajectory.positions, quaternions_of(trajectory.rotations)])
    return "".join(f"{stamp:.9f} " + " ".join(f"{value:.9f}" for value in row) + "\n"
                   for stamp, row in zip(trajectory.stamps, rows))
