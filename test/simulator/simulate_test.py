#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the messages of simulate on invalid options.

Usage: simulate_test.py SIMULATE [unittest option ...]
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SIMULATE = sys.argv[1] if len(sys.argv) > 1 else sys.exit(__doc__)


class Simulate(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bag = self.folder / "flight.bag"
        self.bag.write_text("of before", encoding="utf-8")

    def assert_refuses(self, message, *options):
        """Expects exit code 1, an error `message`, and that an existing bag stays unchanged."""
        command = [SIMULATE, *options]
        if "--output" not in options:
            command += ["--output", self.bag]
        result = subprocess.run([str(word) for word in command], stderr=subprocess.PIPE,
                                encoding="utf-8", timeout=60, check=False)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn(message, result.stderr)
        self.assertEqual(self.bag.read_text(encoding="utf-8"), "of before")

    def test_numbers_that_are_none_or_out_of_range(self):
        for option, bounds in [("--duration", "2 to 3600"), ("--frame-rate", "1 to 200"),
                               ("--exposure", "0 to 0.05")]:
            for number in ["nan", "inf", "-1", "4000", "three", ""]:
                self.assert_refuses(f"{option}: expected {bounds} instead of {number}", option,
                                    number)

    def test_seeds_that_are_no_whole_number(self):
        for seed in ["-1", "1.5", "nan", "+1", "1e3"]:
            self.assert_refuses("expected a whole number of at least 0 instead of " + seed,
                                "--seed", seed)

    def test_paths_that_are_empty(self):
        for option in ["--asl", "--config", "--rig"]:
            self.assert_refuses(f"{option}: expected a path, but it is empty", option, "")

    def test_sensors_that_the_configuration_lacks(self):
        self.assert_refuses("--rig: gives all sensors; remove --config", "--rig", "a.yaml",
                            "--config", "b.yaml")
        self.assert_refuses("--depth: name a configuration with depth_topic", "--depth")

    def test_a_bag_in_the_place_of_the_ground_truth(self):
        self.assert_refuses("the ground truth would overwrite", "--output", "flight.tum")

    def test_files_that_are_there_already(self):
        self.assert_refuses(f"{self.bag} already exists; remove it or choose another")
        for name in ["other.tum", "other.csv"]:
            truth = self.folder / name
            truth.write_text("of another flight", encoding="utf-8")
            self.assert_refuses(f"{truth} already exists", "--output", self.folder / "other.bag",
                                "--asl", self.folder / "asl")
            self.assertEqual(truth.read_text(encoding="utf-8"), "of another flight")
            truth.unlink()
        self.assertEqual(os.listdir(self.folder), ["flight.bag"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
