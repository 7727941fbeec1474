#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of test/tools/measure_starts.py with a shell script instead of run_offline."""

import os
import unittest

import numpy as np

from known_flight import START, flight, format_tum, moved  # first: it names the folder
from folder_case import FolderTest, call
from measure_starts import main

LATE = 0.8  # first pose after the first image [s]
FLY = """#!/bin/sh
echo 'no pose for 0.8 of 10.0 s: too little parallax (0.8 s)' >&2
while [ "$1" != --output ]; do shift; done
mkdir "$2" && cp "$(dirname "$0")"/run/* "$2"
"""
FAIL = "#!/bin/sh\necho 'run_offline: too little motion' >&2\nexit 1\n"


class MeasureStarts(FolderTest):
    def setUp(self):
        super().setUp()
        self.write("flight.tum", format_tum(flight()).encode())
        self.write("flight.bag", b"")
        os.mkdir(self.path("run"))

    def write_run(self, error, deviation):
        """Writes poses that are off by `error` [m] upwards two seconds after the first one."""
        poses = flight()
        poses = poses.select(poses.stamps >= START + LATE - 1e-6)
        offsets = np.zeros((len(poses), 3))
        offsets[40, 2] = error
        self.write("run/trajectory.tum", format_tum(moved(poses, offsets)).encode())
        self.write("run/timing.csv", f"stamp_ns,total\n{START * 1e9:.0f},1\n".encode())
        covariance = np.diag([deviation, deviation, deviation, 1, 1, 1]) ** 2 / 2
        triangle = ",".join(str(value) for value in covariance[np.triu_indices(6)])
        rows = [f"{stamp * 1e9:.0f},{triangle}\n" for stamp in poses.stamps]
        self.write("run/covariance.csv", ("stamp_ns\n" + "".join(rows)).encode())

    def measure(self, script):
        self.write("run_offline", script.encode())
        os.chmod(self.path("run_offline"), 0o755)
        result = call(main, self.path("flight.bag"), "--last", "0.5", "--details",
                      "--run-offline", self.path("run_offline"))
        self.assertEqual(result.returncode, 0)
        return result.stdout

    def test_time_errors_and_sureness_of_a_start(self):
        self.write_run(error=0.06, deviation=0.01)
        output = self.measure(FLY)
        self.assertIn(" 0.50   0.80      0.0     60.0    17.3   3.46", output)
        self.assertIn("too little parallax (0.8 s)", output)
        self.assertIn("| flight.bag | 2 | 0 | 0.80 | 0.80 | 0.80 | 0.0 | 0 | 60.0 | 60 | 17.3 |"
                      " 36.0 | 36.0 | 0 | 0 |", output)
        self.write_run(error=0.08, deviation=0.01)
        self.assertIn("| 64.0 | 64.0 | 2 | 0 |", self.measure(FLY))

    def test_start_without_a_pose_says_why(self):
        output = self.measure(FAIL)
        self.assertIn("run_offline: too little motion", output)
        self.assertIn("| flight.bag | 2 | 2 | nan |", output)


if __name__ == "__main__":
    unittest.main()
