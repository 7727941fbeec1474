#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests simulate, run_offline, evaluate.py and evaluate_loops.py together on simulated flights.

Usage: end_to_end_test.py SIMULATE RUN_OFFLINE FLIGHT [unittest option ...]
FLIGHT: ASL folder of a fast flight in the room, of 30 s.
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "test" / "testing"))

import pair_flight  # noqa: E402

CONFIG = ROOT / "config" / "euroc.yaml"
SIMULATE, RUN_OFFLINE, FLIGHT = sys.argv[1:4] if len(sys.argv) > 3 else sys.exit(__doc__)
DURATION = 12  # [s]
LOOP_RESULTS = ("trajectory_map.tum", "covariance_map.csv", "trajectory_final.tum", "loops.csv")


def run(*command):
    """Runs a program; if it fails, the test fails with the program's output."""
    result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, encoding="utf-8", check=False)
    if result.returncode != 0:
        raise AssertionError(f"{command[0]} failed:\n{result.stderr}")


def read_json(path):
    return json.loads(path.read_text(encoding="utf-8"))


class Flight:
    """A recording with its ground truth, and a temporary folder for results."""

    def __init__(self, recording=None):
        self._folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self._folder.name)
        self.recording = recording or self.path / "flight"
        self.config = CONFIG

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._folder.cleanup()

    def with_small_images(self):
        self.config = self.path / "small.yaml"
        self.config.write_text(pair_flight.halve_images(CONFIG.read_text(encoding="utf-8")),
                               encoding="utf-8")
        return self

    def simulate(self, *options, duration=DURATION):
        """Renders ten images per second, since this takes most of the time of a test."""
        run(SIMULATE, "--asl", self.recording, "--config", self.config, "--duration", duration,
            "--frame-rate", 10, *options)
        return self

    def estimate(self, *options, config=None):
        """Returns the summary of the odometry and its comparison with the ground truth."""
        results = self.path / "results"
        run(RUN_OFFLINE, "--config", config or self.config, "--asl", self.recording, "--output",
            results, *options)
        return (read_json(results / "summary.json"),
                self._evaluate("evaluate.py", results / "trajectory.tum"))

    def close_loops(self, *options):
        """Returns the summary of the loops, and their comparison with the ground truth."""
        summary, _ = self.estimate("--set", "loop_closure=1", *options)
        return summary["loops"], self._evaluate("evaluate_loops.py", self.path / "results")

    def results(self, names):
        """Returns the contents of these result files."""
        return {name: (self.path / "results" / name).read_bytes() for name in names}

    def _evaluate(self, script, results):
        figures = self.path / "figures.json"
        run("/usr/bin/python3", "-B", ROOT / "scripts" / script, results,
            pathlib.Path(self.recording) / "groundtruth.tum", "--json", figures)
        return read_json(figures)


def with_turned_camera(text, angle):
    """Returns the configuration `text` with the camera rotated about its optical axis by `angle`
    [rad]."""
    matrix = re.search(r"(extrinsicRotation:.*?data: \[)(.*?)\]", text, re.DOTALL)
    values = [float(value) for value in matrix.group(2).split(",")]
    cosine, sine = math.cos(angle), math.sin(angle)
    turned = [value for x, y, z in zip(*[iter(values)] * 3)
              for value in (cosine * x + sine * y, cosine * y - sine * x, z)]
    data = ", ".join(f"{value:.15f}" for value in turned)
    return text[:matrix.start(2)] + data + text[matrix.end(2):]


def angle_between(first, second):
    """Returns the angle between two unit quaternions [rad]."""
    return 2 * math.acos(min(1.0, abs(sum(a * b for a, b in zip(first, second)))))


class Odometry(unittest.TestCase):
    def assert_accurate(self, evaluation, greatest_share):
        """Expects an APE of at most this share of the path, and poses for nearly the whole
        flight."""
        share = evaluation["ape_m"]["rmse"] / evaluation["ground_truth_path_m"]
        print(f"{self.id()}: APE {1000 * evaluation['ape_m']['rmse']:.1f} mm,"
              f" {100 * share:.2f} % of the path, coverage {100 * evaluation['coverage']:.1f} %")
        self.assertLessEqual(share, greatest_share)
        self.assertGreater(evaluation["coverage"], 0.9)

    # Each bound is at least twice the measured value: 0.06 % of the path in the gentle flight,
    # 0.2 % in the fast one, 0.3 % in the corridor. Only the fast one has motion blur.

    def test_gentle_flight_through_a_room(self):
        with Flight().simulate("--motion", "gentle", "--exposure", 0) as flight:
            summary, evaluation = flight.estimate()
            self.assert_accurate(evaluation, 0.002)
            self.assertEqual(summary["resets"], 0)
            self.assertLess(summary["init_time_s"], 2)
            self.assertTrue((flight.path / "results" / "tracks.png").is_file())

    def test_fast_flight_recovers_a_turned_camera(self):
        text = CONFIG.read_text(encoding="utf-8")
        with Flight().simulate("--motion", "fast") as flight:
            truth, evaluation = flight.estimate()
            self.assert_accurate(evaluation, 0.005)

            config = flight.path / "turned.yaml"
            config.write_text(with_turned_camera(text, math.radians(1)), encoding="utf-8")
            wrong, _ = flight.estimate(config=config)
            refined, evaluation = flight.estimate("--set", "estimate_extrinsic=1", config=config)
            self.assert_accurate(evaluation, 0.005)
            errors = [math.degrees(angle_between(summary["calibration"]["q_B_C_xyzw"],
                                                 truth["calibration"]["q_B_C_xyzw"]))
                      for summary in (wrong, refined)]
            print(f"{self.id()}: camera {errors[0]:.2f} deg off, then {errors[1]:.2f} deg")
            self.assertAlmostEqual(errors[0], 1, places=3)
            self.assertLess(errors[1], 0.3)

    def test_straight_flight_through_a_corridor(self):
        with Flight().with_small_images().simulate(
                "--world", "corridor", "--motion", "straight", "--exposure", 0) as flight:
            self.assert_accurate(flight.estimate()[1], 0.01)


def fast_flight(world):
    """Returns a flight that revisits its start after 15 s, without motion blur."""
    return Flight().with_small_images().simulate("--world", world, "--motion", "fast",
                                                 "--exposure", 0, duration=24)


class LoopsInRooms(unittest.TestCase):
    def assert_closed(self, flight):
        summary, loops = flight.close_loops()
        self.assertEqual(summary["bundle"]["rounds"], 3)
        self.assertEqual(loops["false_loops"], 0)
        self.assertGreater(loops["closed_share"], 0.6)

    def test_room_without_right_angles(self):
        with fast_flight("irregular") as flight:
            self.assert_closed(flight)

    def test_room_by_any_number_of_threads(self):
        with Flight(FLIGHT) as flight:
            self.assert_closed(flight)
            self.assert_same_bytes_with_one_thread(flight)

    def assert_same_bytes_with_one_thread(self, flight):
        before = flight.results(LOOP_RESULTS)
        flight.close_loops("--threads", 1)
        for name, content in flight.results(LOOP_RESULTS).items():
            self.assertEqual(content, before[name], name)


class LoopsAmongEquals(unittest.TestCase):
    def test_two_equal_rooms_are_not_taken_for_one(self):
        with fast_flight("twins") as flight:
            summary, loops = flight.close_loops()
        self.assertGreater(summary["refused"]["odometry"], 0)  # of the equal room
        self.assertEqual(loops["false_loops"], 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
