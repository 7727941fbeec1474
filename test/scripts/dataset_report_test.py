#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/dataset: medians, means and report tables for given results."""

import os
import sys
import unittest
from types import SimpleNamespace

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
from dataset import cells  # noqa: E402
from dataset.markdown import Table  # noqa: E402
from dataset.paper import SEQUENCES, TABLES  # noqa: E402
from dataset.paper_tables import paper_table  # noqa: E402
from dataset.report import markdown_report  # noqa: E402
from dataset.results import METRIC, Results, RunResult  # noqa: E402
from dataset.variants import DESCRIPTIONS, VARIANTS  # noqa: E402

APE = METRIC["ape_m"]


def result(sequence, variant, ape=None, repetition=1, failure=None, extraction=None, start=0.0):
    run = SimpleNamespace(sequence=SimpleNamespace(name=sequence), variant=variant, start=start,
                          repetition=repetition)
    if failure:
        return RunResult(run, failure=failure)
    evaluation = None if ape is None else {"ape_m": {"rmse": ape}, "coverage": 0.975,
                                           "ground_truth_steps": [], "without_steps": False}
    return RunResult(run, summary={}, evaluation=evaluation, line_extraction_ms=extraction,
                     not_compared=None if evaluation else "no ground truth")


def cells_of(markdown):
    """Returns the stripped cells of the rows of a table."""
    return [[cell.strip() for cell in line.strip("|").split(" | ")]
            for line in markdown.splitlines() if line.startswith("| ")]


def row(markdown, *beginning):
    return next(r for r in cells_of(markdown) if r[:len(beginning)] == list(beginning))


class Figures(unittest.TestCase):
    def test_median_and_spread_over_repetitions(self):
        results = Results([result("hall", "points", ape, n)
                           for n, ape in enumerate((0.3, 0.1, 0.12), start=1)])
        self.assertEqual(cells.figure(results, APE, "hall", "points"),
                         "0.1200 [0.1000, 0.3000] (98 %)")
        self.assertEqual(results.typical("hall", "points").run.repetition, 3)

    def test_mean_and_spread_over_starts(self):
        results = Results([result("hall", "points", ape, start=start)
                           for start, ape in enumerate((0.1, 0.2, 0.6))])
        self.assertEqual(cells.figure(results, APE, "hall", "points"),
                         "0.3000 ± 0.2646 [0.1000, 0.6000] (98 %) over 3 starts")
        self.assertEqual(results.typical("hall", "points").run.start, 1)

    def test_a_start_counts_once_with_the_median_of_its_repetitions(self):
        results = Results([result("hall", "points", ape, n, start=0.0)
                           for n, ape in enumerate((0.1, 0.2, 0.9), start=1)]
                          + [result("hall", "points", 0.4, start=1.0)])
        spread = results.spread(APE, "hall", "points")
        self.assertAlmostEqual(spread.mean, 0.3)
        self.assertAlmostEqual(spread.deviation, 0.1 * 2 ** 0.5)
        self.assertEqual((spread.low, spread.high, spread.starts), (0.1, 0.9, 2))

    def test_starts_without_trajectory_are_counted(self):
        results = Results([result("hall", "points", 0.1),
                           result("hall", "points", start=1.0, failure="lost"),
                           result("hall", "lines", failure="lost"),
                           result("hall", "lines", 0.1, repetition=2),
                           result("hall", "lines", 0.1, start=1.0)])
        self.assertEqual(cells.figure(results, APE, "hall", "points"),
                         "0.1000 [0.1000, 0.1000] (98 %) over 1 start, 1 of 2 failed")
        self.assertEqual(results.lost_starts("hall", "points"), [1.0])
        self.assertEqual(results.lost_starts("hall", "lines"), [])

    def test_failed_repetitions_are_counted(self):
        results = Results([result("hall", "points", 0.1), result("hall", "points", repetition=2,
                                                                 failure="too dark"),
                           result("hall", "lines", failure="too dark")])
        self.assertTrue(cells.figure(results, APE, "hall", "points").endswith(", 1 of 2 failed"))
        self.assertEqual(cells.figure(results, APE, "hall", "lines"), "**failed**")

    def test_without_ground_truth_there_is_no_figure(self):
        results = Results([result("hall", "points")])
        self.assertEqual(cells.figure(results, APE, "hall", "points"), cells.NONE)
        self.assertIsNone(results.typical("hall", "points"))

    def test_means_compare_the_same_sequences(self):
        results = Results([result("a", "points", 0.1), result("a", "lines", 0.05),
                           result("b", "points", 0.9), result("b", "lines", failure="lost"),
                           result("c", "points", 0.3), result("c", "lines", 0.35)])
        means, common = results.means(APE)
        self.assertEqual(common, [("a", 0.0), ("c", 0.0)])
        self.assertAlmostEqual(means["points"], 0.2)
        self.assertAlmostEqual(means["lines"], 0.2)

    def test_variant_without_any_figure_does_not_take_the_others_means(self):
        results = Results([result("a", "points", 0.1), result("a", "lines", failure="lost")])
        self.assertEqual(results.means(APE), ({"points": 0.1}, [("a", 0.0)]))

    def test_means_compare_the_same_starts(self):
        results = Results([result("hall", "points", 0.1), result("hall", "lines", 0.2),
                           result("hall", "points", 0.9, start=1.0),
                           result("hall", "lines", start=1.0, failure="lost")])
        self.assertEqual(results.means(APE), ({"points": 0.1, "lines": 0.2}, [("hall", 0.0)]))


class PaperTables(unittest.TestCase):
    def table(self, number, results):
        return paper_table(TABLES[number - 1], Results(results))

    def test_columns_of_the_paper_and_of_ours(self):
        ours = [result("MH_05_difficult-weak-s1", "baseline", 0.1767),
                result("MH_05_difficult-weak-s1", "improved", 0.1234)]
        text = self.table(1, ours)
        self.assertIn("PL-VINS", text.splitlines()[2])
        self.assertEqual(row(text, "MH_05_difficult"),
                         ["MH_05_difficult", "0.38", "0.31", "0.07", "MH_05_difficult-weak-s1",
                          "0.1767 (98 %)", "0.1234 (98 %)", "0.0533"])
        self.assertEqual(row(text, "V2_01_easy"),
                         ["V2_01_easy", "0.12", "0.12", "0.00"] + 4 * ["–"])
        self.assertEqual(len(cells_of(text)), 1 + len(SEQUENCES) + 1)  # with the average
        self.assertEqual(row(self.table(2, ours), "MH_05_difficult"),
                         ["MH_05_difficult", "0.35", "0.31", "0.04", "MH_05_difficult-weak-s1",
                          "0.1234 (98 %)", "–"])
        self.assertEqual(set(row(self.table(2, ours), "average")[5:]), {"–"})
        self.assertNotIn("average of ours", self.table(1, ours))

    def test_only_whole_sequences_differ_from_those_of_the_paper(self):
        ours = [result("MH_05_difficult", "improved", 0.1234)]
        text = self.table(2, ours)
        self.assertEqual(row(text, "MH_05_difficult")[-2:], ["0.1234 (98 %)", "0.2266"])
        self.assertIn("of 1", row(text, "average of ours"))
        for cut in (Results(ours, duration=60.0),
                    Results([result("MH_05_difficult", "improved", 0.1234, start=5.0)])):
            text = paper_table(TABLES[1], cut)
            self.assertEqual(row(text, "MH_05_difficult")[-2:], ["0.1234 (98 %)", "–"])
            self.assertNotIn("average of ours", text)

    def test_averages_are_those_that_the_paper_prints(self):
        for number, difference in ((1, "0.04"), (2, "0.02"), (3, "1.49")):  # the paper prints 1.5
            average = row(self.table(number, [result("hall", "points", 1)]), "average")
            self.assertEqual(average[3], difference)
            self.assertEqual(set(average[4:]), {"–"})

    def test_average_of_some_sequences_is_said_to_be_one(self):
        ours = [result(sequence, variant, ape) for sequence in ("MH_01_easy", "MH_04_difficult")
                for variant, ape in (("baseline", 0.2), ("improved", 0.1))]
        self.assertEqual(row(self.table(1, ours), "average of ours")[1:],
                         ["0.27", "0.22", "0.05", "of 2", "0.2000", "0.1000", "0.1000"])

    def test_average_of_all_sequences(self):
        ours = [result(s, v, ape) for s in SEQUENCES
                for v, ape in (("baseline", 0.2), ("improved", 0.1))]
        text = self.table(1, ours)
        self.assertEqual(row(text, "average")[1:3], ["0.25", "0.21"])
        self.assertEqual(row(text, "average")[5:], ["0.2000", "0.1000", "0.1000"])
        self.assertNotIn("average of ours", text)

    def test_line_extraction_times(self):
        ours = [result("V1_01_easy", "baseline", extraction=8.0),
                result("V1_01_easy", "improved", extraction=2.5)]
        self.assertEqual(row(self.table(3, ours), "V1_01_easy"),
                         ["V1_01_easy", "4.33", "5.82", "-1.49", "V1_01_easy", "8.00", "2.50",
                          "5.50"])

    def test_failed_runs_are_shown(self):
        ours = [result("V1_01_easy", "baseline", 0.1), result("V1_01_easy", "improved",
                                                              failure="lost")]
        self.assertEqual(row(self.table(1, ours), "V1_01_easy")[-3:],
                         ["0.1000 (98 %)", "**failed**", "–"])


class Report(unittest.TestCase):
    def test_failures_missing_truth_and_variants_are_told(self):
        text = markdown_report(Results([result("a", "points", failure="lost | found"),
                                        result("b", "points")]), [("machine", "this one")],
                               {"b": ["plots/b/ape.png"]})
        self.assertIn("1 of 2:", text)
        self.assertIn("lost \\| found", text)
        self.assertEqual(row(text, "b", "points"), ["b", "points", "0", "1", "no ground truth"])
        self.assertEqual(row(text, "points"), ["points", DESCRIPTIONS["points"]])
        self.assertIn("None of the sequences is one of the paper's", text)
        self.assertIn("![ape.png](plots/b/ape.png)", text)
        self.assertNotIn("| lines ", text)

    def test_starts_are_explained_and_variants_compared_over_those_of_one_sequence(self):
        text = markdown_report(Results([result("hall", variant, ape, start=start)
                                        for variant, ape in (("points", 0.2), ("lines", 0.1))
                                        for start in (0.0, 1.0)]), [], {})
        self.assertIn("over those of 2 starts that have them", text)
        self.assertEqual(row(text, "**mean**"), ["**mean**", "0.2000", "0.1000"])
        self.assertEqual(row(text, "against points")[2], "-50 %")

    def test_shifts_of_stamps_are_told(self):
        shifted = result("hall", "points", 0.1)
        self.assertNotIn("shifted", markdown_report(Results([shifted]), [], {}))
        shifted.evaluation["t_offset_s"] = -0.0123
        text = markdown_report(Results([result("hall", "lines", 0.1), shifted]), [], {})
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
        text = markdown_report(Results(runs), [], {})
        self.assertIn("**The ground truth has steps** (hall: 2, of up to 30 mm)", text)
        for cell in runs:
            cell.evaluation["without_steps"] = True
        text = markdown_report(Results(runs), [], {})
        self.assertIn("Ground truth without 1.5 s before and 0.3 s after each of its steps (hall:"
                      " 2, of up to 30 mm)", text)
        self.assertNotIn("steps", markdown_report(Results(runs[2:]), [], {}))

    def test_times_beside_other_work_are_not_passed_over(self):
        quiet, busy = result("MH_01_easy", "points", 0.1), result("MH_02_easy", "points", 0.1)
        quiet.load, quiet.cores = 1.4, 2
        busy.load, busy.cores = 7.2, 2
        warning = "1 of 2 runs shared their machine with other work (load average up to 7, on 2"
        text = markdown_report(Results([quiet, busy]), [], {})
        self.assertEqual(text.count(warning), 2)  # at our run times, and beside those of the paper
        busy.cores = 8
        text = markdown_report(Results([quiet, busy]), [], {})
        self.assertNotIn("shared their machine", text)

    def test_table_is_aligned(self):
        self.assertEqual(str(Table(["a", "long"], [["b", "c"]])).splitlines(),
                         ["| a   | long |", "|-----|------|", "| b   | c    |"])


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
