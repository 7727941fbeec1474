#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the nodes with a second camera, and with depth images.

Usage: pair_test.py NODES BAG FOLDER [unittest option ...]
NODES: folder of the nodes' programs and of simulate; BAG: not used; FOLDER: for logs and results.
"""

import os
import sys
import unittest

import rospy
from sensor_msgs.msg import PointCloud

from node_processes import ROOT, Listener, Processes, arguments, start_master

sys.path.append(str(ROOT / "test" / "testing"))

import pair_flight  # noqa: E402

NODES, _, FOLDER = arguments(__doc__)
NAMES = ("feature_tracker", "linefeature_tracker", "vins_estimator")
SECONDS = 6


def setUpModule():
    start_master(FOLDER, "pair_test")


class PairTest(unittest.TestCase):
    def setUp(self):
        self.processes = Processes(FOLDER / self._testMethodName, os.environ["ROS_MASTER_URI"])
        self.addCleanup(self.processes.close)
        self.listener = Listener()
        self.channels = {}  # sums of absolute values, by name
        subscriber = rospy.Subscriber("/feature_tracker/feature", PointCloud, self.add)
        self.addCleanup(subscriber.unregister)

    def add(self, cloud):
        for channel in cloud.channels:
            total = sum(abs(value) for value in channel.values)
            self.channels[channel.name] = self.channels.get(channel.name, 0) + total

    def play(self, sensor):
        config = pair_flight.write_config(FOLDER, sensor)
        for suffix in (".bag", ".tum", ".csv"):
            (FOLDER / f"{sensor}{suffix}").unlink(missing_ok=True)
        bag = FOLDER / f"{sensor}.bag"
        pair_flight.simulate(NODES / "simulate", config, sensor, SECONDS, "--output", bag)
        for name in NAMES:
            self.processes.start(name, [NODES / name, f"_config_file:={config}"])
            self.listener.wait_for_message(name, "")
        self.processes.start("player", ["rosbag", "play", "--delay", "1", bag])

    def assert_used(self, key, *channels):
        self.listener.wait_for_value("vins_estimator", key,
                                     lambda text: text and int(text) > 100)
        self.listener.wait_for_odometry(20)
        for channel in channels:
            self.assertGreater(self.channels.get(channel, 0), 0, channel)
        self.assertEqual(self.listener.value("vins_estimator", "resets"), "0")

    def test_a_second_camera_reaches_the_estimator(self):
        self.play("stereo")
        self.assert_used("matched_used", "camera_id")

    def test_depth_reaches_the_estimator(self):
        self.play("depth")
        self.assert_used("depths_used", "depth")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
