#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/run_dataset.py on one machine: results, failures, interrupts, invalid calls."""

import os
import shutil
import signal
import subprocess
import unittest

from dataset_case import DatasetTest, flight
from fake_run_offline import write_tum


class Results(DatasetTest):
    def test_sequences_by_variants(self):
        self.add("MH_01_easy")
        self.add("hall")
        result = self.call("--variants", "baseline", "improved", "--set", "max_cnt=99")
        self.assertEqual(len(self.calls()), 4)
        self.assertTrue(all("--set max_cnt=99" in call for call in self.calls()))
        self.assertIn("[4/4] hall improved from_0.0s_1: APE 0.1", result.stderr)
        self.assertEqual(len(self.rows()), 4)
        for row in self.rows():
            self.assertAlmostEqual(float(row["ape_m"]),
                                   0.2 if row["variant"] == "baseline" else 0.1, 3)
            self.assertAlmostEqual(float(row["coverage_percent"]), 95.0, 3)
            self.assertEqual((row["status"], row["frame_ms"], row["frame_p99_ms"]),
                             ("compared", "10", "21"))
        table = r"MH_01_easy +\| 0\.2\d+ \(95 %\) +\| 0\.1\d+ \(95 %\)"
        self.assertRegex(result.stdout, table)
        self.assertRegex(self.report(), table)
        self.assertRegex(self.report(), r"MH_01_easy +\| 0\.18 +\| 0\.16 +\| 0\.14 +\| 0\.2")

    def test_coverage_of_a_part_counts_that_part_only(self):
        self.add("hall")
        self.call("--variants", "improved", "--start", "5", "--duration", "10")
        self.assertIn("--start 5.0 --duration 10.0", self.calls()[0])
        self.assertAlmostEqual(float(self.rows()[0]["coverage_percent"]), 90.0, 0)

    def test_steps_of_the_ground_truth(self):
        self.add("hall")
        stamps, positions = flight(rate=100.0)
        positions[abs(stamps - stamps[0] - 11.505) < 0.5, 0] += 0.5
        write_tum(self.path("bags", "hall.tum"), stamps, positions)
        arguments = ("--variants", "improved", "--duration", "13.5")
        result = self.call(*arguments)
        self.assertIn("hall: the ground truth has steps of 500 mm at 11.0 s, 500 mm at"
                      " 12.0 s after its first pose", result.stderr)
        self.assertIn("**The ground truth has steps** (hall: 2, of up to 500 mm)", self.report())
        disturbed = float(self.rows()[0]["ape_m"])
        self.call(*arguments, "--without-steps")
        self.assertEqual(len(self.calls()), 1)  # only the evaluation is repeated
        self.assertGreater(disturbed, float(self.rows()[0]["ape_m"]) + 0.02)
        self.assertIn("Ground truth without 1.5 s before", self.report())

    def test_starts(self):
        self.add("hall", "fly drift stumble")
        result = self.call("--variants", "baseline", "improved", "--starts", "5", "0", "10",
                           exit_code=1)
        self.assertEqual(len(self.calls()), 6)
        self.assertIn("hall improved from_10.0s_1: FAILED: no trajectory", result.stderr)
        self.assertIn("from 0, 5, 10 s on", self.report())
        rows = [row for row in self.rows() if row["variant"] == "improved"]
        self.assertEqual([row["start_s"] for row in rows], ["0", "5", "10"])
        for row, ape, coverage in zip(rows, (0.1, 0.15), (95, 100 * 14 / 15)):
            self.assertAlmostEqual(float(row["ape_m"]), ape, 3)
            self.assertAlmostEqual(float(row["coverage_percent"]), coverage, 0)
        self.assertRegex(self.report(), r"\| 0\.12\d+ ± 0\.03\d+ \[0\.1\d+, 0\.15\d+\]"
                                        r" \(94 %\) over 2 runs, 1 of 3 failed")
        self.assertRegex(self.report(), r"\*\*mean\*\* of the 2 that all variants have")
        self.assertRegex(self.report(), r"\| hall +\| improved +\| 10 +\| no trajectory")

    def test_repetitions(self):
        self.add("hall")
        self.call("--variants", "improved", "--repetitions", "3")
        self.assertEqual(len(self.calls()), 3)
        self.assertEqual([row["repetition"] for row in self.rows()], ["1", "2", "3"])
        self.assertRegex(self.report(), r"0\.10\d+ ± 0\.0000 \[.*\] \(95 %\) over 3 runs")
        with open(os.path.join(self.output, "ape.png"), "rb") as file:
            self.assertEqual(file.read(4), b"\x89PNG")

    def test_without_ground_truth(self):
        self.add("hall", truth=False)
        result = self.call("--variants", "points", "improved")
        self.assertIn("ground truth: none", result.stdout)
        self.assertIn("hall.tum", result.stdout)
        self.assertEqual({row["status"] for row in self.rows()}, {"no ground truth"})
        self.assertEqual(float(self.rows()[0]["real_time_factor"]), 5.0)
        self.assertIn("Not compared", self.report())

    def test_ground_truth_that_cannot_be_read_is_none(self):
        self.add("hall")
        self.add("room")
        self.write(os.path.join("bags", "hall.tum"), "1 2 3\n")
        result = self.call("--variants", "improved", "--starts", "0", "5")
        self.assertIn("hall.tum:1: 3 columns, expected 8 columns (TUM); it runs without",
                      result.stderr)
        self.assertEqual([row["status"] == "compared" for row in self.rows()],
                         [False, False, True, True])
        self.assertIn("no readable ground truth: ", self.rows()[0]["status"])

    def test_ground_truth_of_another_time(self):
        self.add("hall")
        stamps, positions = flight()
        write_tum(self.path("bags", "hall.tum"), stamps + 1000, positions)
        self.call("--variants", "improved")
        self.assertIn("no overlap in time", self.rows()[0]["status"])
        self.assertIn("no overlap in time", self.report())

    def test_the_last_part_of_a_run_is_not_compared(self):
        self.add("hall", "fly jump")
        self.call("--variants", "improved", "--starts", "0", "5")
        for row in self.rows():
            self.assertIn("jumped back, earlier poses are in trajectory_1.tum", row["status"])
            self.assertEqual((row["ape_m"], row["coverage_percent"], row["init_time_s"]),
                             ("", "", "1"))
        self.assertIn("trajectory_1.tum", self.report())


class Failures(DatasetTest):
    def test_are_shown_with_their_reason_and_tried_again(self):
        self.add("a_good")
        self.add("b_fails", "fail")
        self.add("c_crashes", "crash")
        self.add("d_loses", "lose")
        result = self.call("--variants", "improved", exit_code=1)
        self.assertIn("3 of 4 runs failed", result.stderr)
        self.assertIn("b_fails improved from_0.0s_1: FAILED: no trajectory from 400 images",
                      result.stderr)
        statuses = {row["sequence"]: row["status"] for row in self.rows()}
        self.assertEqual(statuses["a_good"], "compared")
        self.assertEqual(statuses["b_fails"],
                         "no trajectory from 400 images: too little motion")
        self.assertIn("SIGKILL", statuses["c_crashes"])
        self.assertIn("no trajectory.tum", statuses["d_loses"])
        self.assertIn("run.log", statuses["d_loses"])
        report = self.report()
        for reason in list(statuses.values())[1:]:
            self.assertIn(reason, report)
        self.assertRegex(report, r"b_fails +\| \*\*failed\*\*")
        self.add("b_fails")
        self.call("--variants", "improved", exit_code=1)
        self.assertEqual(len(self.calls()), 4 + 3)
        self.assertEqual({row["sequence"]: row["status"] for row in self.rows()}["b_fails"],
                         "compared")

    def test_mean_is_of_sequences_that_all_variants_have(self):
        self.add("a_good")
        self.add("b_fails", "fail")
        self.call("--variants", "baseline", "improved", exit_code=1)
        self.assertRegex(self.report(), r"\*\*mean\*\* of the 1 that .*\| 0\.20\d+ +\| 0\.10\d+")
        self.assertRegex(self.report(), r"against baseline +\| \+0 % +\| -50 %")


class Resuming(DatasetTest):
    def test_finished_runs_are_not_repeated(self):
        self.add("hall")
        arguments = ("--variants", "baseline", "improved")
        self.call(*arguments)
        before = self.report().split("##", 1)[1]  # without the time of creation
        result = self.call(*arguments)
        self.assertEqual(len(self.calls()), 2)
        self.assertIn("2 runs, 2 of them finished before", result.stdout)
        self.assertEqual(before, self.report().split("##", 1)[1])
        self.call(*arguments, "merging")
        self.assertEqual(len(self.calls()), 3)

    def assert_repeated(self, *arguments):
        count = len(self.calls())
        self.call("--variants", "improved", *arguments)
        self.assertEqual(len(self.calls()), count + 1)

    def test_whatever_changes_the_result_repeats_the_run(self):
        self.add("hall")
        self.assert_repeated()
        self.write("config.yaml", "%YAML:1.0\nmax_cnt: 99\n")
        self.assert_repeated()
        self.assert_repeated("--set", "max_cnt=98")
        self.assert_repeated("--duration", "10")
        self.write(os.path.join("bags", "hall.bag"), "fly again")
        self.assert_repeated("--duration", "10")
        with open(self.program, "a", encoding="utf-8") as file:
            file.write("# another version\n")
        self.assert_repeated("--duration", "10")

    def test_imu_data_of_an_asl_folder_count(self):
        for sensor, words in (("cam0", "fly"), ("imu0", "0,0,0,0,0,0,9.81")):
            os.makedirs(self.path("bags", "hall", "mav0", sensor))
            self.write(os.path.join("bags", "hall", "mav0", sensor, "data.csv"), words)
        self.assert_repeated()
        self.call("--variants", "improved")
        self.assertEqual(len(self.calls()), 1)
        self.write(os.path.join("bags", "hall", "mav0", "imu0", "data.csv"), "0,0,0,0,0,0,9.8")
        self.assert_repeated()

    def test_incomplete_results_are_repeated(self):
        self.add("hall")
        self.assert_repeated()
        folder = os.path.join(self.output, "runs", "hall", "improved", "from_0.0s_1")
        for name in ("run.json", "trajectory.tum", "summary.json"):
            os.remove(os.path.join(folder, name))
            self.assert_repeated()
        with open(os.path.join(folder, "run.json"), "w", encoding="utf-8") as file:
            file.write("{")
        self.assert_repeated()

    def test_starts_are_added(self):
        self.add("hall")
        self.assert_repeated()
        self.assert_repeated("--start", "5")
        self.assert_repeated("--starts", "0", "2.5", "5")
        self.assertIn("--start 2.5", self.calls()[-1])
        self.call("--variants", "improved", "--starts", "0", "2.5", "5")
        self.assertEqual(len(self.calls()), 3)
        self.assertEqual([row["start_s"] for row in self.rows()], ["0", "2.5", "5"])

    def interrupt(self, number):
        """Starts all runs, waits for the one that hangs and sends the signal."""
        shutil.rmtree(os.path.join(self.output, "runs", "b_hangs"), ignore_errors=True)
        with subprocess.Popen(self.command("--variants", "improved"), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, encoding="utf-8") as process:
            pid = self.hanging_run()
            process.send_signal(number)
            _, messages = process.communicate(timeout=120)
        with self.assertRaises(ProcessLookupError):
            os.kill(pid, 0)
        self.assertEqual(os.listdir(os.path.join(self.output, "runs", "b_hangs", "improved")), [])
        return process.returncode, messages

    def test_interruption_leaves_no_process_and_is_resumed(self):
        self.add("a_flies")
        self.add("b_hangs", "hang")
        self.add("c_flies")
        for number in (signal.SIGINT, signal.SIGTERM):
            exit_code, messages = self.interrupt(number)
            self.assertEqual(exit_code, 130)
            self.assertIn("interrupted; run the same command again", messages)
            self.assertNotIn("Traceback", messages)
        self.assertEqual(len(self.calls()), 1 + 2)
        self.add("b_hangs", "fly")
        self.call("--variants", "improved")
        self.assertEqual(len(self.calls()), 1 + 2 + 2)
        self.assertEqual([row["status"] for row in self.rows()], ["compared"] * 3)


class Parallel(DatasetTest):
    def test_runs_are_under_way_at_the_same_time(self):
        self.add("hall", "fly meet")
        self.call("--variants", "improved", "--starts", "0", "5", "--jobs", "2")
        self.assertEqual([row["status"] for row in self.rows()], ["compared"] * 2)

    def test_two_calls_do_not_share_an_output(self):
        self.add("b_hangs", "hang")
        with subprocess.Popen(self.command("--variants", "improved"), stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL) as process:
            process.stdout.readline()  # the run has started
            result = self.call("--variants", "improved", exit_code=1)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=120)
        self.assertIn("another run_dataset.py works there", result.stderr)


class BadCalls(DatasetTest):
    def assert_refused(self, message, *arguments, exit_code=1):
        result = self.call(*arguments, exit_code=exit_code)
        self.assertIn(message, result.stderr)
        self.assertEqual(self.calls(), [])

    def test_say_what_to_do(self):
        self.assert_refused("no *.bag and no ASL folder")
        self.write(os.path.join("bags", "MH_01_easy.zip"), "")
        self.assert_refused("MH_01_easy.zip first")
        self.add("hall")
        self.assert_refused("there are hall", "--sequences", "MH_01")
        self.assert_refused("there are points, baseline", "--variants", "best")
        self.assert_refused("missing.yaml: no such file", "--config", "missing.yaml")
        self.assert_refused("missing: no such program", "--run-offline", "missing")
        self.assert_refused("at least 1 instead of 0", "--jobs", "0", exit_code=2)
        self.assert_refused("at least 0, instead of nan", "--start", "nan", exit_code=2)
        self.assert_refused("at least 0, instead of -1", "--starts=-1", exit_code=2)
        self.assert_refused("key=value instead of max_cnt", "--set", "max_cnt", exit_code=2)
        self.assert_refused("--set nonsense: unknown key; remove it\n",
                            "--set", "nonsense=1")
        self.assertFalse(os.path.exists(os.path.join(self.output, "runs")))
        os.symlink(self.path("nowhere"), self.path("bags", "gone.bag"))
        self.assert_refused("gone.bag: No such file", "--sequences", "gone")

    def test_damaged_results(self):
        self.add("hall")
        self.call("--variants", "improved")
        folder = os.path.join(self.output, "runs", "hall", "improved", "from_0.0s_1")
        with open(os.path.join(folder, "summary.json"), "w", encoding="utf-8") as file:
            file.write("{")
        self.call("--variants", "improved", exit_code=1)
        self.assertIn("damaged results", self.rows()[0]["status"])


if __name__ == "__main__":
    unittest.main()
