#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/stress_table.py: what it says where run_offline fails."""

import contextlib
import io
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
from stress.feature_file import (IMU, IMU_LAYOUT, POINT_STATISTICS_SIZE, POINTS,  # noqa: E402
                                 SIGNATURE, SIZE, TRACKING)
from stress_table import main  # noqa: E402

TRUTH = "".join(f"{t} {t} 0 0 0 0 0 1\n" for t in range(4))


class StressTable(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("good.feat", SIGNATURE + bytes([IMU]) + IMU_LAYOUT.pack(10**9, *range(6))
                   + bytes([POINTS]) + TRACKING.pack(10**9, False, True, 1)
                   + bytes(POINT_STATISTICS_SIZE) + SIZE.pack(0))
        self.write("truth.tum", TRUTH.encode())
        self.write("run_offline", b"#!/bin/sh\necho 'run_offline: too little motion' >&2\nexit 1\n")
        os.chmod(self.path("run_offline"), 0o755)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)

    def table(self, fault):
        """Exit code, output and errors."""
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            code = main([self.path("good.feat"), self.path("truth.tum"), "--begin", "0",
                         "--run-offline", self.path("run_offline"), "--faults", fault])
        return code, output.getvalue(), errors.getvalue()

    def test_a_fault_that_leaves_no_trajectory_says_why(self):
        code, output, _ = self.table("accel_spike")
        self.assertEqual(code, 0)
        self.assertIn("| accel_spike | no trajectory: run_offline: too little motion |", output)

    def test_an_undamaged_flight_without_a_trajectory_is_an_error(self):
        code, _, errors = self.table("none")
        self.assertEqual(code, 1)
        self.assertEqual(errors, "stress_table.py: no trajectory even without a fault: "
                                 "run_offline: too little motion\n")


if __name__ == "__main__":
    unittest.main()
