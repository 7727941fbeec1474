#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of test/tools/stress_table.py with a shell script instead of run_offline."""

import json
import os
import unittest

from known_flight import START, flight, format_tum, moved  # first: it names the folder
from evaluation.trajectory import RESTART
from folder_case import FolderTest, call
from stress.feature_file import (IMU, IMU_LAYOUT, POINT_STATISTICS_SIZE, POINTS, SIGNATURE, SIZE,
                                 TRACKING)
from stress_table import main

START_NS = round(START * 1e9)
FAIL = """echo 'run_offline: FILE:1: a problem' >&2
echo 'run_offline: too little motion' >&2
echo 'a library ends' >&2
exit 1
"""
FLY = 'mkdir "$6" && cp "$(dirname "$0")"/trajectory.tum "$(dirname "$0")"/summary.json "$6"\n'


class StressTable(FolderTest):
    def setUp(self):
        super().setUp()
        self.write("good.feat", SIGNATURE + SIZE.pack(2) + b"{}" + b"".join(
            bytes([IMU]) + IMU_LAYOUT.pack(t_ns, *range(6))
            + bytes([POINTS]) + TRACKING.pack(t_ns, False, True, 1)
            + bytes(POINT_STATISTICS_SIZE) + SIZE.pack(0)
            for t_ns in (START_NS, START_NS + 5 * 10**9)))
        self.write("truth.tum", format_tum(flight()).encode())

    def write_trajectory(self):
        """Writes exact poses up to 8 s, after which a new world starts 7 m away."""
        poses = flight()
        first, second = (poses.select(part) for part in (slice(0, 160), slice(160, None)))
        text = format_tum(first) + RESTART + ": lost\n" + format_tum(moved(second, [7, 0, 0]))
        self.write("trajectory.tum", text.encode())
        summary = {"dropped": {"imu_replaced": 3, "imu_gaps": 0}, "imu_doubts": 1,
                   "bridged_losses": 0, "imu_noisy_share": 0.25}
        self.write("summary.json", json.dumps(summary).encode())

    def table(self, script, *arguments):
        """Returns exit code, output and errors."""
        self.write("run_offline", b"#!/bin/sh\n" + script.encode())
        os.chmod(self.path("run_offline"), 0o755)
        result = call(main, self.path("good.feat"), self.path("truth.tum"), "--begin", "2",
                      "--run-offline", self.path("run_offline"), *arguments)
        return result.returncode, result.stdout, result.stderr

    def test_each_world_is_aligned_and_what_was_noticed_is_named(self):
        self.write_trajectory()
        code, output, errors = self.table(FLY, "--faults", "none", "accel_spike")
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(output.count("| fault "), 1)
        for name in ("none", "accel_spike"):
            self.assertIn(f"| {name} | 0.000 | 0.00 | 6.0 | 100 % | imu_replaced 3, imu_doubts 1,"
                          " IMU noisy 25 % |\n", output)

    def test_a_fault_that_leaves_no_trajectory_says_why(self):
        code, output, _ = self.table(FAIL, "--faults", "accel_spike")
        self.assertEqual(code, 0)
        self.assertIn("| accel_spike | no trajectory: run_offline: too little motion |\n", output)
        self.assertIn("| accel_spike | no trajectory: run_offline ended with 3 |\n",
                      self.table("exit 3\n", "--faults", "accel_spike")[1])

    def test_an_undamaged_flight_without_a_trajectory_is_an_error(self):
        code, output, errors = self.table(FAIL)
        self.assertEqual((code, output), (1, ""))
        self.assertEqual(errors, "stress_table.py: no trajectory even without a fault: "
                                 "run_offline: too little motion\n")

    def test_faults_after_the_end_are_refused(self):
        code, _, errors = self.table(FLY, "--faults", "accel_spike", "--begin", "24")
        self.assertEqual(code, 1)
        self.assertEqual(errors, "stress_table.py: --begin 24: the recording lasts 5.0 s\n")


if __name__ == "__main__":
    unittest.main()
