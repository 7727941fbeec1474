# SPDX-License-Identifier: BSD-3-Clause
"""Test fixture that runs scripts/run_dataset.py with fake_run_offline.py instead of run_offline."""

import csv
import glob
import os
import shutil
import sys
import time

import numpy as np

import fake_run_offline
from fake_run_offline import write_tum
from folder_case import FolderTest, call

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPTS = os.path.join(HERE, "..", "..", "scripts")
RUN_DATASET = os.path.join(SCRIPTS, "run_dataset.py")

sys.path.append(SCRIPTS)
import run_dataset  # noqa: E402


def flight(**options):
    """Returns timestamps [s] and positions (n, 3) [m] of all recordings."""
    return tuple(np.array(values) for values in fake_run_offline.flight(**options))


class DatasetTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.output = self.path("output")
        self.program = self.path("run_offline")
        shutil.copy(os.path.join(HERE, "fake_run_offline.py"), self.program)
        self.write("config.yaml", "%YAML:1.0\n")
        os.mkdir(self.path("bags"))

    def add(self, name, words="fly", truth=True):
        """Adds a recording with the behavior given by `words`, and its ground truth."""
        self.write(os.path.join("bags", name + ".bag"), words)
        if truth:
            write_tum(self.path("bags", name + ".tum"), *flight(rate=100.0))

    def command(self, *arguments):
        return [sys.executable, "-B", RUN_DATASET, self.path("bags"), "--output", self.output,
                "--run-offline", self.program, "--config", self.path("config.yaml"), *arguments]

    def call(self, *arguments, exit_code=0):
        words = self.command(*arguments)
        result = call(run_dataset.main, *words[words.index(RUN_DATASET) + 1:])
        self.assertEqual(result.returncode, exit_code, result.stderr)
        return result

    def calls(self):
        """Returns the arguments of all runs so far."""
        try:
            with open(self.path("calls.txt"), encoding="utf-8") as file:
                return file.read().splitlines()
        except FileNotFoundError:
            return []

    def hanging_run(self):
        """Waits until a run hangs; returns its process id."""
        deadline = time.monotonic() + 120
        while time.monotonic() < deadline:
            for path in glob.glob(os.path.join(self.output, "runs", "*", "*", "*", "pid")):
                with open(path, encoding="utf-8") as file:
                    text = file.read()
                if text.endswith("\n"):
                    return int(text)
            time.sleep(0.02)
        self.fail("no run hangs")
        return None

    def report(self):
        with open(os.path.join(self.output, "report.md"), encoding="utf-8") as file:
            return file.read()

    def rows(self):
        with open(os.path.join(self.output, "runs.csv"), encoding="utf-8") as file:
            return list(csv.DictReader(file))
