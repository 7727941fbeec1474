#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares trajectories of runs with a camera time offset with ground truth on the IMU's clock."""

import json
import os
import unittest
from types import SimpleNamespace

import numpy as np

from known_flight import START, flight, format_tum  # first: it names the folder
from dataset.results import Evaluator
from evaluate import main
from evaluation.run_results import check_whole, read_estimate, time_offset
from evaluation.trajectory import TrajectoryError
from folder_case import FolderTest, call
from stress.damage import assess

TD = 0.03  # [s]
RIGHT = 1e-4  # greater than the rounding error of the estimate [m]


class TimeOffset(FolderTest):
    """The estimate has no error, but each state refers to TD after its timestamp."""

    def setUp(self):
        super().setUp()
        self.truth = self.write("truth.tum", format_tum(flight(rate=200.0)))
        self.estimate = self.write("trajectory.tum", format_tum(flight().shifted(-TD)))
        self.summarise({"td_s": TD})

    def summarise(self, calibration):
        self.write("summary.json", json.dumps({"init_time_s": 1.0, "calibration": calibration}))

    def evaluate(self, *options):
        """Returns the printed text and all figures."""
        report = self.path("figures.json")
        result = call(main, self.estimate, self.truth, "--json", report, *options)
        self.assertEqual(result.returncode, 0)
        with open(report, encoding="utf-8") as file:
            return result.stdout, json.load(file)


class OneTrajectory(TimeOffset):
    def test_is_that_of_the_summary_beside_it(self):
        output, figures = self.evaluate()
        self.assertLess(figures["ape_m"]["rmse"], RIGHT)
        self.assertEqual(figures["t_offset_s"], TD)
        self.assertIn("stamps of the estimate shifted by +30.00 ms", output)

    def test_option_goes_before_it(self):
        output, figures = self.evaluate("--t-offset", "0")
        self.assertGreater(figures["ape_m"]["rmse"], 0.01)
        self.assertEqual(figures["t_offset_s"], 0)
        self.assertNotIn("shifted", output)
        self.assertIn("shifted by +29.00 ms", self.evaluate("--t-offset", "0.029")[0])

    def test_where_no_summary_states_any(self):
        for calibration in (None, {"td_s": 0.0}):
            self.summarise(calibration)
            self.assertNotIn("shifted", self.evaluate()[0])
        for name in ("{}", None):
            os.remove(self.path("summary.json"))
            if name:
                self.write("summary.json", name)
            self.assertEqual(time_offset(self.estimate), 0)

    def test_of_a_damaged_summary_is_an_error(self):
        for text in ('{"calibration": ', "[1]", '{"calibration": {}}', '{"calibration": [1]}',
                     '{"calibration": {"td_s": "late"}}', '{"calibration": {"td_s": NaN}}'):
            self.write("summary.json", text)
            with self.assertRaisesRegex(TrajectoryError, "summary.json: .*; run again$"):
                read_estimate(self.estimate)
            self.assertEqual(read_estimate(self.estimate, TD).shift, TD)

    def test_damage_by_a_fault(self):
        truth = read_estimate(self.truth, 0.0)
        self.assertLess(assess(self.estimate, truth, START + 2.0).ape, RIGHT)


class Dataset(TimeOffset):
    def setUp(self):
        super().setUp()
        self.run_ = SimpleNamespace(folder=self.folder, start=0.0, sequence=SimpleNamespace(
            name="hall", truth=self.truth))

    def figures(self, duration=None):
        evaluator = Evaluator([self.run_.sequence], duration)
        return evaluator.compare(self.run_, {"init_time_s": 1.0})

    def test_is_that_of_the_run(self):
        figures = self.figures()
        self.assertLess(figures["ape_m"]["rmse"], RIGHT)
        self.assertEqual(figures["t_offset_s"], TD)

    def test_part_of_the_truth_begins_where_the_first_image_was_taken(self):
        late = flight().stamps >= START + 3.0
        self.write("trajectory.tum", format_tum(flight().select(late).shifted(-TD)))
        self.run_.start = 2.0
        figures = self.figures(duration=6.0)
        self.assertAlmostEqual(figures["first_pose_delay_s"], 1.0, 4)
        self.assertAlmostEqual(figures["ground_truth_duration_s"], 6.0, 4)

    def test_a_part_of_a_run_is_not_taken_for_all_of_it(self):
        check_whole(self.estimate)
        self.write("trajectory_1.tum", format_tum(flight()))
        with self.assertRaisesRegex(TrajectoryError, "jumped back, .* are in trajectory_1.tum"):
            self.figures()


class Stamps(unittest.TestCase):
    def test_shifts_add(self):
        shifted = flight().shifted(0.01).shifted(0.02)
        self.assertAlmostEqual(shifted.shift, TD)
        np.testing.assert_allclose(shifted.stamps, flight().stamps + TD, atol=1e-6)


if __name__ == "__main__":
    unittest.main()
