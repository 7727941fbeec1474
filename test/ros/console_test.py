#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the nodes say on the console of input that does not come, or that is wrong as a whole.

Usage: console_test.py NODES BAG FOLDER [unittest option ...]
NODES: folder of the nodes' programs; BAG: not used; FOLDER: for logs.
"""

import os
import signal
import sys
import unittest

import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import ChannelFloat32, CompressedImage, Image, Imu, PointCloud
from tf2_msgs.msg import TFMessage

from node_processes import Processes, arguments, start_master, wait_until

NODES, _, FOLDER = arguments(__doc__)
SOON = 10 + 10  # [s]: ten, and what a busy machine takes to start a node
START = 1e9  # [s], the first stamp


def setUpModule():
    start_master(FOLDER, "console_test")


class ConsoleTest(unittest.TestCase):
    def setUp(self):
        self.processes = Processes(FOLDER / self._testMethodName, os.environ["ROS_MASTER_URI"])
        self.addCleanup(self.processes.close)

    def advertise(self, topic, kind):
        publisher = rospy.Publisher(topic, kind, queue_size=100)
        self.addCleanup(publisher.unregister)
        return publisher

    def wait_for(self, name, text):
        wait_until(lambda: text in self.processes.log(name),
                   lambda: f"'{text}' in\n{self.processes.log(name)}", SOON)

    def end(self, node):
        node.send_signal(signal.SIGINT)
        self.assertEqual(node.wait(20), 0)


class Silence(ConsoleTest):
    def test_compressed_images_alone(self):
        self.advertise("/cam0/image_raw/compressed", CompressedImage)
        self.processes.start_node(NODES / "feature_tracker")
        self.wait_for("feature_tracker", "no messages on /cam0/image_raw; but "
                      "/cam0/image_raw/compressed is published: start with "
                      "image_transport:=compressed")

    def test_raw_images_alone(self):
        self.advertise("/cam0/image_raw", Image)
        self.processes.start_node(NODES / "linefeature_tracker", "_image_transport:=compressed")
        self.wait_for("linefeature_tracker", "but /cam0/image_raw is published: start without")

    def test_own_pictures_are_no_images_to_choose_from(self):
        self.advertise("/camera/image_raw", Image)
        self.processes.start_node(NODES / "feature_tracker")
        self.wait_for("feature_tracker", "no messages on /cam0/image_raw; published topics of type "
                      "sensor_msgs/Image: /camera/image_raw")
        self.assertNotIn("/feature_img", self.processes.log("feature_tracker"))

    def test_images_that_begin_late_on_another_topic(self):
        self.processes.start_node(NODES / "feature_tracker")
        self.wait_for("feature_tracker", "no topic of type sensor_msgs/Image is published")
        self.advertise("/cam0/image_raw/compressed", CompressedImage)
        self.wait_for("feature_tracker", "/cam0/image_raw/compressed is published: start with")

    def test_imu_samples_on_another_topic(self):
        self.advertise("/imu/data_raw", Imu)
        self.processes.start_node(NODES / "vins_estimator")
        self.wait_for("vins_estimator", "no messages on /imu0; published topics of type "
                      "sensor_msgs/Imu: /imu/data_raw")

    def test_messages_of_another_type(self):
        self.advertise("/cam0/image_raw", Imu)
        self.processes.start_node(NODES / "feature_tracker")
        self.wait_for("feature_tracker", "another type, sensor_msgs/Imu instead of")


class Stamps(ConsoleTest):
    def send(self, images, imu, done):
        """Features and IMU samples for seconds; `images` and `imu` make a stamp of a time."""
        points = self.advertise("/feature_tracker/feature", PointCloud)
        samples = self.advertise("/imu0", Imu)
        wait_until(lambda: points.get_num_connections() and samples.get_num_connections(),
                   "the estimator")
        for i in range(2000):
            sample = Imu()
            sample.header.stamp = rospy.Time.from_sec(imu(START + 0.005 * i))
            sample.linear_acceleration.z = 9.81
            sample.angular_velocity.x = 0.001
            samples.publish(sample)
            if i % 10 == 0:
                channels = [ChannelFloat32(name=name) for name in ("id", "u", "v")]
                frame = PointCloud(channels=channels)
                frame.header.stamp = rospy.Time.from_sec(images(START + 0.005 * i))
                points.publish(frame)
                rospy.rostime.wallsleep(0.02)
            if done():
                break

    def assert_says_once(self, text, images, imu):
        node = self.processes.start_node(NODES / "vins_estimator")
        self.send(images, imu, lambda: text in self.processes.log("vins_estimator"))
        self.wait_for("vins_estimator", text)
        self.end(node)
        self.assertEqual(self.processes.log("vins_estimator").count(text), 1)

    def test_two_clocks(self):
        self.assert_says_once("apart by 37.0 s; stamp both by one clock",
                              lambda time: time + 37, lambda time: time)

    def test_stamps_that_are_zero(self):
        self.assert_says_once("all stamps of imu_topic /imu0 are zero",
                              lambda time: time, lambda time: 0)


class Environment(ConsoleTest):
    def test_another_publisher_of_the_same_frame(self):
        publisher = self.advertise("/tf", TFMessage)
        self.processes.start_node(NODES / "vins_estimator")
        wait_until(publisher.get_num_connections, "the estimator")
        transform = TransformStamped(child_frame_id="body")
        transform.transform.rotation.w = 1
        publisher.publish(TFMessage([transform]))
        self.wait_for("vins_estimator", "/console_test also publishes the tf frame body")

    def test_a_home_that_cannot_be_written(self):
        node = self.processes.start_node(NODES / "vins_estimator", ROS_HOME="/dev/null")
        self.wait_for("vins_estimator", "cannot write logs to /dev/null/log, using ")
        rospy.wait_for_service("/vins_estimator/reset", 30)
        self.end(node)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], warnings="ignore")
