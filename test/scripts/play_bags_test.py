#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What play_bags.py plays, and what it says where there is no bag."""

import os
import pathlib
import subprocess
import tempfile
import unittest

PLAY_BAGS = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "play_bags.py"


class PlayBags(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ["day 1/a_0.bag", "day 1/a_1.bag", "day 1/notes.txt", "b.bag"]:
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).touch()
        rosrun = self.folder / "bin" / "rosrun"  # in place of that of ROS: shows its arguments
        rosrun.parent.mkdir()
        rosrun.write_text('#!/bin/sh\nprintf "%s\\n" "$@"\n')
        rosrun.chmod(0o755)

    def play(self, bags):
        return subprocess.run([str(PLAY_BAGS), bags, "--clock", "--rate", "2"], encoding="utf-8",
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                              env={**os.environ, "HOME": str(self.folder),
                                   "PATH": f"{self.folder}/bin:{os.environ['PATH']}"})

    def assert_plays(self, text, *names):
        lines = self.play(text).stdout.splitlines()
        self.assertEqual(lines[:5], ["rosbag", "play", "--clock", "--rate", "2"])
        self.assertEqual(lines[5:], [str(self.folder / name) for name in names])

    def test_one_file_with_a_blank_in_its_path(self):
        self.assert_plays(f"{self.folder}/day 1/a_0.bag", "day 1/a_0.bag")

    def test_several_files(self):
        self.assert_plays(f"'{self.folder}/day 1/a_1.bag' {self.folder}/b.bag",
                          "day 1/a_1.bag", "b.bag")

    def test_folders_and_patterns(self):
        both = ("day 1/a_0.bag", "day 1/a_1.bag")
        self.assert_plays(f"{self.folder}/day 1", *both)
        self.assert_plays(f"'{self.folder}/day 1/*.bag'", *both)
        self.assert_plays(f"{self.folder}/*.bag ~/b.bag", "b.bag")

    def test_no_bag(self):
        for place in ["none.bag", "none*.bag", "bin"]:
            result = self.play(f"{self.folder}/{place}")
            self.assertEqual(result.returncode, 1)
            self.assertIn(f"no bag {self.folder}/{place}: give an absolute path", result.stderr)


if __name__ == "__main__":
    unittest.main()
