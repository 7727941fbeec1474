#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests what run_offline says of faults of a rig's cameras, on one simulated flight.

Usage: rig_faults_test.py SIMULATE RUN_OFFLINE [unittest option ...]
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "test" / "testing")]

import pair_flight  # noqa: E402
from evaluation import metrics  # noqa: E402
from evaluation.trajectory import read_trajectory  # noqa: E402

SIMULATE, RUN_OFFLINE = sys.argv[1:3] if len(sys.argv) > 2 else sys.exit(__doc__)
SECONDS = 8
LAST_ROW = 20  # of camera 2, before it stops or freezes
MS = 1_000_000  # [ns]


class RigFaults(unittest.TestCase):
    """The rig has a pair, cameras 0 and 1, and camera 2, which looks back."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.config = pair_flight.write_config(cls.folder, "rig")
        cls.good = cls.folder / "good"
        pair_flight.simulate(SIMULATE, cls.config, "rig", SECONDS, "--motion", "fast", "--asl",
                             cls.good)

    def setUp(self):
        self.flight = self.folder / self.id()
        shutil.copytree(self.good, self.flight, copy_function=os.link)
        self.addCleanup(shutil.rmtree, self.flight)

    def rows(self, camera):
        """Returns [stamp, file] of each image."""
        text = (self.flight / "mav0" / camera / "data.csv").read_text(encoding="utf-8")
        return [row.split(",") for row in text.splitlines()[1:]]

    def set_rows(self, camera, rows):
        file = self.flight / "mav0" / camera / "data.csv"
        file.unlink()  # a hard link to the good one
        file.write_text("".join(",".join(row) + "\n" for row in [["#stamp", "file"], *rows]),
                        encoding="utf-8")

    def set_stamps(self, camera, late_ns):
        self.set_rows(camera, [[str(int(stamp) + late_ns), name]
                               for stamp, name in self.rows(camera)])

    def replace_images(self, camera, function):
        for file in (self.flight / "mav0" / camera / "data").iterdir():
            image = function(Image.open(file))
            file.unlink()
            image.save(file)

    def swap(self, one, other):
        one, other = (self.flight / "mav0" / name for name in (one, other))
        aside = one.with_name("aside")
        for source, target in ((one, aside), (other, one), (aside, other)):
            source.rename(target)

    def fly(self):
        results = self.folder / "results"
        shutil.rmtree(results, ignore_errors=True)
        command = [RUN_OFFLINE, "--config", self.config, "--asl", self.flight, "--output", results]
        return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, encoding="utf-8", check=False)

    def assert_named(self, text):
        """Returns when the run succeeds and names the fault."""
        run = self.fly()
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertRegex(run.stdout, text)

    def assert_harmless(self):
        poses = read_trajectory(self.folder / "results" / "trajectory.tum")
        truth = read_trajectory(self.good / "groundtruth.tum").at(poses.stamps)
        aligned = poses.transformed(*metrics.alignment(poses, truth, "se3"))
        self.assertLess(metrics.position_errors(aligned, truth).mean(), 0.01)

    def test_a_camera_without_images(self):
        self.set_rows("cam2", [])
        run = self.fly()
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stdout, r"no image in .*cam2/data\.csv")

    def test_a_camera_that_stops(self):
        self.set_rows("cam2", self.rows("cam2")[:LAST_ROW])
        self.assert_named(r"most wrong: .*camera ?2")
        self.assert_harmless()

    def test_a_camera_that_freezes(self):
        rows = self.rows("cam2")
        frozen = [[stamp, rows[LAST_ROW][1]] for stamp, _ in rows[LAST_ROW:]]
        self.set_rows("cam2", rows[:LAST_ROW] + frozen)
        self.assert_named(r"most wrong: .*camera ?2.*frozen")
        self.assert_harmless()

    def test_images_of_another_size(self):
        self.replace_images("cam2", lambda image: image.resize((188, 120)))
        self.assert_named(r"camera ?2.*188 x 120 px.*376 x 240")
        self.assert_harmless()

    def test_stamps_that_are_off(self):
        for late_ms in (5, 20):
            with self.subTest(late_ms):
                self.set_stamps("cam2", late_ms * MS)
                self.assert_named(r"most wrong: .*camera ?2")
                self.assert_harmless()
                self.set_stamps("cam2", -late_ms * MS)

    def test_stamps_that_are_far_off(self):
        self.set_stamps("cam2", 300 * MS)
        self.assert_named(r"most wrong: timestamps of camera 2 are wrong by about \+\d+ ms")

    def test_cameras_of_a_pair_that_are_swapped(self):
        self.swap("cam0", "cam1")
        self.assert_named("most wrong: .*camera 0 is found again in camera 1.*swapped")

    def test_front_and_back_that_are_swapped(self):
        self.swap("cam0", "cam2")
        self.assert_named(r"most wrong: .*wrong by 1[78]\d deg")

    def test_a_camera_that_is_turned_against_its_file(self):
        self.replace_images("cam2", lambda image: image.transpose(Image.ROTATE_180))
        self.assert_named(r"most wrong: body_T_cam2 is wrong by 1[78]\d deg")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
