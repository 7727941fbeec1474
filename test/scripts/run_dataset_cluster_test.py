#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/run_dataset.py on a Dask cluster."""

import importlib.util
import os
import signal
import subprocess
import sys
import time
import unittest

from dataset_case import RUN_DATASET, DatasetTest


@unittest.skipUnless(importlib.util.find_spec("distributed"), "Dask is not installed")
class Cluster(DatasetTest):
    """A Dask scheduler and two workers that simulate three machines with a shared folder."""

    def setUp(self):
        super().setUp()
        self.scheduler_file = self.path("scheduler.json")
        self.start("scheduler", "--port", "0", "--no-dashboard")
        scripts = os.path.dirname(os.path.abspath(RUN_DATASET))
        self.workers = [self.start("worker", "--nthreads", "1", "--no-nanny", "--no-dashboard",
                                   PYTHONPATH=scripts) for _ in range(2)]
        self.address = self.wait_for_workers(2)

    def start(self, kind, *options, **environment):
        """Starts a Dask process, which is terminated with the test."""
        process = subprocess.Popen(
            [sys.executable, "-B", "-m", f"distributed.cli.dask_{kind}", "--scheduler-file",
             self.scheduler_file, *options], cwd=self.folder, env=dict(os.environ, **environment),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for_workers(self, count):
        import distributed
        deadline = time.monotonic() + 60
        while not os.path.isfile(self.scheduler_file):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        with distributed.Client(scheduler_file=self.scheduler_file, timeout=60) as client:
            client.wait_for_workers(count)
            return client.scheduler.address

    def test_runs_are_under_way_at_the_same_time(self):
        self.add("hall", "fly meet")
        result = self.call("--no-plots", "--variants", "improved", "--repetitions", "2",
                           "--jobs", "1", "--scheduler", self.address)
        self.assertIn(f"by 2 workers of {self.address}", result.stdout)
        self.assertEqual([row["status"] for row in self.rows()], ["compared"] * 2)
        result = self.call("--no-plots", "--variants", "improved", "--repetitions", "2",
                           "--scheduler", self.address)
        self.assertIn("2 of them finished before", result.stdout)
        self.assertEqual(len(self.calls()), 2)

    def test_the_run_of_a_lost_worker_is_done_again(self):
        self.add("a_flies")
        self.add("b_hangs", "fly hang_once")
        self.add("c_flies")
        with subprocess.Popen(self.command("--no-plots", "--variants", "improved", "--scheduler",
                                           self.address), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, encoding="utf-8") as process:
            orphan, worker = self.hanging_run()
            self.addCleanup(os.kill, orphan, signal.SIGKILL)
            self.assertIn(worker, [w.pid for w in self.workers])
            os.kill(worker, signal.SIGKILL)
            _, messages = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, messages)
        self.assertEqual([row["status"] for row in self.rows()], ["compared"] * 3)
        self.assertEqual(sum("b_hangs" in call for call in self.calls()), 2)
        self.assertEqual(os.listdir(os.path.join(self.output, "runs", "b_hangs", "improved")),
                         ["1"])

    def test_interruption_leaves_no_process(self):
        self.add("b_hangs", "hang")
        with subprocess.Popen(self.command("--variants", "improved", "--scheduler", self.address),
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              encoding="utf-8") as process:
            pid, _ = self.hanging_run()
            process.send_signal(signal.SIGINT)
            _, messages = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, messages)
        self.assertIn("1 of 1 runs left", messages)
        with self.assertRaises(ProcessLookupError):
            os.kill(pid, 0)


if __name__ == "__main__":
    unittest.main()
