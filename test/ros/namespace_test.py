#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that nodes in a namespace use only topics within it.

Usage: namespace_test.py NODES BAG FOLDER [unittest option ...]
NODES: folder of the nodes' programs; BAG: a recording; FOLDER: for logs.
"""

import os
import sys
import unittest

import rosgraph
import rospy
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from node_processes import Listener, Processes, arguments, start_master, wait_until

NODES, BAG, FOLDER = arguments(__doc__)
NAMES = ("feature_tracker", "linefeature_tracker", "vins_estimator", "mavros_relay")
SHARED = ("/rosout", "/rosout_agg", "/diagnostics", "/tf", "/tf_static", "/clock")
# Values that a robot's own configuration would contain.
SETTINGS = ("_set/image_topic:=cam0/image_raw", "_set/imu_topic:=imu0",
            "_set/manhattan_frame:=robot1_manhattan")


def setUpModule():
    start_master(FOLDER, "namespace_test")


class Namespace(unittest.TestCase):
    def setUp(self):
        self.processes = Processes(FOLDER, os.environ["ROS_MASTER_URI"])
        self.addCleanup(self.processes.close)

    def test_has_all_of_a_robot(self):
        listener = Listener("/robot1")
        relayed, frames = [], set()
        rospy.Subscriber("/robot1/mavros/odometry/out", Odometry, relayed.append)
        rospy.Subscriber("/tf", TFMessage, lambda message: frames.update(
            transform.child_frame_id for transform in message.transforms))
        for name in NAMES:
            self.processes.start_node(NODES / name, *SETTINGS, ROS_NAMESPACE="robot1")
        self.processes.start("base", ["rosrun", "tf2_ros", "static_transform_publisher",
                                      *"0 0 0 0 0 0 body base_link".split()])
        for name in NAMES[:3]:
            listener.wait_for_message(name, "waiting")
        self.processes.start("player", ["rosbag", "play", "--delay", "1",
                                        "--prefix", "/robot1", BAG])
        listener.wait_for_message("vins_estimator", "tracking")
        listener.wait_for_value("vins_estimator", "lines_in_window",
                                lambda lines: int(lines or 0) > 0)
        listener.wait_for_odometry()
        wait_until(lambda: relayed, "odometry for mavros")
        wait_until(lambda: "robot1_manhattan" in frames, lambda: f"tf of {frames}")
        self.assertNotIn("manhattan", frames)
        self.assertEqual(self.topics_outside(), [])

    def test_names_in_full_the_topics_that_are_silent(self):
        listener = Listener("/robot1")
        for name in NAMES[:3]:
            self.processes.start_node(NODES / name, *SETTINGS, "cam0/image_raw:=front/image",
                                      "imu0:=front/imu", ROS_NAMESPACE="robot1")
        for name, topic in (("feature_tracker", "/robot1/front/image"),
                            ("linefeature_tracker", "/robot1/front/image"),
                            ("vins_estimator", "/robot1/front/imu and ")):
            listener.wait_for_message(name, f"waiting: no messages on {topic}")

    def test_remaps_compressed_images(self):
        listener = Listener("/robot2")
        self.processes.start_node(NODES / "feature_tracker", *SETTINGS,
                                  "_image_transport:=compressed", "cam0/image_raw:=front/image",
                                  ROS_NAMESPACE="robot2")
        listener.wait_for_message("feature_tracker",
                                  "waiting: no messages on /robot2/front/image/compressed")

    def test_remaps_images_once(self):
        """The image topics of two cameras are swapped by remapping."""
        listener = Listener("/robot3")
        self.processes.start_node(NODES / "feature_tracker", *SETTINGS,
                                  "cam0/image_raw:=cam1/image_raw",
                                  "cam1/image_raw:=cam0/image_raw", ROS_NAMESPACE="robot3")
        listener.wait_for_message("feature_tracker",
                                  "waiting: no messages on /robot3/cam1/image_raw")

    def topics_outside(self):
        topics = {name for kind in rosgraph.Master("/namespace_test").getSystemState()[:2]
                  for name, _ in kind}
        return sorted(name for name in topics
                      if not name.startswith("/robot1/") and name not in SHARED)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], warnings="ignore")
