#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/evaluate_loops.py with loops of known errors."""

import json
import pathlib
import sys
import tempfile
import unittest

import numpy as np

from folder_case import call
from known_flight import format_tum

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
from evaluate_loops import evaluate_loops, main  # noqa: E402
from evaluation.loops import Loops, closed_share, loop_errors, revisits  # noqa: E402
from evaluation.trajectory import RESTART, Trajectory  # noqa: E402

START = 1403636580.0  # [s], as large as real timestamps
ROUND = 20.0  # [s]
HEADER = "later_ns,earlier_ns,result,x_m,y_m,z_m,yaw_deg\n"


def about_z(angles):
    c, s, zero = np.cos(angles), np.sin(angles), np.zeros_like(angles)
    return np.stack([np.stack([c, -s, zero], axis=-1), np.stack([s, c, zero], axis=-1),
                     np.stack([zero, zero, zero + 1], axis=-1)], axis=-2)


def rounds(count=2, sway=0.0):
    """Rounds of 4 m radius that face forward, at a speed that varies with `sway` [rad]."""
    t = np.arange(0.0, count * ROUND, 0.05)
    angles = 2 * np.pi * t / ROUND + sway * np.sin(t)
    positions = np.stack([4 * np.cos(angles), 4 * np.sin(angles), 0 * t], axis=1)
    return Trajectory(START + t, positions, about_z(angles))


def drifting(truth, turn=1.0, turn_rate=0.01):
    """Odometry whose world is rotated by `turn` [rad] relative to the true one, with increasing
    drift."""
    turns = about_z(turn + turn_rate * (truth.stamps - START))
    positions = np.einsum("nij,nj->ni", turns, truth.positions) + [5, 6, 7]
    return Trajectory(truth.stamps, positions, turns @ truth.rotations)


def true_loop(truth, earlier, later, turn=1.0, turn_rate=0.01):
    """Returns position and yaw of an error-free loop between two timestamps [s since START]."""
    first, second = (truth.positions[int(round(t / 0.05))] for t in (earlier, later))
    position = about_z(np.array(turn + turn_rate * earlier)) @ (second - first)
    return position, turn_rate * (earlier - later)


class LoopErrors(unittest.TestCase):
    def setUp(self):
        self.truth = rounds()
        self.odometry = drifting(self.truth)
        self.position, self.yaw = true_loop(self.truth, 2.0, 22.5)

    def errors(self, position, yaw):
        loops = Loops(np.array([START + 2.0]), np.array([START + 22.5]), position[None, :],
                      np.array([yaw]))
        distances, turns = loop_errors(loops, self.odometry, self.truth)
        return distances[0], turns[0]

    def test_a_true_loop_has_none(self):
        distance, turn = self.errors(self.position, self.yaw)
        self.assertLess(distance, 1e-9)
        self.assertLess(turn, 1e-6)

    def test_a_wrong_one_has_what_it_is_off_by(self):
        distance, turn = self.errors(self.position + [0.3, 0, 0.4], self.yaw + 2 * np.pi - 0.1)
        self.assertAlmostEqual(distance, 0.5, 6)
        self.assertAlmostEqual(turn, np.degrees(0.1), 6)


class TruthBetweenItsPoses(unittest.TestCase):
    def setUp(self):
        self.truth = rounds(sway=0.5)
        self.odometry = drifting(self.truth)
        self.loops = Loops(np.array([START + 2.05]), np.array([START + 22.55]),
                           *(np.array([value]) for value in true_loop(self.truth, 2.05, 22.55)))

    def test_is_interpolated(self):
        every_tenth_second = self.truth.select(slice(None, None, 2))
        self.assertEqual(len(self.loops.with_truth(every_tenth_second)), 1)
        distances, turns = loop_errors(self.loops, self.odometry, every_tenth_second)
        self.assertLess(distances[0], 0.01)  # 0.042 with the nearest pose instead of interpolation
        self.assertLess(turns[0], 0.1)  # 0.6

    def test_position_is_on_the_straight_way_and_rotation_on_the_shortest_turn(self):
        poses = Trajectory(START + np.array([0.0, 1, 3]), np.array([[0.0, 0, 0], [1, 0, 0],
                                                                    [1, 4, 0]]),
                           about_z(np.radians([170.0, -170, -150])))
        between = poses.at(START + np.array([-1.0, 0.25, 1, 1.5, 9]))
        np.testing.assert_allclose(between.positions, [[0, 0, 0], [0.25, 0, 0], [1, 0, 0],
                                                       [1, 1, 0], [1, 4, 0]], atol=1e-9)
        np.testing.assert_allclose(between.rotations, about_z(np.radians(
            [170.0, 175, -170, -165, -150])), atol=1e-9)

    def test_long_gaps_and_what_is_beyond_the_ends_are_not_known(self):
        stamps = self.truth.stamps - START
        for kept, known in ((slice(None, None, 4), 1), (slice(None, None, 5), 0),
                            (stamps > 2.01, 1), (stamps > 2.06, 0), (stamps < 22.54, 0),
                            (np.abs(stamps - 22.55) % 1 < 0.01, 0)):
            truth = self.truth.select(kept)
            self.assertEqual(len(self.loops.with_truth(truth)), known)
        # At a pose next to a gap the position is known.
        self.assertEqual(len(self.loops.with_truth(self.truth.select(
            (np.abs(stamps - 2.05) < 0.01) | (np.abs(stamps - 22.55) < 0.01) | (stamps > 30)))), 1)


class Revisits(unittest.TestCase):
    def test_only_the_second_round_is_one(self):
        times, returned = revisits(rounds())
        times -= START
        self.assertAlmostEqual(times[0], ROUND - 0.8, delta=0.25)  # 1 m before the start
        self.assertEqual(len(times), 1 + round((times[-1] - times[0]) / 0.25))
        self.assertTrue(returned.all())

    def test_who_stays_has_not_returned(self):
        truth = rounds(count=1)
        truth.positions *= 0.1  # radius 0.4 m
        truth.rotations[:] = np.eye(3)
        truth.stamps = np.linspace(START, START + 30, len(truth.stamps))
        times, returned = revisits(truth)
        self.assertAlmostEqual(times[0], START + 15, delta=0.3)
        self.assertFalse(returned.any())

    def test_the_same_place_in_another_direction_is_none(self):
        truth = rounds(count=1.9)
        later = truth.stamps >= START + ROUND - 1
        truth.rotations[later] = truth.rotations[later] @ about_z(np.array(np.pi))
        self.assertEqual(len(revisits(truth)[0]), 0)

    def test_a_gap_of_the_truth_is_none(self):
        turn = rounds(count=1)
        left, back = turn.stamps < START + 5, turn.stamps > START + 12
        turn.stamps[back] += 200.0  # position where the first half ends
        turn.positions[back] = turn.positions[left][-1] + [2, 0, 0]
        self.assertEqual(len(revisits(turn.select(left | back))[0]), 0)

    def test_a_loop_closes_what_is_a_second_around_it(self):
        loops = Loops(np.array([1.0]), np.array([21.0]), np.zeros((1, 3)), np.zeros(1))
        self.assertEqual(closed_share(loops, np.array([20.5, 21.5, 22.5, 23.5])), 0.5)
        none = Loops(np.empty(0), np.empty(0), np.empty((0, 3)), np.empty(0))
        self.assertEqual(closed_share(none, np.array([20.5])), 0)
        self.assertIsNone(closed_share(loops, np.array([])))


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.truth = rounds()
        self.write("truth.tum", self.truth)
        self.write("trajectory.tum", drifting(self.truth))
        for name in ("trajectory_map.tum", "trajectory_final.tum"):
            self.write(name, self.truth)

    def write(self, name, trajectory):
        (self.folder / name).write_text(format_tum(trajectory), encoding="utf-8")

    def write_loops(self, *rows):
        text = HEADER + "".join(",".join(str(word) for word in row) + "\n" for row in rows)
        (self.folder / "loops.csv").write_text(text, encoding="utf-8")

    def row(self, result, offset=0.0):
        position, yaw = true_loop(self.truth, 2.0, 22.5)
        stamps = [int(START + t) * 10**9 + int(t % 1 * 1e9) for t in (22.5, 2.0)]
        return *stamps, result, *(position + [offset, 0, 0]), np.degrees(yaw)

    def test_counts_false_loops_among_the_accepted(self):
        self.write_loops(self.row("accepted"), self.row("accepted", 0.5), self.row("lines", 9.0))
        result = evaluate_loops(self.folder, self.folder / "truth.tum")
        self.assertEqual((result["loops"], result["false_loops"]), (2, 1))
        self.assertAlmostEqual(result["largest_error_m"], 0.5, 4)
        self.assertAlmostEqual(result["closed_share"], 0.1, delta=0.02)
        self.assertEqual(result["closed_share_of_returns"], result["closed_share"])
        self.assertGreater(result["ape_m"]["trajectory.tum"], 0.1)
        self.assertLess(result["ape_m"]["trajectory_final.tum"], 1e-6)

    def test_leaves_out_what_leads_to_another_recording(self):
        later, _, *rest = self.row("accepted")
        for earlier in (START - 1000.0, START + 1000.0, START + 2.02):
            self.write_loops(self.row("accepted"), (later, round(earlier * 1e9), *rest))
            result = evaluate_loops(self.folder, self.folder / "truth.tum")
            self.assertEqual((result["loops"], result["loops_left_out"]), (1, 1))
            self.assertEqual(result["false_loops"], 0)
        run = call(main, self.folder, self.folder / "truth.tum")
        self.assertIn("excluded: 1 to poses that are not in trajectory.tum", run.stdout)

    def test_leaves_out_what_has_no_truth(self):
        gap = np.abs(self.truth.stamps - START - 22.5) < 1
        self.write("truth.tum", self.truth.select(~gap))
        self.write_loops(self.row("accepted", 0.5))
        result = evaluate_loops(self.folder, self.folder / "truth.tum")
        self.assertEqual((result["loops"], result["loops_without_truth"]), (0, 1))
        self.assertEqual(result["false_loops"], 0)
        run = call(main, self.folder, self.folder / "truth.tum")
        self.assertIn("excluded: 1 where the ground truth has a gap", run.stdout)

    def test_loops_to_another_recording_close_nothing(self):
        later, _, *rest = self.row("accepted")
        self.write_loops((later, 10**9, *rest))
        result = evaluate_loops(self.folder, self.folder / "truth.tum")
        self.assertEqual((result["loops"], result["loops_left_out"]), (0, 1))
        self.assertEqual(result["closed_share"], 0)

    def test_ground_truth_of_another_time(self):
        self.write_loops(self.row("accepted"))
        self.write("other.tum", self.truth.shifted(1000.0))
        run = call(main, self.folder, self.folder / "other.tum")
        self.assertEqual(run.returncode, 1)
        for words in ("no overlap in time", "trajectory.tum", "other.tum"):
            self.assertIn(words, run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_coverage_and_worlds_are_beside_the_ape(self):
        self.write_loops(self.row("accepted"))
        half = self.truth.select(self.truth.stamps >= START + ROUND)
        self.write("trajectory_map.tum", half)
        rows = format_tum(self.truth).splitlines(keepends=True)
        rows.insert(100, RESTART + ": lost\n")
        (self.folder / "trajectory_final.tum").write_text("".join(rows), encoding="utf-8")
        run = call(main, self.folder, self.folder / "truth.tum")
        for words in (r"coverage 100.0 %  1 world  odometry", r"coverage  49.9 %  1 world  map, ",
                      r"coverage 100.0 %  2 worlds  map, as known in the end",
                      "APE over several world frames means little"):
            self.assertRegex(run.stdout, words)
        self.write("trajectory_final.tum", self.truth)
        self.assertNotIn("means little",
                         call(main, self.folder, self.folder / "truth.tum").stdout)

    def test_a_place_that_is_never_found(self):
        self.write_loops(self.row("accepted"))
        for poses, words in ((0, "time: no pose in the map"), (2, "2 poses in the map, too few")):
            self.write("trajectory_map.tum", self.truth.select(slice(0, poses)))
            run = call(main, self.folder, self.folder / "truth.tum")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("1 loops, 0 false", run.stdout)
            self.assertIn(words, run.stdout)
            result = evaluate_loops(self.folder, self.folder / "truth.tum")
            self.assertIsNone(result["ape_m"]["trajectory_map.tum"])
            self.assertEqual(result["poses"]["trajectory_map.tum"], poses)
            self.assertLess(result["coverage"]["trajectory_map.tum"], 0.01)

    def test_no_loops_have_no_largest_error(self):
        self.write_loops(self.row("pose"))
        run = call(main, self.folder, self.folder / "truth.tum")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("no loops to compare\n", run.stdout)
        self.assertNotIn("largest error", run.stdout)

    def write_run_with_time_offset(self, td):
        """Writes a run with timestamps shifted by -`td` [s]; whole intervals, so associations still
        succeed."""
        self.truth = rounds(sway=0.5)
        self.write("truth.tum", self.truth)
        self.write("trajectory.tum", drifting(self.truth).shifted(-td))
        for name in ("trajectory_map.tum", "trajectory_final.tum"):
            self.write(name, self.truth.shifted(-td))
        later, earlier, *rest = self.row("accepted")
        self.write_loops((later - round(td * 1e9), earlier - round(td * 1e9), *rest))
        (self.folder / "summary.json").write_text(
            json.dumps({"calibration": {"td_s": td}}), encoding="utf-8")

    def test_time_offset_of_the_run(self):
        self.write_run_with_time_offset(0.05)
        run = call(main, self.folder, self.folder / "truth.tum")
        self.assertIn("stamps of the run shifted by +50.00 ms", run.stdout)
        result = evaluate_loops(self.folder, self.folder / "truth.tum")
        self.assertEqual((result["loops"], result["t_offset_s"]), (1, 0.05))
        self.assertLess(result["largest_error_m"], 1e-5)
        self.assertLess(result["ape_m"]["trajectory_final.tum"], 1e-6)
        run = call(main, self.folder, self.folder / "truth.tum", "--t-offset", "0")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("shifted", run.stdout)
        result = evaluate_loops(self.folder, self.folder / "truth.tum", t_offset=0.0)
        self.assertGreater(result["largest_error_m"], 0.02)
        self.assertGreater(result["ape_m"]["trajectory_final.tum"], 0.01)

    def test_prints_and_writes_the_figures(self):
        self.write_loops(self.row("accepted", 0.1))
        json_file = self.folder / "loops.json"
        run = call(main, self.folder, self.folder / "truth.tum", "--json", json_file)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("1 loops, 0 false", run.stdout)
        self.assertEqual(json.loads(json_file.read_text(encoding="utf-8"))["loops"], 1)

    def test_says_what_is_missing(self):
        run = call(main, self.folder, self.folder / "truth.tum")
        self.assertEqual(run.returncode, 1)
        self.assertIn("loops.csv", run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
