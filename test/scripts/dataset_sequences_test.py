#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/dataset/sequences.py: search for recordings and ground truth."""

import os
import sys
import unittest

from folder_case import FolderTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
from dataset.errors import DatasetError  # noqa: E402
from dataset.paper import paper_sequence  # noqa: E402
from dataset.sequences import (ASL_IMAGES, ASL_IMU, ASL_TRUTHS, find_sequences,  # noqa: E402
                               select_sequences)


class SequencesTest(FolderTest):
    def touch(self, *names):
        for name in names:
            self.write(name, "")

    def find(self, *places):
        return {s.name: s for s in find_sequences([self.path(p) for p in places or ("",)])}


class Layouts(SequencesTest):
    def test_asl_folder_at_any_depth_with_its_truth(self):
        for parent in ("MH_01_easy/", "machine_hall/MH_02_easy/", "vicon/V1_01_easy/V1_01_easy/"):
            self.touch(parent + ASL_IMAGES, parent + ASL_TRUTHS[0])
        found = self.find()
        self.assertEqual(list(found), ["MH_01_easy", "MH_02_easy", "V1_01_easy"])
        nested = self.path("vicon/V1_01_easy/V1_01_easy")
        self.assertEqual(found["V1_01_easy"].path, nested)
        self.assertEqual(found["V1_01_easy"].truth, os.path.join(nested, ASL_TRUTHS[0]))
        self.assertFalse(found["V1_01_easy"].is_bag)

    def test_content_is_that_of_all_sensors(self):
        self.touch("a.bag", "b/" + ASL_IMAGES, "b/" + ASL_IMU, "c/" + ASL_IMAGES)
        files = {name: [os.path.relpath(file, self.folder) for file in s.content_files]
                 for name, s in self.find().items()}
        self.assertEqual(files, {"a": ["a.bag"], "b": ["b/" + ASL_IMAGES, "b/" + ASL_IMU],
                                 "c": ["c/" + ASL_IMAGES]})

    def test_the_asl_folder_itself_or_its_mav0(self):
        self.touch("MH_01_easy/" + ASL_IMAGES)
        for place in ("MH_01_easy", "MH_01_easy/", "MH_01_easy/mav0"):
            found = self.find(place)
            self.assertEqual(found["MH_01_easy"].path, self.path("MH_01_easy"))
            self.assertIsNone(found["MH_01_easy"].truth)

    def test_truth_of_bags(self):
        self.touch("a.bag", "a.tum", "b.bag", "b.csv", "c.bag", "d/d.bag", "d/" + ASL_TRUTHS[0],
                   "e.bag", "e/" + ASL_TRUTHS[0])
        truths = {name: s.truth and os.path.relpath(s.truth, self.folder)
                  for name, s in self.find().items()}
        self.assertEqual(truths, {"a": "a.tum", "b": "b.csv", "c": None, "d": "d/" + ASL_TRUTHS[0],
                                  "e": "e/" + ASL_TRUTHS[0]})

    def test_truth_of_tum_vi(self):
        self.touch("room1/" + ASL_IMAGES, "room1/" + ASL_TRUTHS[1])
        self.assertEqual(self.find()["room1"].truth, self.path("room1/" + ASL_TRUTHS[1]))

    def test_truth_beside_an_asl_folder(self):
        self.touch("x/" + ASL_IMAGES, "x.tum")
        self.assertEqual(self.find()["x"].truth, self.path("x.tum"))

    def test_single_bag(self):
        self.touch("a.bag", "b.bag")
        self.assertEqual(list(self.find("b.bag")), ["b"])

    def test_asl_folder_goes_before_the_bag_of_the_same_sequence(self):
        self.touch("MH_01_easy/MH_01_easy.bag", "MH_01_easy/" + ASL_IMAGES)
        self.assertFalse(self.find()["MH_01_easy"].is_bag)

    def test_links_in_a_circle(self):
        self.touch("a/a.bag")
        os.symlink(self.folder, self.path("a/again"))
        self.assertEqual(list(self.find()), ["a"])

    def test_folder_of_links(self):
        self.touch("elsewhere/" + ASL_IMAGES)
        os.mkdir(self.path("links"))
        os.symlink(self.path("elsewhere"), self.path("links/MH_01_easy"))
        self.assertEqual(list(self.find("links")), ["MH_01_easy"])


class Problems(SequencesTest):
    def assert_error(self, message, *places):
        with self.assertRaisesRegex(DatasetError, message):
            self.find(*places)

    def test_nothing_there(self):
        self.assert_error("missing: no such folder or bag", "missing")
        self.assert_error("no \\*.bag and no ASL folder")
        self.touch("sub/MH_01_easy.zip")
        self.assert_error("extract .*sub/MH_01_easy.zip first")

    def test_same_name_twice(self):
        self.touch("a/x.bag", "b/x.bag")
        self.assert_error("two recordings are called x: .*a/x.bag and .*b/x.bag; rename")


class Selection(SequencesTest):
    def setUp(self):
        super().setUp()
        self.touch("MH_01_easy.bag", "MH_01_easy_still.bag", "MH_03_medium.bag", "V1_01_easy.bag")
        self.sequences = find_sequences([self.folder])

    def select(self, *patterns):
        return [s.name for s in select_sequences(self.sequences, patterns)]

    def test_names_beginnings_and_wildcards(self):
        self.assertEqual(self.select("MH_01_easy"), ["MH_01_easy"])
        self.assertEqual(self.select("MH_01"), ["MH_01_easy", "MH_01_easy_still"])
        self.assertEqual(self.select("V1", "MH_03"), ["MH_03_medium", "V1_01_easy"])
        self.assertEqual(self.select("*_easy"), ["MH_01_easy", "MH_01_easy_still", "V1_01_easy"])

    def test_unknown(self):
        with self.assertRaisesRegex(DatasetError, "--sequences V2: .*there are MH_01_easy, "):
            self.select("MH_01", "V2")


class PaperNames(unittest.TestCase):
    def test_of_recordings(self):
        for name, expected in {"MH_01_easy": "MH_01_easy", "MH_05_difficult-weak-s1":
                               "MH_05_difficult", "MH_01_easy_0-35s": "MH_01_easy", "V102":
                               "V1_02_medium", "euroc_V2_03": "V2_03_difficult", "MH03":
                               "MH_03_medium", "V1_04_easy": None, "MH_011": None,
                               "corridor1": None}.items():
            self.assertEqual(paper_sequence(name), expected, name)


if __name__ == "__main__":
    unittest.main()
