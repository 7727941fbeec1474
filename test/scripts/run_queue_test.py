#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests run_queue.py with executors that fail."""

import concurrent.futures
import os
import sys
import tempfile
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
sys.path.insert(0, SCRIPTS)
from dataset.errors import DatasetError  # noqa: E402
from dataset.run_queue import carry_out  # noqa: E402


class FakeRun:
    name = "hall improved 1"

    def __init__(self, result):
        self.result = result
        self.failure = None
        self.session_is_there = None

    def carry_out(self, session):
        self.session_is_there = os.path.isfile(session)
        if isinstance(self.result, BaseException):
            raise self.result
        return self.result

    def save_failure(self, reason):
        self.failure = reason


class FakeProgress:
    def __init__(self):
        self.lines = []

    def show(self, running):
        pass

    def ended(self, run, seconds):
        self.lines.append((run.name, seconds))

    def close(self):
        pass


class RunQueue(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.output = folder.name

    def carry_out(self, *results):
        self.runs = [FakeRun(result) for result in results]
        progress = FakeProgress()
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            self.assertTrue(carry_out(self.runs, executor, self.output, progress))
        return progress.lines

    def tearDown(self):
        self.assertEqual(os.listdir(self.output), [], "the session's file stays behind")

    def test_every_run_is_carried_out_within_the_session(self):
        self.assertEqual(sorted(self.carry_out(1.0, 2.0, 3.0)),
                         [(FakeRun.name, seconds) for seconds in (1.0, 2.0, 3.0)])
        self.assertTrue(all(run.session_is_there for run in self.runs))

    def test_a_run_that_nobody_could_carry_out_fails_alone(self):
        self.assertEqual(len(self.carry_out(RuntimeError("worker died"), 2.0)), 2)
        self.assertIn("RuntimeError: worker died", self.runs[0].failure)
        self.assertIsNone(self.runs[1].failure)

    def test_a_folder_that_is_not_shared(self):
        with self.assertRaisesRegex(DatasetError, "does not see this folder"):
            self.carry_out(None)

    def test_workers_without_this_program(self):
        with self.assertRaisesRegex(DatasetError, "PYTHONPATH"):
            self.carry_out(ModuleNotFoundError("No module named 'dataset'", name="dataset"))

    def test_a_lost_scheduler(self):
        with self.assertRaisesRegex(DatasetError, "run the same command again"):
            self.carry_out(concurrent.futures.CancelledError())


if __name__ == "__main__":
    unittest.main()
