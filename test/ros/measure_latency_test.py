#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests measure_latency.py on the nodes, with a bag played at three times its speed.

Usage: measure_latency_test.py NODES BAG FOLDER [unittest option ...]
NODES: folder of the nodes' programs; BAG: a recording; FOLDER: for logs.
"""

import os
import re
import subprocess
import sys
import unittest

from node_processes import CONFIG, ROOT, arguments, free_port

_, BAG, FOLDER = arguments(__doc__)
SCRIPT = ROOT / "test" / "tools" / "measure_latency.py"
BOUND_MS = 1000  # on a busy machine; queues are short, and late images are dropped
LEAST_SHARE = 0.3  # of the images with a pose: initialization and overload lose the rest


def measure(*options):
    environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{free_port()}",
                   "ROS_HOME": str(FOLDER)}
    return subprocess.run(["/usr/bin/python3", "-B", SCRIPT, "--config", CONFIG, *options],
                          env=environment, capture_output=True, text=True, check=False,
                          timeout=120)


class MeasureLatencyTest(unittest.TestCase):
    def test_bag_that_is_not_there(self):
        run = measure("/nowhere.bag")
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, "^measure_latency.py: .*No such file.* '/nowhere.bag'\n$")

    def test_latency_stays_bounded_where_images_come_fast(self):
        run = measure(BAG, "--rate", "3", "--loop-closure")
        self.assertEqual(run.returncode, 0, run.stderr)
        poses, images = map(int, re.match(r"(\d+) poses of (\d+) images\n", run.stdout).groups())
        self.assertGreater(poses, LEAST_SHARE * images)
        self.assertLess(float(re.search(r"p99 ([\d.]+)", run.stdout)[1]), BOUND_MS)
        for node in ("feature_tracker", "linefeature_tracker", "vins_estimator", "pose_graph",
                     "all"):
            self.assertRegex(run.stdout, rf"\n{node} +[\d.]+ s of CPU, +[\d.]+ ms per image")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
