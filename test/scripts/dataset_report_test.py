#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/dataset: means and report tables for given results."""

import os
import sys
import unittest
from types import SimpleNamespace

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
from dataset.paper import SEQUENCES, paper_ape  # noqa: E402
from dataset.report import markdown_report, metric_table  # noqa: E402
from dataset.results import METRIC, NONE, Results, RunResult  # noqa: E402
from dataset.variants import DESCRIPTIONS, VARIANTS  # noqa: E402
from evaluation.markdown import Table  # noqa: E402

APE = METRIC["ape_m"]


def result(sequence, variant, ape=None, failure=None, start=0.0):
    run = SimpleNamespace(sequence=SimpleNamespace(name=sequence), variant=variant, start=start,
                          repetition=1)
    if failure:
        return RunResult(run, failure=failure)
    evaluation = None if ape is None else {"ape_m": {"rmse": ape}, "coverage": 0.975,
                                           "ground_truth_steps": [], "without_steps": False}
    return RunResult(run, summary={}, evaluation=evaluation,
                     not_compared=None if evaluation else "no ground truth")


def row(markdown, *beginning):
    """Returns the stripped cells of the first such row of the tables."""
    rows = [[cell.strip() for cell in line.strip("|").split(" | ")]
            for line in markdown.splitlines() if line.startswith("| ")]
    return next(r for r in rows if r[:len(beginning)] == list(beginning))


class Figures(unittest.TestCase):

    def test_without_ground_truth_there_is_no_figure(self):
        results = Results([result("hall", "points")])
        self.assertEqual(results.cell(APE, "hall", "points"), NONE)
        self.assertIn("No run has this figure", metric_table(results, APE))

    def test_means_compare_the_same_sequences_and_starts(self):
        results = Results([result("a", "points", 0.1), result("a", "lines", 0.05),
                           result("a", "points", 0.8, start=1.0),
                           result("a", "lines", failure="lost", start=1.0),
                           result("b", "points", 0.9), result("b", "lines", failure="lost"),
                           result("c", "points", 0.3), result("c", "lines", 0.35)])
        means, common = results.means(APE)
        self.assertEqual(common, 2)
        self.assertAlmostEqual(means["points"], 0.2)
        self.assertAlmostEqual(means["lines"], 0.2)
        self.assertEqual(row(metric_table(results, APE), "**mean** of the 2 that all variants have")
                         [1:], ["0.2000", "0.2000"])

    def test_variant_without_any_figure_does_not_take_the_others_means(self):
        results = Results([result("a", "points", 0.1), result("a", "lines", failure="lost")])
        self.assertEqual(results.means(APE), ({"points": 0.1}, 1))

    def test_variants_without_a_common_sequence_have_no_mean(self):
        results = Results([result("a", "points", 0.1), result("b", "lines", 0.2)])
        self.assertEqual(results.means(APE), ({}, 0))
        self.assertNotIn("mean", metric_table(results, APE))


class Paper(unittest.TestCase):

    def test_only_whole_sequences_are_compared(self):
        whole = [result("MH_05_difficult", "improved", 0.1234)]
        for cut in (Results(whole, duration=60.0),
                    Results([result("MH_05_difficult", "improved", 0.1234, start=5.0)]),
                    Results([result("MH_05_difficult-weak-s1", "improved", 0.1234)])):
            self.assertNotIn("beside the paper", markdown_report(cut, []))

    def test_averages_are_those_that_the_paper_prints(self):
        means = [sum(column) / len(SEQUENCES)
                 for column in zip(*(paper_ape(name).values() for name in SEQUENCES))]
        self.assertEqual([f"{ape - means[2]:.2f}" for ape in means[:2]], ["0.04", "0.02"])


class Report(unittest.TestCase):

    def test_shifts_of_stamps_are_told(self):
        shifted = result("hall", "points", 0.1)
        self.assertNotIn("shifted", markdown_report(Results([shifted]), []))
        shifted.evaluation["t_offset_s"] = -0.0123
        text = markdown_report(Results([result("hall", "lines", 0.1), shifted]), [])
        self.assertIn("Stamps are shifted by the `td` that each run ended with, by up to 12.30 ms",
                      text)

    def test_steps_of_the_ground_truth_are_told(self):
        def with_steps(start, *steps):
            cell = result("hall", "points", 0.1, start=start)
            cell.evaluation["ground_truth_steps"] = [
                {"stamp": 5.0 + time, "time": time, "size": size} for time, size in steps]
            return cell

        runs = [with_steps(0.0, (3.0, 0.02), (9.0, 0.03)), with_steps(5.0, (9.0, 0.03)),
                result("room", "points", 0.1)]
        text = markdown_report(Results(runs), [])
        self.assertIn("**The ground truth has steps** (hall: 2, of up to 30 mm)", text)
        for cell in runs:
            cell.evaluation["without_steps"] = True
        text = markdown_report(Results(runs), [])
        self.assertIn("Ground truth without 1.5 s before and 0.3 s after each of its steps (hall:"
                      " 2, of up to 30 mm)", text)
        self.assertNotIn("steps", markdown_report(Results(runs[2:]), []))

    def test_table_is_aligned(self):
        self.assertEqual(str(Table(["a", "long"], [["b|", "c"]])).splitlines(),
                         ["| a   | long |", "|-----|------|", "| b\\| | c    |"])


class Variants(unittest.TestCase):
    def test_each_change_alone_makes_the_improved_one_together(self):
        together = dict(VARIANTS["baseline"])
        for name in ("subpixel", "fld", "merging"):
            change = {key: value for key, value in VARIANTS[name].items()
                      if VARIANTS["baseline"].get(key) != value}
            self.assertTrue(change)
            together.update(change)
        self.assertEqual(together, VARIANTS["improved"])
        self.assertEqual(list(VARIANTS), list(DESCRIPTIONS))


if __name__ == "__main__":
    unittest.main()
