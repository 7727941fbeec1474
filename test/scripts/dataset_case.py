# SPDX-License-Identifier: BSD-3-Clause
"""Test fixture that runs scripts/run_dataset.py with fake_run_offline.py instead of run_offline."""

import csv
import glob
import os
import shutil
import subprocess
import sys
import time

from fake_run_offline import flight, write_tum
from folder_case import FolderTest

HERE = os.path.dirname(os.path.abspath(__file__))
RUN_DATASET = os.path.join(HERE, "..", "..", "scripts", "run_dataset.py")


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
        result = subprocess.run(self.command(*arguments), stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, encoding="utf-8", check=False)
        self.assertEqual(result.returncode, exit_code, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        return result

    def calls(self):
        """Returns the arguments of all runs so far."""
        try:
            with open(self.path("calls.txt"), encoding="utf-8") as file:
                return file.read().splitlines()
        except FileNotFoundError:
            return []

    def hanging_run(self):
        """Waits until a run hangs; returns its process id and that of its parent."""
        deadline = time.monotonic() + 120
        while time.monotonic() < deadline:
            for path in glob.glob(os.path.join(self.output, "runs", "*", "*", "*", "pid")):
                with open(path, encoding="utf-8") as file:
                    text = file.read()
                if text.endswith("\n"):
                    return [int(word) for word in text.split()]
            time.sleep(0.02)
        self.fail("no run hangs")
        return None

    def report(self):
        with open(os.path.join(self.output, "report.md"), encoding="utf-8") as file:
            return file.read()

    def rows(self, name="runs.csv"):
        with open(os.path.join(self.output, name), encoding="utf-8") as file:
            return list(csv.DictReader(file))
