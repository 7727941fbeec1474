#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the messages of scripts/evaluate.py on unsuitable files."""

import unittest

import numpy as np

from known_flight import START, flight, format_tum, moved, rotation  # first: it names the folder
from evaluate import main
from evaluation.trajectory import read_trajectory
from folder_case import FolderTest, call


class MistakeTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.truth = self.write("truth.tum", format_tum(flight(rate=200.0)))
        self.rows = np.array([line.split() for line in self.text().splitlines()], dtype=float)

    @staticmethod
    def text():
        """Returns a flight of 9 s, rotated and noisy, in TUM format."""
        estimate = flight(seconds=9.0)
        noise = np.random.default_rng(1).normal(0, 0.01, estimate.positions.shape)
        return format_tum(moved(estimate, noise).transformed(rotation((0, 0.6, 0.8), 50),
                                                             np.ones(3)))

    def write_rows(self, name, rows, separator=" ", stamp="%.9f"):
        path = self.path(name)
        np.savetxt(path, rows, fmt=[stamp] + ["%.9f"] * (rows.shape[1] - 1), delimiter=separator)
        return path

    def messages(self, *arguments):
        """Returns the stderr output of a successful call."""
        result = call(main, *arguments)
        self.assertEqual(result.returncode, 0)
        return result.stderr


class Units(MistakeTest):
    def test_stamps_of_tum_are_seconds(self):
        for unit, per_second in (("milliseconds", 1e3), ("microseconds", 1e6),
                                 ("nanoseconds", 1e9)):
            rows = self.rows.copy()
            rows[:, 0] *= per_second
            path = self.write_rows("odd.tum", rows, stamp="%.0f")
            for files in ((path, self.truth), (self.truth, path)):
                self.assert_refused(main, f"{path}: its stamps look like {unit} instead of seconds;"
                                          f" multiply the first column by {1 / per_second:g}",
                                    *files)

    def test_also_where_they_begin_at_zero(self):
        for rate in (5, 20, 200, 1000):
            rows = self.rows.copy()
            rows[:, 0] = np.round(np.arange(len(rows)) * 1e9 / rate)
            path = self.write_rows("odd.tum", rows, stamp="%.0f")
            self.assert_refused(main, "its stamps look like nanoseconds", path, self.truth)

    def test_tum_with_commas(self):
        for begin in (0.0, START):
            rows = self.rows.copy()
            rows[:, 0] += begin - START
            path = self.write_rows("odd.tum", rows, ",")
            self.assert_refused(main, f"{path}: has commas, but its stamps look like seconds; for"
                                      " rows of stamp x y z qx qy qz qw, replace the commas by"
                                      " spaces", path, self.truth)

    def test_slow_tum_with_commas(self):
        path = self.write_rows("odd.tum", self.rows[::2], ",")  # 10 Hz: as if of milliseconds
        self.assert_refused(main, "its stamps look like seconds", path, self.truth)

    def test_columns_of_other_formats(self):
        for rows, hint in ((self.rows[:, :4], "4 columns, expected 8 columns (TUM); for positions"),
                           (np.ones((5, 12)), "12 columns, expected 8 columns (TUM); 12 look like"
                                              " KITTI poses without stamps")):
            self.assert_refused(main, hint, self.write_rows("odd.tum", rows), self.truth)

    def test_decimal_commas(self):
        path = self.write("odd.tum", self.text().replace(".", ","))
        self.assert_refused(main, ":1: decimal commas; replace them", path, self.truth)

    def test_csv_with_spaces(self):
        rows = self.rows[:, Quaternions.ORDER]
        rows[:, 0] *= 1e9
        path = self.write_rows("good.csv", rows, ", ", "%.0f")
        self.assertEqual(self.messages(path, self.truth), "")

    def test_positions_in_millimeters(self):
        rows = self.rows.copy()
        rows[:, 1:4] *= 1e3
        path = self.write_rows("odd.tum", rows)
        self.assertRegex(self.messages(path, self.truth),
                         r"are (1e\+03|99\d|100\d) times those of the ground truth; are both in"
                         " meters")

    def test_csv_in_microseconds(self):
        rows = self.rows.copy()
        rows[:, 0] *= 1e6
        self.assert_refused(main, "its stamps look like microseconds instead of nanoseconds;"
                                  " multiply the first column by 1000",
                            self.write_rows("odd.csv", rows, ",", "%.0f"), self.truth)

    def test_right_units_are_taken_from_any_beginning_at_any_rate(self):
        for begin in (0.0, 0.5, 100.0, 5e6, START):
            for rate in (0.2, 20, 1000):
                rows = self.rows.copy()
                rows[:, 0] = begin + np.arange(len(rows)) / rate
                read = read_trajectory(self.write_rows("good.tum", rows))
                np.testing.assert_allclose(read.stamps, rows[:, 0], atol=1e-6)
                rows[:, 0] *= 1e9
                read = read_trajectory(self.write_rows("good.csv", rows, ",", "%.0f"))
                np.testing.assert_allclose(read.stamps, 1e-9 * rows[:, 0], atol=1e-6)

    def test_semicolons_and_headings(self):
        path = self.write_rows("odd.tum", self.rows, ";")
        self.assert_refused(main, ":1: 1 columns, expected 8 columns (TUM); replace the semicolons"
                                  " by spaces", path, self.truth)
        path = self.write("odd.tum", "stamp x y z qx qy qz qw\n" + self.text())
        self.assert_refused(main, ":1: not a number (could not convert string to float: 'stamp');"
                                  " begin a heading with #", path, self.truth)

    def test_clocks_that_differ(self):
        rows = self.rows.copy()
        rows[:, 0] += 37.0
        path = self.write_rows("odd.tum", rows)
        self.assert_refused(main, "where their clocks differ, give --t-offset", path, self.truth)
        self.assertEqual(self.messages(path, self.truth, "--t-offset", "-37"), "")


class Quaternions(MistakeTest):
    ORDER = [0, 1, 2, 3, 7, 4, 5, 6]  # w first

    def test_w_first_in_tum(self):
        estimate = self.write_rows("estimate.tum", self.rows)
        odd = self.write_rows("odd.tum", self.rows[:, self.ORDER])
        truth_rows = np.loadtxt(self.truth)
        odd_truth = self.write_rows("odd_truth.tum", truth_rows[:, self.ORDER])
        self.assertEqual(self.messages(estimate, self.truth), "")
        for files, which in (((odd, self.truth), odd), ((estimate, odd_truth), odd_truth),
                             ((odd, odd_truth), "both files")):
            self.assertRegex(self.messages(*files),
                             r"evaluate.py: warning: attitudes differ by \d+ deg, but by \d.\d deg"
                             f" if the quaternions of {which} are qw qx qy qz; reorder")

    def test_w_last_in_csv(self):
        rows = self.rows.copy()
        rows[:, 0] *= 1e9
        odd = self.write_rows("odd.csv", rows, ",", "%.0f")
        self.assertIn(f"if the quaternions of {odd} are qx qy qz qw",
                      self.messages(odd, self.truth))
        good = self.write_rows("good.csv", rows[:, self.ORDER], ",", "%.0f")
        self.assertEqual(self.messages(good, self.truth), "")

    def test_wrong_attitudes_of_another_kind_are_not_explained(self):
        estimate = flight()
        for turn in (rotation((1, 0, 0), 90), rotation((0.6, 0, 0.8), 45)):
            estimate.rotations[:] = estimate.rotations @ turn
            path = self.write("turned.tum", format_tum(estimate))
            self.assertEqual(self.messages(path, self.truth), "")


class Inverted(MistakeTest):
    def test_poses_of_the_world_in_the_body(self):
        path = self.write("odd.tum", format_tum(flight(seconds=9.0).inverse()))
        self.assertRegex(self.messages(path, self.truth),
                         r"APE is \S+ m, but \S+ m if the poses of \S+ are those of the world"
                         " in the body; invert them")


class Swapped(MistakeTest):
    def assert_swapped(self, first, second):
        self.assertIn(f"warning: {first} looks like the ground truth and {second} like the"
                      " estimate; give the estimate first", self.messages(first, second))

    def test_by_rate(self):
        estimate = self.write("estimate.tum", self.text())
        self.assertEqual(self.messages(estimate, self.truth), "")
        self.assert_swapped(self.truth, estimate)

    def test_by_the_results_of_a_run(self):
        estimate = self.write("run/trajectory.tum", self.text())
        self.write("run/summary.json", "{}")
        truth = self.write("truth20.tum", format_tum(flight(rate=20.0)))
        self.assertEqual(self.messages(estimate, truth), "")
        self.assert_swapped(truth, estimate)

    def test_by_worlds(self):
        lines = self.text().splitlines(keepends=True)
        lines.insert(50, "# the world frame starts anew: lost\n")
        estimate = self.write("estimate.tum", "".join(lines))
        truth = self.write("truth20.tum", format_tum(flight(rate=20.0)))
        self.assertEqual(self.messages(estimate, truth), "")
        self.assert_swapped(truth, estimate)

    def test_a_dense_estimate_beside_coarse_ground_truth_is_none(self):
        truth = self.write("truth5.tum", format_tum(flight(rate=5.0)))
        dense = flight(rate=200.0).select(slice(300, None))  # at the rate of the IMU
        self.assertEqual(self.messages(self.write("estimate.tum", format_tum(dense)), truth), "")


if __name__ == "__main__":
    unittest.main()
