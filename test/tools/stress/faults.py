# SPDX-License-Identifier: BSD-3-Clause
"""The faults by name. Each takes Measurements and its begin, as the time since the first image [s].
Permanent faults last to the end, unless their name states a duration."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

DIRECTION = np.array([1.0, -1.0, 1.0]) / np.sqrt(3)  # of vectors that are added: all axes
SEED = 1  # of the jitter


@dataclass
class Fault:
    """`change(measurements, begin)` applies the fault."""

    what: str
    change: Callable
    ignores_begin: bool = False

    def apply(self, measurements, begin):
        """Raises ValueError if the recording ends before the fault begins."""
        duration = measurements.duration
        if not self.ignores_begin and begin > duration:
            raise ValueError(f"--begin {begin:g}: the recording lasts {duration:.1f} s")
        self.change(measurements, begin)


def _step(field, size):
    def apply(measurements, begin):
        getattr(measurements, field)[measurements.imu_at(begin):] += size * DIRECTION
    return apply


def _spikes(field, value, samples=1, period=None):
    """Replaces the reading of the first axis by `value`, once or every `period` seconds."""
    def apply(measurements, begin):
        last = measurements.imu_ns[-1] - measurements.image_ns[0]
        times = [begin] if period is None else np.arange(begin, last * 1e-9, period)
        for time in times:
            first = measurements.imu_at(time)
            getattr(measurements, field)[first:first + samples, 0] = value
    return apply


def _hold(seconds):
    def apply(measurements, begin):
        first, last = measurements.imu_at(begin), measurements.imu_at(begin + seconds)
        for values in (measurements.gyro, measurements.accel):
            values[first:last] = values[first]
    return apply


def _clip(gyro, accel):
    def apply(measurements, begin):
        first = measurements.imu_at(begin)
        np.clip(measurements.gyro[first:], -gyro, gyro, out=measurements.gyro[first:])
        np.clip(measurements.accel[first:], -accel, accel, out=measurements.accel[first:])
    return apply


def _decimate(factor):
    def apply(measurements, begin):
        first = measurements.imu_at(begin)
        measurements.imu_kept[first:] = np.arange(len(measurements.imu_ns) - first) % factor == 0
    return apply


def _lose_imu(seconds):
    def apply(measurements, begin):
        first, last = measurements.imu_at(begin), measurements.imu_at(begin + seconds)
        measurements.imu_kept[first:last] = False
    return apply


def _jitter_images(seconds):
    def apply(measurements, begin):
        first = measurements.image_at(begin)
        random = np.random.default_rng(SEED)
        shifts = random.uniform(-seconds, seconds, len(measurements.image_ns) - first)
        measurements.image_ns[first:] += (shifts * 1e9).astype(np.int64)
    return apply


def _shift_images(seconds):
    def apply(measurements, begin):
        measurements.image_ns[measurements.image_at(begin):] += int(seconds * 1e9)
    return apply


def _freeze(seconds):
    def apply(measurements, begin):
        first, last = measurements.image_at(begin), measurements.image_at(begin + seconds)
        measurements.shown[first:last] = max(0, first - 1)
    return apply


def _blind(seconds, *features):
    def apply(measurements, begin):
        first, last = measurements.image_at(begin), measurements.image_at(begin + seconds)
        for feature in features:
            getattr(measurements, feature)[first:last] = False
    return apply


FAULTS = {
    "none": Fault("undamaged", lambda measurements, begin: None, ignores_begin=True),
    "gyro_bias_step": Fault("bias of the gyro + 0.05 rad/s", _step("gyro", 0.05)),
    "accel_bias_step": Fault("bias of the accelerometer + 0.5 m/s^2", _step("accel", 0.5)),
    "accel_spike": Fault("one sample of 150 m/s^2", _spikes("accel", 150)),
    "gyro_spike": Fault("one sample of 40 rad/s", _spikes("gyro", 40)),
    "gyro_three": Fault("three samples of 40 rad/s", _spikes("gyro", 40, samples=3)),
    "accel_spikes_1hz": Fault("150 m/s^2 once a second", _spikes("accel", 150, period=1.0)),
    "gyro_spikes_1hz": Fault("40 rad/s once a second", _spikes("gyro", 40, period=1.0)),
    "accel_huge": Fault("one sample of 1e6 m/s^2", _spikes("accel", 1e6)),
    "imu_held_100ms": Fault("the IMU repeats one reading for 0.1 s", _hold(0.1)),
    "imu_held_1s": Fault("the IMU repeats one reading for 1 s", _hold(1)),
    "imu_lost_200ms": Fault("no IMU for 0.2 s", _lose_imu(0.2)),
    "imu_saturated": Fault("readings end at 1.5 rad/s and 13 m/s^2", _clip(1.5, 13.0)),
    "imu_halved": Fault("every second IMU sample is missing", _decimate(2)),
    "image_jitter": Fault("stamps of images jitter by +-5 ms", _jitter_images(0.005)),
    "image_step": Fault("stamps of images + 20 ms", _shift_images(0.02)),
    "image_delay": Fault("stamps of images + 30 ms, from the first one on",
                         lambda measurements, begin: _shift_images(0.03)(measurements, 0),
                         ignores_begin=True),
    "image_frozen_3s": Fault("the camera repeats its last image for 3 s", _freeze(3)),
    "points_gone_10s": Fault("no points for 10 s", _blind(10, "points_kept")),
    "blind_10s": Fault("neither points nor lines for 10 s",
                       _blind(10, "points_kept", "lines_kept")),
}
