#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests run_offline on simulated flights with several cameras, and with depth images.

Usage: pair_flight_test.py SIMULATE RUN_OFFLINE [unittest option ...]
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "test" / "testing")]

import pair_flight  # noqa: E402
from evaluation import metrics  # noqa: E402
from evaluation.trajectory import read_trajectory  # noqa: E402

SIMULATE, RUN_OFFLINE = sys.argv[1:3] if len(sys.argv) > 2 else sys.exit(__doc__)
SECONDS = 4
# Counts of summary.json.
USED = {"stereo": ["matched_used"], "depth": ["depths_used"],
        "rig": ["matched_used", "depths_used"]}


class PairFlight(unittest.TestCase):
    """One flight of a pair, a camera that looks back and depth images; a configuration uses those
    that it names."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.bag = cls.folder / "flight.bag"
        pair_flight.simulate(SIMULATE, pair_flight.write_config(cls.folder, "rig"), "rig", SECONDS,
                             "--output", cls.bag, "--asl", cls.folder / "flight")

    def run_offline(self, config, *source):
        """Returns the summary."""
        results = self.folder / "results"
        command = [RUN_OFFLINE, "--config", config, *source, "--output", results]
        result = subprocess.run([str(word) for word in command], stderr=subprocess.PIPE,
                                encoding="utf-8", check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads((results / "summary.json").read_text(encoding="utf-8"))

    def assert_error_is_small(self):
        poses = read_trajectory(self.folder / "results" / "trajectory.tum")
        truth = read_trajectory(self.folder / "flight.tum").at(poses.stamps)
        rotation, translation = metrics.alignment(poses, truth, "se3")
        errors = metrics.position_errors(poses.transformed(rotation, translation), truth)
        self.assertLess(errors.mean(), 0.02)

    def assert_uses(self, sensor, *source):
        summary = self.run_offline(pair_flight.write_config(self.folder, sensor), *source)
        for count in USED["rig"]:
            figures = summary["counts_per_frame"][count]
            if count in USED[sensor]:
                self.assertGreater(figures["median"], 100, count)
            else:
                self.assertEqual(figures["mean"], 0, count)
        self.assertGreater(summary["poses"], summary["frames"] - 8)
        self.assert_error_is_small()

    def test_second_camera(self):
        self.assert_uses("stereo", "--bag", self.bag)

    def test_depth(self):
        self.assert_uses("depth", "--asl", self.folder / "flight")

    def test_pair_with_depth_and_a_camera_that_looks_back(self):
        for source in (("--bag", self.bag), ("--asl", self.folder / "flight")):
            self.assert_uses("rig", *source)

    def test_depths_of_another_unit_change_nothing(self):
        config = pair_flight.write_config(self.folder, "depth")
        trajectory = self.folder / "results" / "trajectory.tum"
        summary = self.run_offline(config, "--bag", self.bag, "--set", "depth_unit=0.01")
        self.assertIn("depths are 10.", summary["findings"][0])
        estimated = trajectory.read_bytes()
        self.run_offline(pair_flight.write_config(self.folder, "mono"), "--bag", self.bag)
        self.assertEqual(estimated, trajectory.read_bytes())

    def test_one_camera(self):
        config = pair_flight.write_config(self.folder, "mono")
        summary = self.run_offline(config, "--bag", self.bag)
        for count in USED["rig"]:
            self.assertEqual(summary["counts_per_frame"][count]["mean"], 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
