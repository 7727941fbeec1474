#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that scripts/demo.sh rejects invalid options before it starts; tests show_result.py's
table."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
SUMMARY = {"poses": 190, "images": 200, "init_time_s": 1.25, "path_length_m": 12.3456,
           "real_time_factor": 6.54, "points": 3210, "lines": 0, "resets": 0}


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          encoding="utf-8", check=False)


class DemoOptions(unittest.TestCase):
    def assert_refused(self, message, *options):
        result = run(os.path.join(SCRIPTS, "demo.sh"), *options)
        self.assertEqual(result.returncode, 1)
        self.assertIn(message, result.stderr)
        self.assertEqual(result.stdout, "")

    def test_bad_options(self):
        self.assert_refused("unknown option --bags", "--bags", "x.bag")
        self.assert_refused("--bag needs a value", "--bag")
        self.assert_refused("either --bag or --asl", "--bag", "x.bag", "--asl", "x")
        self.assert_refused("missing.bag: no such bag", "--bag", "missing.bag")
        self.assert_refused("missing: no such folder", "--asl", "missing")
        self.assert_refused("missing.yaml: no such config", "--config", "missing.yaml", "--asl",
                            SCRIPTS)
        self.assert_refused("--config needs --bag or --asl: the simulated recording is of"
                            " config/euroc.yaml", "--config", __file__)
        self.assert_refused("no such ground truth", "--groundtruth", "missing.tum")
        self.assert_refused("not ASL folders", "--asl", SCRIPTS, "--rviz")
        self.assert_refused("--rviz makes no comparison", "--groundtruth", __file__, "--rviz")

    def test_help(self):
        for script in ("demo.sh", "setup.sh", "build.sh", "test.sh", "fuzz.sh"):
            result = run(os.path.join(SCRIPTS, script), "--help")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn(f"Usage: {script}", result.stdout)


class ShowResult(unittest.TestCase):
    def show(self, **files):
        with tempfile.TemporaryDirectory() as folder:
            for name, content in files.items():
                path = os.path.join(folder, name + ".json")
                with open(path, "w", encoding="utf-8") as file:
                    file.write(content if isinstance(content, str) else json.dumps(content))
            return run(sys.executable, os.path.join(SCRIPTS, "show_result.py"), folder)

    def test_with_ground_truth(self):
        table = self.show(summary=SUMMARY,
                          evaluation={"ape_m": {"rmse": 0.01234}, "coverage": 0.9512}).stdout
        for text in ("190 of 200 images", "1.25 s after", "0.0123 m", "95.1 %", "12.35 m",
                     "6.5 x real time", "3210", "summary.json"):
            self.assertIn(text, table)

    def test_without_ground_truth_and_without_pose(self):
        table = self.show(summary=dict(SUMMARY, poses=0, init_time_s=None)).stdout
        self.assertRegex(table, r"first pose +-\n")
        self.assertNotIn("APE", table)

    def test_without_results(self):
        result = self.show()
        self.assertEqual(result.returncode, 1)
        self.assertIn("no summary.json", result.stderr)

    def test_damaged_files_are_named(self):
        for files in ({"summary": '{"poses": 19'}, {"summary": "[1, 2]"},
                      {"summary": SUMMARY, "evaluation": ""},
                      {"summary": SUMMARY, "evaluation": {"ape_m": None}},
                      {"summary": dict(SUMMARY, lines={}, path_length_m=[])}):
            result = self.show(**files)
            self.assertEqual((result.returncode, result.stdout), (1, ""), files)
            self.assertRegex(result.stderr, "^show_result.py: .*damaged.*\n$")


if __name__ == "__main__":
    unittest.main()
