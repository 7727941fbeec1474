#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests which measurements the faults of test/tools/stress change and which they keep."""

import os
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
from stress.faults import FAULTS  # noqa: E402
from stress.measurements import Measurements  # noqa: E402

START_NS = 1403636579758555392


def flight(seconds=4):
    """IMU at 200 Hz, images at 20 Hz."""
    samples, images = 200 * seconds, 20 * seconds
    values = np.tile([0.1, 0.2, 0.3], (samples, 1))
    return Measurements(START_NS + 5_000_000 * np.arange(samples), values.copy(), 9 + values,
                        START_NS + 50_000_000 * np.arange(images))


class Faults(unittest.TestCase):
    def damaged(self, name, begin=1.0):
        measurements = flight()
        FAULTS[name].apply(measurements, begin)
        return measurements

    def test_nothing_changes_before_the_fault(self):
        for name in set(FAULTS) - {"image_delay"}:
            good, bad = flight(), self.damaged(name, begin=2.0)
            for field in ("imu_ns", "gyro", "accel", "imu_kept"):
                np.testing.assert_array_equal(getattr(bad, field)[:400], getattr(good, field)[:400],
                                              f"{name} {field}")
            np.testing.assert_array_equal(bad.image_ns[:40], good.image_ns[:40], name)

    def test_every_fault_but_none_changes_something(self):
        for name in FAULTS:
            good, bad = flight(), self.damaged(name)
            same = all(np.array_equal(getattr(good, field), getattr(bad, field))
                       for field in vars(good))
            # The flight is at standstill and thus far from the limits of a sensor.
            unchanged = ("none", "imu_saturated", "imu_held_100ms", "imu_held_1s")
            self.assertEqual(same, name in unchanged, name)

    def test_a_fault_that_would_begin_after_the_end(self):
        for name in set(FAULTS) - {"none", "image_delay"}:
            with self.assertRaisesRegex(ValueError, "--begin 9: the recording lasts 4.0 s"):
                self.damaged(name, begin=9)
            with self.assertRaisesRegex(ValueError, "--begin 3.99: "):  # there is no later image
                self.damaged(name, begin=3.99)
        self.damaged("none", begin=9)
        self.damaged("image_delay", begin=9)

    def test_sizes(self):
        self.assertAlmostEqual(
            np.linalg.norm(self.damaged("gyro_bias_step").gyro[-1] - flight().gyro[-1]), 0.05)
        self.assertEqual((self.damaged("accel_spike").accel == 150).sum(), 1)
        self.assertEqual((self.damaged("gyro_three").gyro == 40).sum(), 3)
        self.assertEqual((self.damaged("accel_spikes_1hz").accel == 150).sum(), 3)
        self.assertEqual(self.damaged("imu_halved").imu_kept.sum(), 200 + 300)
        jitter = self.damaged("image_jitter").image_ns - flight().image_ns
        self.assertLessEqual(abs(jitter).max(), 5_000_000)
        self.assertGreater(abs(jitter).max(), 4_000_000)


if __name__ == "__main__":
    unittest.main()
