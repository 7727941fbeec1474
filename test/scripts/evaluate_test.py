#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/evaluate.py on cases with known results."""

import json
import os
import tempfile
import unittest

import numpy as np

from known_flight import START, flight, format_tum, moved, rotation  # first: it names the folder
from evaluate import error_statistics, evaluate, format_report, main, parse_arguments
from evaluation import evo_backend, metrics
from evaluation.trajectory import Trajectory, TrajectoryError, read_trajectory
from folder_case import FolderTest, call


class AbsoluteError(unittest.TestCase):
    def test_rigidly_moved_trajectory_has_no_error(self):
        truth = flight()
        estimate = truth.transformed(rotation((0.6, 0.0, 0.8), 70), np.array([5.0, -3.0, 2.0]))
        _, _, result = evaluate(estimate, truth)
        for name in ("ape_m", "ape_rotation_deg", "ape_yaw_deg", "rpe_1m_m", "rpe_1s_m"):
            self.assertLess(result[name]["max"], 1e-5, name)

    def test_alternating_offset_without_alignment(self):
        truth = flight(rate=20.0, seconds=9.95)  # 200 poses
        offsets = np.zeros((200, 3))
        offsets[0::2, 0], offsets[1::2, 1] = 0.3, 0.4
        figures = evaluate(moved(truth, offsets), truth, align="none")[2]["ape_m"]
        self.assertAlmostEqual(figures["rmse"], np.sqrt((0.09 + 0.16) / 2), 9)
        self.assertAlmostEqual(figures["mean"], 0.35, 9)
        self.assertAlmostEqual(figures["median"], 0.35, 9)
        self.assertAlmostEqual(figures["std"], 0.05, 9)
        self.assertAlmostEqual(figures["min"], 0.3, 9)
        self.assertAlmostEqual(figures["max"], 0.4, 9)
        self.assertEqual(figures["count"], 200)

    def test_constant_offset_disappears_by_alignment(self):
        truth = flight()
        estimate = moved(truth, np.array([1.0, 2.0, 3.0]))
        rmse = {kind: evaluate(estimate, truth, kind)[2]["ape_m"]["rmse"]
                for kind in metrics.ALIGNMENTS}
        self.assertAlmostEqual(rmse["none"], np.sqrt(14), 6)
        self.assertLess(rmse["se3"], 1e-9)
        self.assertLess(rmse["yaw"], 1e-9)

    def test_scale_is_not_corrected(self):
        # Scaling by 1.1 about the mean leaves 0.1 times the standard deviation of the positions.
        truth = flight()
        centered = truth.positions - truth.positions.mean(axis=0)
        estimate = Trajectory(truth.stamps, 1.1 * truth.positions, truth.rotations)
        expected = 0.1 * np.sqrt(np.mean(np.sum(centered ** 2, axis=1)))
        self.assertAlmostEqual(evaluate(estimate, truth)[2]["ape_m"]["rmse"], expected, 9)

    def test_mirrored_trajectory_is_not_aligned_by_a_reflection(self):
        truth = flight()
        mirrored = Trajectory(truth.stamps, truth.positions * [1, 1, -1], truth.rotations)
        self.assertGreater(evaluate(mirrored, truth)[2]["ape_m"]["rmse"], 0.1)

    def test_yaw_alignment_keeps_a_wrong_tilt(self):
        truth = flight()
        estimate = truth.transformed(rotation((1, 0, 0), 4), np.zeros(3))
        result = evaluate(estimate, truth, align="yaw")[2]
        self.assertAlmostEqual(result["ape_rotation_deg"]["mean"], 4.0, 1)
        self.assertGreater(result["ape_m"]["rmse"], 0.05)

    def test_wrong_heading_of_the_body_only(self):
        truth = flight()
        turned = Trajectory(truth.stamps, truth.positions,
                            rotation((0, 0, 1), -2.5) @ truth.rotations)
        result = evaluate(turned, truth)[2]
        self.assertLess(result["ape_m"]["rmse"], 1e-9)
        self.assertAlmostEqual(result["ape_rotation_deg"]["rmse"], 2.5, 6)
        self.assertAlmostEqual(result["ape_yaw_deg"]["rmse"], 2.5, 6)

    def test_yaw_drift_is_the_change_from_the_beginning_to_the_end(self):
        truth = flight()
        for before, after in ((0.0, 3.0), (170.0, 173.0), (178.5, -178.5), (-2.0, -5.0)):
            turns = [rotation((0, 0, 1), before if stamp < START + 5.0 else after)
                     for stamp in truth.stamps]
            estimate = Trajectory(truth.stamps, truth.positions, turns @ truth.rotations)
            result = evaluate(estimate, truth)[2]
            self.assertAlmostEqual(result["yaw_drift_deg"], 3.0, 6)
        self.assertIn("yaw error at the end 3.000 deg", format_report(result))

    def test_yaw_drift_of_a_standstill_does_not_depend_on_the_alignment(self):
        truth, generator = flight(), np.random.default_rng(1)
        truth.positions[:] = generator.normal(0, 1e-3, truth.positions.shape)
        turns = [rotation((0, 0, 1), 0.0 if stamp < START + 5.0 else 3.0)
                 for stamp in truth.stamps]
        estimate = Trajectory(truth.stamps, generator.normal(0, 1e-3, truth.positions.shape),
                              turns @ truth.rotations)
        self.assertAlmostEqual(evaluate(estimate, truth)[2]["yaw_drift_deg"], 3.0, 6)

    def test_local_scale_is_that_of_pieces_not_of_the_whole(self):
        stamps = START + np.arange(0.0, 40.0, 0.05)
        positions = np.stack([np.sin(stamps), np.cos(1.3 * stamps), 0.3 * np.sin(0.7 * stamps)],
                             axis=1)
        truth = Trajectory(stamps, positions, np.repeat(np.eye(3)[None], len(stamps), axis=0))
        drift = np.array([1.0, 0, 0]) * np.floor((stamps - START + 0.075) / 5)[:, None]
        turn = rotation((0.6, 0, 0.8), 50.0)
        estimate = Trajectory(stamps, (1.02 * positions + drift) @ turn.T, truth.rotations)
        errors = metrics.local_scale_errors(estimate, truth, seconds=4.9, every=5.0)
        self.assertEqual(len(errors), 6)  # the estimate jumps between these intervals
        np.testing.assert_allclose(errors, 2.0, atol=1e-6)
        scale = evaluate(Trajectory(stamps, 0.97 * positions, truth.rotations), truth)[2]
        self.assertAlmostEqual(scale["local_scale"]["mean_error_percent"], -3.0, 6)
        self.assertAlmostEqual(scale["local_scale"]["mean_absolute_error_percent"], 3.0, 6)
        self.assertIn("pieces of 5 s: 3.00 %", format_report(scale))

    def test_local_scale_of_a_standstill_is_not_told(self):
        truth = flight()
        truth.positions[:] = np.random.default_rng(1).normal(0, 1e-3, truth.positions.shape)
        result = evaluate(truth, truth)[2]
        self.assertIsNone(result["local_scale"])
        self.assertNotIn("scale", format_report(result))

    def test_straight_line_leaves_the_alignment_open(self):
        truth = flight()
        truth.positions[:, 1:] = 0.0
        with self.assertRaisesRegex(TrajectoryError, "--align"):
            evaluate(truth, truth)
        self.assertEqual(evaluate(truth, truth, align="none")[2]["ape_m"]["max"], 0.0)


class RelativeError(unittest.TestCase):
    def straight(self, speed):
        t = np.arange(0.0, 10.0, 0.125)  # steps that are exact in binary
        positions = np.stack([speed * t, np.zeros_like(t), np.zeros_like(t)], axis=1)
        return Trajectory(START + t, positions, np.tile(rotation((0, 0, 1), 90), (len(t), 1, 1)))

    def test_drift_per_metre_and_per_second(self):
        # The estimate advances 2 m/s, the truth 1.5 m/s: 0.25 m per meter, 0.5 m per second.
        result = evaluate(self.straight(2.0), self.straight(1.5), align="none")[2]
        self.assertAlmostEqual(result["rpe_1m_m"]["max"], 0.25, 9)
        self.assertAlmostEqual(result["rpe_1m_m"]["min"], 0.25, 9)
        self.assertAlmostEqual(result["rpe_1s_m"]["rmse"], 0.5, 9)
        self.assertEqual(result["rpe_1s_m"]["count"], 72)
        self.assertEqual(result["rpe_1m_deg"]["max"], 0.0)

    def test_pairs_are_consecutive_and_start_at_the_first_full_metre(self):
        first, second = metrics.pairs_by_path(self.straight(2.0), 1.0)
        np.testing.assert_array_equal(first, np.arange(4, 76, 4))
        np.testing.assert_array_equal(second, np.arange(8, 80, 4))

    def test_standstill_has_no_error_per_metre(self):
        still = self.straight(0.0)
        result = evaluate(still, still, align="none")[2]
        self.assertIsNone(result["rpe_1m_m"])
        self.assertIn("no pair", format_report(result))


class Association(unittest.TestCase):
    def test_nearest_partner_in_denser_ground_truth(self):
        truth, estimate = flight(rate=200.0), flight(rate=20.0)
        pairs = metrics.associate(estimate.shifted(0.002), truth, 0.01)
        self.assertEqual(len(pairs[0]), len(estimate))
        np.testing.assert_allclose(pairs[1].stamps, estimate.stamps, atol=1e-6)

    def test_partners_beyond_the_limit_are_left_out(self):
        truth = flight(rate=20.0)
        estimate = truth.shifted(0.0)
        estimate.stamps[::2] += 0.02
        self.assertEqual(len(metrics.associate(estimate, truth, 0.01)[0]), len(truth) // 2)

    def test_the_limit_is_the_same_for_all(self):
        self.assertEqual(parse_arguments(["a.tum", "b.tum"]).max_diff, metrics.MAX_DIFFERENCE)
        for function in (evaluate, metrics.associate):
            self.assertIn(metrics.MAX_DIFFERENCE, function.__defaults__)

    def test_no_overlap_is_an_error(self):
        with self.assertRaisesRegex(TrajectoryError, "no overlap"):
            evaluate(flight().shifted(1000.0), flight())


class TumFormat(unittest.TestCase):
    def test_poses_come_back_for_all_angles(self):
        turns = np.array([rotation(axis, angle) for angle in (0, 1e-7, 90, 179.9999, 180)
                          for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0.6, 0, -0.8))])
        poses = Trajectory(START + np.arange(len(turns)), np.arange(3 * len(turns)).reshape(-1, 3),
                           turns)
        with tempfile.NamedTemporaryFile("w+", suffix=".tum") as file:
            file.write(format_tum(poses))
            file.flush()
            read = read_trajectory(file.name)
        np.testing.assert_allclose(read.stamps, poses.stamps, atol=1e-6)
        np.testing.assert_allclose(read.positions, poses.positions, atol=1e-9)
        np.testing.assert_allclose(read.rotations, poses.rotations, atol=1e-8)


class Coverage(unittest.TestCase):
    def coverage(self, keep):
        truth = flight(seconds=10.0)
        result = evaluate(truth.select(keep(truth.stamps - START)), truth)[2]
        self.assertIn(f"coverage {100 * result['coverage']:.1f} %", format_report(result))
        return result["coverage"]

    def test_all(self):
        self.assertAlmostEqual(self.coverage(lambda t: t >= 0), 1.0, 6)

    def test_missing_first_half(self):
        self.assertAlmostEqual(self.coverage(lambda t: t > 4.99), 0.5, 6)

    def test_long_gap_counts_as_missing(self):
        self.assertAlmostEqual(self.coverage(lambda t: (t < 4.01) | (t > 5.99)), 0.8, 6)

    def test_short_gap_does_not(self):
        self.assertAlmostEqual(self.coverage(lambda t: (t < 4.01) | (t > 4.39)), 1.0, 6)

    def test_poses_outside_of_the_ground_truth_do_not_count(self):
        truth = flight(seconds=10.0)
        inner = truth.select(truth.stamps > START + 4.99)
        self.assertAlmostEqual(metrics.coverage(truth, inner, 0.5), 1.0, 6)


class CommandLine(FolderTest):
    def spiral(self, separator, rows=100, stamp_unit=1.0):
        """Returns rows of a rising spiral with a yaw of 90 degrees, in TUM or csv order."""
        quaternion = [0, 0, 0.5, 0.5] if separator == " " else [0.5, 0, 0, 0.5]
        text = "# a comment\n"
        for i in range(rows):
            stamp = f"{(1403636580 + 0.05 * i) * stamp_unit:.{2 if stamp_unit == 1 else 0}f}"
            numbers = [np.cos(0.1 * i), np.sin(0.1 * i), 0.01 * i, *quaternion]
            extra = [1, 2, 3] if separator == "," else []
            text += separator.join([stamp] + [f"{v:.12f}" for v in numbers + extra]) + "\n"
        return text

    def test_tum_against_euroc_csv_with_plots_and_json(self):
        estimate = self.write("estimate.tum", self.spiral(" "))
        truth = self.write("data.csv", self.spiral(",", stamp_unit=1e9))
        report = self.path("report.json")
        plots = self.path("plots")
        result = call(main, estimate, truth, "--json", report, "--plots", plots)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("coverage 100.0 %", result.stdout)
        with open(report, encoding="utf-8") as file:
            figures = json.load(file)
        self.assertEqual(figures["pairs"], 100)
        self.assertLess(figures["ape_m"]["rmse"], 1e-6)
        self.assertLess(figures["ape_rotation_deg"]["rmse"], 1e-4)
        self.assertEqual(sorted(os.listdir(plots)),
                         ["ape.png", "trajectory.png", "translation.png"])

    def test_an_estimate_in_several_worlds_says_so(self):
        truth = self.write("truth.tum", self.spiral(" "))
        report = self.path("report.json")
        rows = self.spiral(" ").splitlines(keepends=True)
        # A world without poses does not count.
        for comment_at, worlds in ((len(rows), 1), (50, 2), (30, 3), (30, 3), (0, 3)):
            rows.insert(comment_at, "# the world frame starts anew: lost\n")
            result = call(main, self.write("estimate.tum", "".join(rows)), truth,
                          "--t-offset", "0.001", "--json", report)
            self.assertEqual("unconnected world frames" in result.stdout, worlds > 1)
            if worlds > 1:
                self.assertIn(f"{worlds} unconnected world frames: APE and yaw",
                              result.stdout)
            with open(report, encoding="utf-8") as file:
                self.assertEqual(json.load(file)["worlds"], worlds)

    def test_ground_truth_with_a_byte_order_mark(self):
        estimate = self.write("estimate.tum", self.spiral(" "))
        truth = self.write("data.csv", "\ufeff" + self.spiral(",", stamp_unit=1e9))
        self.assertIn("100 pairs", call(main, estimate, truth).stdout)

    def test_time_offset(self):
        truth = self.write("truth.tum", self.spiral(" "))
        late = self.write("late.tum", self.spiral(" ").replace("14036365", "14036366"))
        self.assert_refused(main, "no overlap", late, truth)
        self.assertEqual(call(main, late, truth, "--t-offset", "-100").returncode, 0)

    def unit_covariance(self, estimate):
        unit = ",".join("1" if i in (0, 6, 11, 15, 18, 20) else "0" for i in range(21))
        stamps = [round(1e9 * stamp) for stamp in read_trajectory(estimate).stamps]
        return self.write("covariance.csv", "stamp_ns\n" + "".join(
            f"{stamp},{unit}\n" for stamp in stamps))

    def test_covariances_are_those_of_the_stamps_before_the_offset(self):
        estimate = self.write("estimate.tum", self.spiral(" "))
        covariance = self.unit_covariance(estimate)
        report = self.path("report.json")
        for offset in ("0", "0.005"):
            result = call(main, estimate, estimate, "--covariance", covariance, "--t-offset",
                          offset, "--nees-after", "4", "--json", report)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(report, encoding="utf-8") as file:
                self.assertLess(json.load(file)["position_nees"], 1e-6)

    def test_a_run_too_short_for_its_covariance_loses_no_figures(self):
        estimate = self.write("estimate.tum", self.spiral(" "))
        report = self.path("report.json")
        result = call(main, estimate, estimate, "--covariance",
                      self.unit_covariance(estimate), "--json", report)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, "no pose 10 s after the first.*--nees-after")
        self.assertIn("APE [m]", result.stdout)
        with open(report, encoding="utf-8") as file:
            self.assertNotIn("position_nees", json.load(file))

    def test_attitude_of_both_formats(self):
        tum = read_trajectory(self.write("truth.tum", self.spiral(" ")))
        csv = read_trajectory(self.write("data.csv", self.spiral(",", stamp_unit=1e9)))
        for trajectory in (tum, csv):
            np.testing.assert_allclose(trajectory.rotations[7] @ [1, 0, 0], [0, 1, 0], atol=1e-12)

    def test_bad_files(self):
        good = self.write("good.tum", self.spiral(" "))
        row = "1403636580.0 1 2 3 0 0 0 "
        bad = {
            "columns": row,
            "NaN": row.replace("2", "nan") + "1",
            "not a number": row.replace("2", "two") + "1",
            "quaternion": row + "0",
            "does not increase": row + "1\n" + row + "1",
            "at least 3": row + "1",
        }
        self.assert_refused(main, "no such file", self.path("missing.tum"), good)
        for message, text in bad.items():
            path = self.write("bad.tum", text + "\n")
            self.assert_refused(main, message, path, good)
            self.assert_refused(main, path, path, good)


class Evo(unittest.TestCase):
    @unittest.skipUnless(evo_backend.is_available(), "evo is not installed")
    def test_same_numbers_as_numpy(self):
        truth, generator = flight(rate=200.0), np.random.default_rng(1)
        estimate = flight(rate=20.0)
        estimate = moved(estimate, np.cumsum(generator.normal(0, 0.01, (len(estimate), 3)), axis=0))
        estimate, truth, result = evaluate(estimate, truth)
        self.assertEqual(result["computed_by"], "evo")
        for name, figures in error_statistics(estimate, truth).items():
            for key, value in (figures or {}).items():
                self.assertAlmostEqual(value, result[name][key], 7, name)


if __name__ == "__main__":
    unittest.main()
