#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the figures of scripts/evaluation and the labels by scripts/dataset."""

import math
import unittest
from types import SimpleNamespace
from unittest import mock

import numpy as np

from known_flight import flight, moved  # first: it names the folder
from dataset.results import Evaluator, Results, RunResult
from evaluation import plots


class Figures(unittest.TestCase):
    def draw(self, write, *arguments):
        """Returns the figure that `write` would save."""
        with mock.patch("evaluation.plots._save_figures",
                        lambda _, figures: list(figures.values())):
            figure = write("folder", *arguments)[0]
        self.addCleanup(plots.pyplot.close, "all")
        return figure

    def test_no_bar_of_an_error_goes_below_zero(self):
        values = {"points": {"hall": (0.01, 0.03), "room": (math.nan, 0.0)},
                  "lines": {"hall": (0.05, 0.02), "room": (0.02, 0.0)}}
        axis, = self.draw(plots.write_overview, "ape.png", values, "APE").axes
        ends = [bar.errorbar[2][0].get_segments()[0][:, 1] for bar in axis.containers
                if hasattr(bar, "errorbar")]
        np.testing.assert_allclose(ends, [[0.0, 0.04], [0.03, 0.07]])

    def test_the_ground_truth_is_on_top(self):
        truth = flight()
        pairs = {"points": (moved(truth, 0.1), truth)}
        figure = self.draw(plots.write_comparison, pairs)
        axis = figure.axes[0]
        line, = axis.get_lines()
        self.assertEqual(line.get_label(), "ground truth")
        self.assertGreater(line.get_zorder(), axis.collections[0].get_zorder())


class Labels(unittest.TestCase):
    def labels(self, *starts):
        runs = [SimpleNamespace(sequence=SimpleNamespace(name="hall"), variant=variant, start=start)
                for variant in ("points", "lines") for start in starts]
        results = Results(RunResult(run, evaluation={"ape_m": {"rmse": 0.1 + run.start}})
                          for run in runs)
        evaluator = Evaluator([])
        with mock.patch.object(evaluator, "compare", lambda run, _: (run.start, None, None)):
            return {label: pair[0] for label, pair in
                    evaluator.typical_pairs(results, "hall").items()}

    def test_say_which_start_is_drawn(self):
        self.assertEqual(self.labels(0.0), {"points": 0.0, "lines": 0.0})
        self.assertEqual(self.labels(0.0, 2.5, 5.0),
                         {"points, from 2.5 s": 2.5, "lines, from 2.5 s": 2.5})


if __name__ == "__main__":
    unittest.main()
