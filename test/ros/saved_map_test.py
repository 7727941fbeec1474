#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that new nodes relocalize in a map saved by previous ones.

Usage: saved_map_test.py NODES BAG FOLDER [unittest option ...]
NODES: folder of the nodes' programs; BAG: a recording that revisits a place; FOLDER: for logs and
results.
"""

import math
import os
import sys
import unittest

import rospy
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

from node_processes import (PATIENCE, Listener, Processes, arguments, start_master,
                            wait_until)

NODES, BAG, FOLDER = arguments(__doc__)
NAMES = ("feature_tracker", "linefeature_tracker", "vins_estimator", "pose_graph")
MAP = FOLDER / "map.plm"
SETTINGS = "/pose_graph/set"


def setUpModule():
    start_master(FOLDER, "saved_map_test")


class SaveAndRelocalise(unittest.TestCase):
    def setUp(self):
        MAP.unlink(missing_ok=True)
        self.in_map = {}  # position by timestamp [m]
        self.frames = set()  # asserted in the test, since rospy catches exceptions of callbacks
        rospy.Subscriber("/pose_graph/odometry", Odometry, self.add)

    def add(self, message):
        self.frames.add(message.header.frame_id)
        p = message.pose.pose.position
        self.in_map[message.header.stamp.to_nsec()] = (p.x, p.y, p.z)

    def fly(self, name):
        """Starts all nodes and plays the bag; leaves the nodes running."""
        self.in_map.clear()
        self.processes = Processes(FOLDER / name, os.environ["ROS_MASTER_URI"])
        self.addCleanup(self.processes.close)
        listener = Listener()
        for node in NAMES:
            self.processes.start_node(NODES / node, f"_map_file:={MAP}")
        for node in NAMES:
            listener.wait_for_message(node, "")
        player = self.processes.start("player", ["rosbag", "play", "--delay", "1", BAG])
        wait_until(lambda: player.poll() == 0, "end of the recording")
        wait_until(lambda: self.in_map, lambda: "a pose in the map: " +
                   listener.value("pose_graph", "message"))
        return listener

    def call(self, service):
        return rospy.ServiceProxy(f"/pose_graph/{service}", Trigger)()

    def test_close_a_loop_save_restart_and_relocalise(self):
        rospy.set_param(SETTINGS, {"loop_closure": "1"})
        listener = self.fly("first")
        listener.wait_for_value("pose_graph", "loops", lambda count: int(count or 0) > 0)
        self.assertFalse(self.call("load_map").success)  # no map has been saved yet
        saved = self.call("save_map")
        self.assertTrue(saved.success, saved.message)
        first = dict(self.in_map)
        self.processes.close()

        rospy.set_param(SETTINGS, {"loop_closure": "1", "load_previous_pose_graph": "1"})
        listener = self.fly("second")
        listener.wait_for_message("pose_graph", "located in the map")
        # Both flights replay one recording, so equal stamps mean equal positions.
        stamp = wait_until(lambda: max(first.keys() & self.in_map.keys(), default=0),
                           "an image with a pose in both flights")
        self.assertLess(math.dist(first[stamp], self.in_map[stamp]), 0.2)
        self.assertEqual(self.frames, {"map"})
        self.assertTrue(self.call("reset").success)
        listener.wait_for_value("pose_graph", "keyframes", lambda count: count == "0")

    def test_ends_where_it_is_switched_off(self):
        rospy.set_param(SETTINGS, {"loop_closure": "0"})
        processes = Processes(FOLDER / "off", os.environ["ROS_MASTER_URI"])
        self.addCleanup(processes.close)
        self.assertEqual(processes.start_node(NODES / "pose_graph").wait(PATIENCE), 0)
        self.assertIn("loop_closure is 0", processes.log("pose_graph"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "--verbose", *sys.argv[4:]])
