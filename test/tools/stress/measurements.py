# SPDX-License-Identifier: BSD-3-Clause
"""The modifiable parts of a recording: IMU samples, image timestamps, image contents."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Measurements:
    """A fault changes the arrays in place; their lengths stay, since they refer to the
    recording."""

    imu_ns: np.ndarray  # (n,) int64
    gyro: np.ndarray  # (n, 3) [rad/s]
    accel: np.ndarray  # (n, 3) [m/s^2]
    image_ns: np.ndarray  # (m,) int64
    imu_kept: np.ndarray = None  # (n,) bool; False: the sample is dropped
    points_kept: np.ndarray = None  # (m,) bool; False: no point is tracked in the image
    lines_kept: np.ndarray = None  # (m,) bool
    shown: np.ndarray = None  # (m,) int; index of the image that replaces it

    def __post_init__(self):
        self.imu_kept = np.ones(len(self.imu_ns), dtype=bool)
        self.points_kept = np.ones(len(self.image_ns), dtype=bool)
        self.lines_kept = np.ones(len(self.image_ns), dtype=bool)
        self.shown = np.arange(len(self.image_ns))

    @property
    def duration(self):
        """Time from the first image to the end of images or IMU samples [s]."""
        return (min(self.imu_ns.max(), self.image_ns.max()) - self.image_ns[0]) * 1e-9

    def image_at(self, seconds):
        """Returns the index of the first image at or after a time since the first image."""
        return int(np.searchsorted(self.image_ns, self._nanoseconds(seconds)))

    def imu_at(self, seconds):
        """Returns the index of the first IMU sample at or after a time since the first image."""
        return int(np.searchsorted(self.imu_ns, self._nanoseconds(seconds)))

    def _nanoseconds(self, seconds):
        return self.image_ns[0] + int(seconds * 1e9)
