#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests which data of a feature file the faults of test/tools/stress change and which they keep."""

import os
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
from stress.faults import FAULTS  # noqa: E402
from stress.feature_file import (IMU, IMU_LAYOUT, LINE_SIZE, LINE_STATISTICS_SIZE,  # noqa: E402
                                 POINT, POINT_STATISTICS_SIZE, POINTS, POINTS_AND_LINES, SIGNATURE,
                                 SIZE, TRACKING, Features, make_faulty)
from stress.measurements import Measurements  # noqa: E402

START_NS = 1403636579758555392
HEADER = SIGNATURE + SIZE.pack(11) + b'{"freq":10}'


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
            self.assertEqual(same, name in ("none", "imu_saturated", "imu_held_100ms"), name)

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


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.good, self.bad = (os.path.join(folder.name, name) for name in ("good", "bad"))

    def damaged(self, content, fault, begin=0.0):
        """Returns the bytes of a file with the fault."""
        with open(self.good, "wb") as file:
            file.write(content)
        make_faulty(self.good, self.bad, FAULTS[fault].apply, begin)
        with open(self.bad, "rb") as file:
            return file.read()

    def test_faults_of_samples_and_points(self):
        """Twenty samples, with an image of two points after every tenth."""
        content = HEADER
        for i in range(20):
            content += bytes([IMU]) + IMU_LAYOUT.pack(START_NS + 5_000_000 * i, *range(6))
            if i % 10 == 0:
                content += bytes([POINTS]) + TRACKING.pack(START_NS + 5_000_000 * i, False, True, 1)
                content += bytes(POINT_STATISTICS_SIZE) + SIZE.pack(2) + bytes(2 * POINT.itemsize)
        self.assertEqual(self.damaged(content, "none"), content)
        for fault, size in (("imu_halved", -10 * (1 + IMU_LAYOUT.size)),
                            ("points_gone_10s", -4 * POINT.itemsize), ("accel_spike", 0)):
            self.assertEqual(len(self.damaged(content, fault)) - len(content), size, fault)
        self.assertEqual(Features(self.bad).measurements().accel[0, 0], 150)

    def test_a_repeated_image(self):
        content = HEADER + bytes([IMU]) + IMU_LAYOUT.pack(START_NS, *range(6))
        for i in range(3):
            points = np.zeros(1 + i, POINT)
            points["uv"], points["velocity"] = 7 * i, 0.5
            head = TRACKING.pack(START_NS + 50_000_000 * i, False, True, 1)
            content += (bytes([POINTS_AND_LINES]) + head + bytes(POINT_STATISTICS_SIZE)
                        + SIZE.pack(len(points)) + points.tobytes() + head
                        + bytes(LINE_STATISTICS_SIZE) + SIZE.pack(1) + bytes([i]) * LINE_SIZE)
        content += bytes([IMU]) + IMU_LAYOUT.pack(START_NS + 200_000_000, *range(6))
        bad = self.damaged(content, "image_frozen_3s", begin=0.09)
        repeated = np.zeros(2, POINT)
        repeated["uv"] = 7
        self.assertIn(TRACKING.pack(START_NS + 100_000_000, False, True, 1)
                      + bytes(POINT_STATISTICS_SIZE) + SIZE.pack(2) + repeated.tobytes(), bad)
        self.assertEqual((bad.count(bytes([1]) * LINE_SIZE), bad.count(bytes([2]) * LINE_SIZE)),
                         (2, 0))

    def test_a_truncated_or_damaged_file_is_refused(self):
        head, points = TRACKING.pack(START_NS, False, True, 1), bytes(2 * POINT.itemsize)
        content = (HEADER + bytes([IMU]) + IMU_LAYOUT.pack(START_NS, *range(6))
                   + bytes([POINTS_AND_LINES]) + head + bytes(POINT_STATISTICS_SIZE)
                   + SIZE.pack(2) + points + head + bytes(LINE_STATISTICS_SIZE) + SIZE.pack(2)
                   + bytes(2 * LINE_SIZE))
        for damaged in (*(content[:size] for size in range(len(content))), content + b"\x07"):
            with self.assertRaisesRegex(ValueError, self.good):
                self.damaged(damaged, "none")
            self.assertFalse(os.path.exists(self.bad))
        self.assertEqual(self.damaged(content, "none"), content)


if __name__ == "__main__":
    unittest.main()
