#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests run_offline on simulated flights: interrupts, and a second flight in the map of the first.

Usage: run_flight_test.py SIMULATE RUN_OFFLINE FLIGHT [unittest option ...]
FLIGHT: ASL folder of a fast flight of 30 s, which revisits positions after 15 s.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "test" / "tools")]

from evaluation import metrics  # noqa: E402
from evaluation.trajectory import read_trajectory  # noqa: E402
from stress import feature_file  # noqa: E402
from stress.faults import FAULTS  # noqa: E402

CONFIG = ROOT / "config" / "euroc.yaml"
SIMULATE, RUN_OFFLINE, SECOND = sys.argv[1:4] if len(sys.argv) > 3 else sys.exit(__doc__)
RATE_HZ = 10
IMAGES = 100  # of the first flight
SECONDS = 30  # of the second flight
CLOCK_ERROR_NS = 100_000_000_000
PATIENCE = 300  # [s]


def heed_signals():
    """Restores the default signal handlers, since programs in the background of a shell ignore
    SIGINT."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)


def start(*options):
    command = [RUN_OFFLINE, "--config", CONFIG, *options]
    return subprocess.Popen([str(word) for word in command], stderr=subprocess.PIPE,
                            encoding="utf-8", preexec_fn=heed_signals)


def wait_until(is_so):
    deadline = time.monotonic() + PATIENCE
    while not is_so() and time.monotonic() < deadline:
        time.sleep(0.005)


class RunFlight(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.flights = pathlib.Path(folder.name)
        command = [SIMULATE, "--asl", cls.flights / "first", "--config", CONFIG, "--motion",
                   "gentle", "--duration", IMAGES / RATE_HZ, "--frame-rate", RATE_HZ,
                   "--exposure", 0]
        subprocess.run([str(word) for word in command], stderr=subprocess.DEVNULL, check=True)
        (cls.flights / "second").symlink_to(SECOND)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.results = self.folder / "results"

    def run_flight(self, flight, *options, exit_code=0):
        """Returns the error output of the program."""
        process = start("--asl", flight, "--output", self.results, *options)
        error = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, exit_code, error)
        return error

    def start_first(self, *options, images=1, flight="first"):
        """Returns the process as soon as it has processed `images` images."""
        shutil.rmtree(self.results, ignore_errors=True)
        process = start("--asl", self.flights / flight, "--output", self.results,
                        "--save-track-images", 1e-3, "--threads", 1, *options)
        self.addCleanup(process.stderr.close)
        wait_until(lambda: process.poll() is not None
                   or len(list(self.results.glob("tracks/*.jpg"))) >= images)
        self.assertIsNone(process.poll())
        return process

    def summary(self):
        return json.loads((self.results / "summary.json").read_text(encoding="utf-8"))

    def test_an_interrupted_run_leaves_complete_files(self):
        saved = ["--map-out", self.folder / "map.plm", "--save-features", self.folder / "features"]
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start_first(*saved, images=40)
            process.send_signal(number)
            error = process.communicate(timeout=PATIENCE)[1]
            self.assertEqual(process.returncode, 128 + number, error)
            self.assertRegex(error, r"\nrun_offline: interrupted at \d+\.\d s\n$")
            frames = self.summary()["frames"]
            self.assertLess(frames, IMAGES - 1)
            rows = (self.results / "timing.csv").read_text(encoding="utf-8").split("\n")
            self.assertEqual(len(rows), frames + 2)  # a header, and a newline at the end
            self.assertEqual(len(rows[0].split(",")), len(rows[-2].split(",")))
            self.assertFalse(list(self.folder.rglob("*.part")))
            again = start("--features", self.folder / "features", "--output", self.folder / "again")
            again.communicate(timeout=PATIENCE)
            summary = (self.folder / "again" / "summary.json").read_text(encoding="utf-8")
            self.assertEqual(json.loads(summary)["frames"], frames)
            feature_file.make_faulty(saved[-1], self.folder / "copy", FAULTS["none"].apply, 0)
            self.assertEqual((self.folder / "copy").read_bytes(), saved[-1].read_bytes())
        self.run_flight(self.flights / "first", "--map-in", self.folder / "map.plm")

    def test_a_second_signal_ends_the_program_at_once(self):
        process = self.start_first()
        os.mkfifo(self.results / "lines.ply")  # blocks the program's exit, since nobody reads it
        process.send_signal(signal.SIGINT)
        picture = self.results / "line_tracks.png"
        wait_until(lambda: process.poll() is not None or picture.exists())
        time.sleep(0.2)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=PATIENCE), -signal.SIGTERM)

    def test_a_signal_after_the_last_image_that_cuts_nothing_short(self):
        process = self.start_first()
        pipe = self.results / "lines.ply"
        os.mkfifo(pipe)
        picture = self.results / "line_tracks.png"
        wait_until(lambda: process.poll() is not None or picture.exists())
        process.send_signal(signal.SIGINT)
        pipe.read_text(encoding="utf-8")
        error = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, 0, error)
        self.assertNotIn("interrupted", error)

    def test_an_interrupted_run_does_not_adjust_its_map(self):
        process = self.start_first("--set", "loop_closure=1", flight="second",
                                   images=(SECONDS - 2) * RATE_HZ)
        process.send_signal(signal.SIGINT)
        error = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, 128 + signal.SIGINT, error)
        self.assertGreater(self.summary()["loops"]["accepted"], 3)
        self.assertNotIn("adjusting the map", error)

    def test_a_signal_while_the_map_is_adjusted(self):
        process = self.start_first("--set", "loop_closure=1", flight="second")
        for line in process.stderr:
            if line.startswith("adjusting the map"):
                break
        process.send_signal(signal.SIGINT)
        error = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, 128 + signal.SIGINT, error)
        self.assertIn("interrupted while the map was adjusted", error)
        bundle = self.summary()["loops"]["bundle"]
        self.assertTrue(bundle is None or bundle["rounds"] < 3, bundle)
        self.assertEqual(len(read_trajectory(self.results / "trajectory_final.tum")),
                         self.summary()["poses"])

    def test_results_stay_where_the_map_and_features_cannot_be_saved(self):
        gone = self.folder / "gone"
        gone.mkdir()
        process = self.start_first("--map-out", gone / "map.plm", "--save-features",
                                   gone / "flight.features")
        shutil.rmtree(gone)
        error = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, 1, error)
        for name in ("map.plm", "flight.features"):
            self.assertIn(f"cannot write {gone / name}", error)
        self.assertIn("loops", self.summary())
        self.assertEqual(len(read_trajectory(self.results / "trajectory_final.tum")),
                         self.summary()["poses"])

    def copy_with_imu(self, change):
        """The first flight with other rows of the IMU: those that `change` makes of stamp [ns] and
        values, None for none."""
        flight = self.folder / "flight"
        shutil.copytree(self.flights / "first", flight)
        table = flight / "mav0" / "imu0" / "data.csv"
        header, *rows = table.read_text(encoding="utf-8").splitlines()
        rows = [change(int(row.split(",")[0]), row.split(",", 1)[1]) for row in rows]
        table.write_text("\n".join([header, *filter(None, rows)]) + "\n", encoding="utf-8")
        return flight

    def test_two_clocks(self):
        flight = self.copy_with_imu(lambda stamp, values: f"{stamp + CLOCK_ERROR_NS},{values}")
        error = self.run_flight(flight, exit_code=1)
        self.assertRegex(error, "have different clocks: stamps are 16000000[0-9.]* s and "
                                "16000001[0-9.]* s at a time, apart by -[0-9.]* s; stamp both")
        error = self.run_flight(flight, "--duration", 2, exit_code=1)
        self.assertIn("warning: images begin at 1600000000.100 s and no IMU sample comes "
                      "before their end; both must be stamped by the same clock\n", error)

    def test_a_gyro_that_is_missing(self):
        flight = self.copy_with_imu(
            lambda stamp, values: f"{stamp},0,0,0,{values.split(',', 3)[3]}")
        error = self.run_flight(flight)
        self.assertIn("\nmost wrong: angular velocity is zero or NaN in every sample: is imu_topic "
                      "/imu0", error)

    def test_a_gap_in_the_imu(self):
        begin, end = 1_600_000_005_000_000_000, 1_600_000_008_000_000_000
        flight = self.copy_with_imu(
            lambda stamp, values: f"{stamp},{values}" if not begin < stamp < end else None)
        error = self.run_flight(flight)
        self.assertIn("imu_gaps: 1 (first: 3.000 s without samples, from 1600000005.000 s on)",
                      error)
        self.assertIn("a gap of 3.0 s in the IMU samples: ", error)
        self.assertRegex(error, "no pose for [0-9.]+ of [0-9.]+ s: no usable image .3.[0-9] s.")

    def test_a_second_flight_in_the_map_of_the_first(self):
        second = self.flights / "second"
        plm = self.folder / "map.plm"
        said = self.run_flight(self.flights / "first", "--map-out", plm)
        self.assertRegex(said, r"\n100 images, \d+ poses in .*\n1 world frame: from [\d.]+ s on\n"
                               r"no pose for [\d.]+ of 9.9 s: ")
        mapped = read_trajectory(self.results / "trajectory_final.tum")
        truth = read_trajectory(self.flights / "first" / "groundtruth.tum")
        rotation, translation = metrics.alignment(mapped, truth.at(mapped.stamps), "se3")

        lines = self.run_flight(second, "--map-in", plm, "--duration", 14)
        self.assertRegex(lines, "; the loaded map was recognized after [0-9.]+ s, [1-9][0-9]* times"
                         " in all\n")
        self.assertLess(self.summary()["loops"]["first_fix_s"], 5)
        poses = read_trajectory(self.results / "trajectory_map.tum")
        self.assertGreater(len(poses), 50)
        poses = poses.transformed(rotation, translation)
        truth = read_trajectory(second / "groundtruth.tum").at(poses.stamps)
        errors = np.linalg.norm(poses.positions - truth.positions, axis=1)
        steps = np.linalg.norm(np.diff(poses.positions - truth.positions, axis=0), axis=1)
        print(f"{self.id()}: {len(poses)} poses in the map, off by {1000 * errors.mean():.0f} mm,"
              f" {1000 * errors.max():.0f} mm at most; largest step {1000 * steps.max():.0f} mm")
        self.assertLess(errors.mean(), 0.03)
        self.assertLess(errors.max(), 0.06)
        self.assertLess(steps.max(), 0.03)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
