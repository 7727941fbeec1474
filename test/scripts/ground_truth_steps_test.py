#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the detection of steps in ground truth on flights with known steps."""

import json
import unittest

import numpy as np

from known_flight import START, flight, format_tum, moved  # first: it names the folder
from evaluate import evaluate, format_report, main
from evaluation import steps
from evaluation.trajectory import TrajectoryError
from folder_case import FolderTest, call


def jump(trajectory, *jumps):
    """Returns the trajectory with jumps, given as pairs of a time after START [s] and a vector
    [m]."""
    offsets = sum(np.where(trajectory.stamps[:, None] - START > time, vector, 0.0)
                  for time, vector in jumps)
    return moved(trajectory, offsets)


class Find(unittest.TestCase):
    def assert_found(self, truth, expected, tolerance):
        found = steps.find_steps(truth)
        np.testing.assert_allclose([step.time for step in found], [time for time, _ in expected],
                                   atol=tolerance)
        np.testing.assert_allclose([step.size for step in found], [size for _, size in expected],
                                   atol=1e-3)
        for step in found:
            self.assertAlmostEqual(step.stamp, START + step.time, 5)

    def test_times_and_sizes(self):
        jumps = ((0.004, (0, 0, 0.03)), (2.0, (0.01, 0, 0)), (2.9, (-0.02, 0.02, 0.01)),
                 (3.0, (0, 0, 0.012)), (9.996, (0, 0.015, 0)))
        expected = [(0.0, 0.03), (2.0, 0.01), (2.9, 0.03), (3.0, 0.012), (9.995, 0.015)]
        self.assert_found(jump(flight(rate=200.0), *jumps), expected, 0.006)

    def test_one_step_over_two_increments_is_one(self):
        self.assert_found(jump(flight(rate=200.0), (5.0, (0.02, 0, 0)), (5.005, (0.03, 0, 0))),
                          [(5.0, 0.05)], 0.006)

    def test_small_steps_are_none(self):
        self.assertEqual(steps.find_steps(jump(flight(rate=200.0), (4.0, (0.004, 0.004, 0)))), ())

    def test_a_short_trajectory_has_none(self):
        truth = jump(flight(rate=200.0), (0.007, (1.0, 0, 0)))
        self.assertEqual(steps.find_steps(truth.select(slice(0, 4))), ())

    def test_fast_motion_is_none_however_coarsely_it_is_sampled(self):
        t = np.arange(0.0, 20.0, 0.005)
        shaken = flight(rate=200.0, seconds=19.995)
        shaken.positions[:] = np.stack([0.05 * np.sin(20 * t), 2 * np.sin(2 * t) ** 3,
                                        0.5 * np.sin(5 * t)], axis=1)  # up to 20 m/s^2
        for every in (1, 2, 4, 10, 20, 40):
            self.assertEqual(steps.find_steps(shaken.select(slice(0, None, every))), ())

    def test_gaps_are_none(self):
        truth = flight(rate=200.0)
        generator = np.random.default_rng(1)
        for share in (0.01, 0.3, 0.8):
            kept = generator.uniform(size=len(truth)) > share
            self.assertEqual(steps.find_steps(truth.select(kept)), ())
        t = truth.stamps - START
        self.assertEqual(steps.find_steps(truth.select((t < 3) | (t > 3.2))), ())
        self.assertEqual(steps.find_steps(truth.select((t < 3) | (t > 7))), ())


class LeaveOut(FolderTest):
    def setUp(self):
        super().setUp()
        self.estimate = flight(rate=20.0, seconds=30.0)
        truth = flight(rate=200.0, seconds=30.0)
        since = truth.stamps - START - 11.0
        drift = np.where((since > 0) & (since <= 1.0), 0.2 * since, 0.0)  # drifts, then jumps back
        self.truth = moved(truth, np.outer(drift, [0.6, 0, 0.8]))

    def test_drift_before_the_step_does_not_count(self):
        pair, truth, figures = evaluate(self.estimate, steps.without_steps(self.truth))
        times = pair.stamps - START
        self.assertFalse(((times > 10.51) & (times < 12.29)).any())
        self.assertEqual(len(pair), len(truth))
        self.assertAlmostEqual(len(self.estimate) - len(pair), 36, delta=1)
        self.assertLess(figures["ape_m"]["max"], 1e-6)
        self.assertTrue(figures["without_steps"])
        self.assertAlmostEqual(figures["coverage"], 1.0, 6)
        self.assertIn("excluded from the ground truth: steps of 200 mm at 12.0 s after its first"
                      " pose, with 1.5 s before and 0.3 s after each", format_report(figures))

    def test_one_transform_aligns_all_pieces(self):
        truth = jump(self.truth, (12.0, (0.1, 0, 0)))  # jumps, but not back to the true position
        figures = evaluate(self.estimate, steps.without_steps(truth))[2]
        self.assertGreater(figures["ape_m"]["rmse"], 0.02)

    def test_relative_errors_do_not_span_a_step(self):
        truth = jump(self.truth, (12.0, (0.5, 0, 0)))
        figures = evaluate(self.estimate, steps.without_steps(truth), align="none")[2]
        for name in ("rpe_1m_m", "rpe_1s_m"):
            self.assertGreater(figures[name]["count"], 10)
            self.assertLess(figures[name]["max"], 1e-6, name)
        self.assertLess(figures["local_scale"]["mean_absolute_error_percent"], 1e-6)
        self.assertGreater(evaluate(self.estimate, truth)[2]["rpe_1m_m"]["max"], 0.3)

    def test_without_the_option_steps_count_and_are_named(self):
        figures = evaluate(self.estimate, self.truth)[2]
        self.assertGreater(figures["ape_m"]["max"], 0.1)
        self.assertFalse(figures["without_steps"])
        self.assertIn("warning: the ground truth has steps of 200 mm at 12.0 s",
                      format_report(figures))

    def test_steps_far_from_the_estimate_are_not_named(self):
        early = self.estimate.select(self.estimate.stamps < START + 10.4)
        for truth in (self.truth, steps.without_steps(self.truth)):
            self.assertNotIn("steps", format_report(evaluate(early, truth)[2]))

    def test_nothing_left_is_an_error(self):
        short = jump(flight(rate=200.0, seconds=1.6), (1.45, (0.05, 0, 0)))
        with self.assertRaisesRegex(TrajectoryError, "0 poses remain .* 50 mm at 1.4 s"):
            evaluate(flight(seconds=1.6), steps.without_steps(short))

    def test_command_line(self):
        paths = [self.write(name, format_tum(trajectory)) for name, trajectory in
                 (("estimate.tum", self.estimate), ("truth.tum", self.truth))]
        result = call(main, *paths, "--without-steps", "--json", self.path("report.json"))
        self.assertIn("excluded from the ground truth", result.stdout)
        with open(self.path("report.json"), encoding="utf-8") as file:
            figures = json.load(file)
        self.assertLess(figures["ape_m"]["rmse"], 1e-6)
        self.assertAlmostEqual(figures["ground_truth_steps"][0]["size"], 0.2, 3)


if __name__ == "__main__":
    unittest.main()
