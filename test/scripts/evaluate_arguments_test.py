#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests which files and numbers scripts/evaluate.py accepts as arguments."""

import os
import unittest

from known_flight import flight, format_tum  # first: it names the folder
from evaluate import main, parse_arguments
from evaluation.trajectory import TRUTH_IN_FOLDER, TrajectoryError, read_truth
from folder_case import FolderTest, call


class Folders(FolderTest):
    def setUp(self):
        super().setUp()
        self.file = self.write("flight.tum", format_tum(flight()))

    def test_an_asl_folder_has_its_ground_truth(self):
        self.write(os.path.join("MH_01_easy", "mav0", TRUTH_IN_FOLDER), format_tum(flight()))
        for folder in ("MH_01_easy", os.path.join("MH_01_easy", "mav0")):
            path = self.path(folder)
            self.assertEqual(len(read_truth(path)), len(flight()))
            self.assertIn("coverage 100.0 %", call(main, self.file, path).stdout)

    def test_other_folders_are_said_to_be_folders(self):
        self.assert_refused(main, f"{self.folder}: a folder; give a file in it, such as"
                                  " trajectory.tum", self.folder, self.file)
        self.assert_refused(main, f"{self.folder}: a folder without "
                                  + os.path.join(self.folder, "mav0", TRUTH_IN_FOLDER),
                            self.file, self.folder)
        with self.assertRaisesRegex(TrajectoryError, "no such file"):
            read_truth(os.path.join(self.folder, "missing"))


class Seconds(unittest.TestCase):
    def assert_refused(self, message, *arguments):
        result = call(parse_arguments, "a.tum", "b.tum", *arguments)
        self.assertEqual(result.returncode, 2)
        self.assertIn(message, result.stderr)

    def test_what_is_none_is_refused(self):
        for option in ("--max-diff", "--max-gap", "--nees-after"):
            self.assert_refused(f"{option}: expected seconds, at least 0, instead of -1",
                                f"{option}=-1")
            for text in ("nan", "inf", "soon"):
                self.assert_refused(f"{option}: expected seconds instead of {text}", option, text)
        self.assert_refused("--t-offset: expected seconds instead of nan", "--t-offset", "nan")

    def test_an_offset_may_be_negative(self):
        self.assertEqual(parse_arguments(["a", "b", "--t-offset", "-1.5"]).t_offset, -1.5)


if __name__ == "__main__":
    unittest.main()
