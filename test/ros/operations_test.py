#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the nodes in operation: repeated bags, killed or suspended nodes, and termination.

Usage: operations_test.py NODES BAG FOLDER [unittest option ...]
NODES: folder of the nodes' programs; BAG: a recording; FOLDER: for logs and results.
"""

import contextlib
import os
import shutil
import signal
import sys
import time
import unittest

import rosgraph
import rospy
from std_srvs.srv import Trigger

from node_processes import (CONFIG, Listener, Processes, arguments, free_port, start_master,
                            wait_until)

NODES, BAG, FOLDER = arguments(__doc__)
NAMES = ("feature_tracker", "linefeature_tracker", "vins_estimator")
MAX_WAIT = 0.5  # [s]: images that wait longer are dropped
IMAGE_INTERVAL = 0.05  # [s], of the recording
END_LIMIT = 20  # [s] from SIGINT to exit; well below 1 s on an idle machine


def setUpModule():
    start_master(FOLDER, "operations_test")


class OperationsTest(unittest.TestCase):
    def setUp(self):
        self.trajectory = FOLDER / f"{self._testMethodName}.tum"
        self.trajectory.unlink(missing_ok=True)
        self.processes = Processes(FOLDER / self._testMethodName, os.environ["ROS_MASTER_URI"])
        self.addCleanup(self.processes.close)

    def start_node(self, name, **environment):
        return self.processes.start_node(NODES / name, f"_trajectory_file:={self.trajectory}",
                                         **environment)

    def start_all(self):
        self.listener = Listener()
        self.nodes = {name: self.start_node(name) for name in NAMES}
        for name in NAMES:
            self.listener.wait_for_message(name, "")

    def play(self, *options):
        return self.processes.start("player", ["rosbag", "play", "--delay", "1", *options, BAG])

    def assert_end_on(self, number, nodes, exit_code=0):
        for node in nodes.values():
            node.send_signal(number)
        begin = time.monotonic()
        for name, node in nodes.items():
            self.assertEqual(node.wait(END_LIMIT), exit_code, self.processes.log(name))
        self.assertLess(time.monotonic() - begin, END_LIMIT)

    def stamps_in_file(self):
        """Returns the timestamps in the trajectory file; expects that they increase."""
        rows = [line for line in self.trajectory.read_text(encoding="utf-8").splitlines()
                if not line.startswith("#")]
        stamps = [float(row.split()[0]) for row in rows]
        self.assertEqual(stamps, sorted(set(stamps)))
        return stamps


class Parameters(OperationsTest):
    def test_one_of_another_kind_is_refused_by_name(self):
        for name, parameter, value, kind in (("mavros_relay", "rate", "fast", "a number"),
                                             ("feature_tracker", "image_transport", "5", "a text"),
                                             ("vins_estimator", "trajectory_file", "8", "a text"),
                                             ("feature_tracker", "config_file", "8", "a text")):
            node = self.processes.start_node(NODES / name, f"_{parameter}:={value}")
            self.assertEqual(node.wait(END_LIMIT), 1, name)
            self.assertIn(f"parameter /{name}/{parameter} must be {kind}",
                          self.processes.log(name))
            rospy.delete_param(f"/{name}/{parameter}")

    def test_a_nodelet_that_cannot_be_loaded_ends_the_manager(self):
        for options, why in ((["_nodelets/tracker:=plm_vins/Nothing"],
                              "cannot load /tracker (plm_vins/Nothing); see the error above"),
                             (["_nodelets:=7"],
                              "parameter /vins_manager/nodelets must be texts by their names"),
                             (["_nodelets/tracker:=plm_vins/FeatureTracker"],
                              "parameter /tracker/config_file is not set")):
            if rospy.has_param("/vins_manager"):
                rospy.delete_param("/vins_manager")
            manager = self.processes.start_node(NODES / "vins_manager", *options)
            self.assertEqual(manager.wait(END_LIMIT), 1)
            self.assertIn(why, self.processes.log("vins_manager"))

    def assert_refused(self, name, argument, why):
        """Expects that the node exits at once with a message that contains `why`."""
        node = self.processes.start_node(NODES / name, argument)
        self.assertEqual(node.wait(END_LIMIT), 1, name)
        self.assertIn(why, self.processes.log(name))
        with contextlib.suppress(KeyError):
            rospy.delete_param(f"/{name}")

    def test_values_of_the_configuration_come_as_a_shell_gives_them(self):
        self.addCleanup(rospy.delete_param, "/feature_tracker")
        values = {"max_cnt": ("100", "100"), "F_threshold": ("0.5", "0.5"),
                  "equalize": ("false", "0"), "corner_detector": ("harris", "harris")}
        self.processes.start_node(NODES / "feature_tracker", *(
            f"_set/{key}:={value}" for key, (value, _) in values.items()),
            ROSCONSOLE_STDOUT_LINE_BUFFERED="1")
        for key, (_, text) in values.items():
            wait_until(lambda text=f"parameter /feature_tracker/set/{key} overrides the value in"
                       f" {CONFIG}: {text}": text in self.processes.log("feature_tracker"), key)

    def test_values_of_the_configuration_are_refused_by_their_parameter(self):
        self.assert_refused("feature_tracker", "_set/max_cnt:=7",
                            'parameter /feature_tracker/set/max_cnt: "7" out of range')
        rospy.set_param("/vins_estimator/set/max_cnt", [1, 2])
        self.assert_refused("vins_estimator", "_trajectory_file:=",
                            "parameter /vins_estimator/set/max_cnt must be a string, a number or"
                            " a boolean")
        self.assert_refused("vins_estimator", "_set:=3",
                            "parameter /vins_estimator/set must be a namespace of keys")

    def test_frames_of_the_relay_are_checked(self):
        self.assert_refused("mavros_relay", "_base_frame:=/base_link",
                            'parameter /mavros_relay/base_frame: "/base_link" must not begin with a'
                            " slash")
        self.assert_refused("mavros_relay", "_odom_frame:=", "parameter /mavros_relay/odom_frame:")

    def test_a_name_that_ros_refuses_ends_the_node(self):
        self.assert_refused("feature_tracker", "__name:=front/tracker",
                            "feature_tracker: Invalid node name [front/tracker]")
        node = self.processes.start("nameless", [NODES / "feature_tracker"])
        self.assertEqual(node.wait(END_LIMIT), 1)
        self.assertIn("config_file is not set: give the path of a configuration file"
                      " (_config_file:=PATH)", self.processes.log("nameless"))

    def test_a_file_that_cannot_be_written_is_named_before_the_flight(self):
        self.addCleanup(rospy.delete_param, "/vins_estimator/trajectory_file")
        self.processes.start_node(NODES / "vins_estimator", "_trajectory_file:=/dev/null/./a.tum")
        wait_until(lambda: "cannot write /dev/null/a.tum" in
                   self.processes.log("vins_estimator"), "a warning")


class Turns(OperationsTest):
    def test_of_two_publishers_are_named(self):
        """A bag with recorded feature topics is played while the trackers run."""
        self.start_node("vins_estimator", ROSCONSOLE_STDOUT_LINE_BUFFERED="1")
        for topic in ("/feature_tracker/feature", "/linefeature_tracker/linefeature"):
            for player in range(2):
                self.processes.start(f"player{player}", [
                    "rostopic", "pub", "-s", "-r", "10", topic, "sensor_msgs/PointCloud",
                    "{header: {stamp: now}, channels: [{}, {}, {}]}"])  # an image without features
            wait_until(lambda topic=topic: f"several publishers alternate on {topic}" in
                       self.processes.log("vins_estimator"), topic)


class CalibrationInUse(OperationsTest):
    def test_stays_as_it_is_and_the_trajectory_is_saved(self):
        folder = self.processes.folder
        config, trajectory = folder / "calibrated.yaml", folder / "trajectory.tum"
        shutil.copy(CONFIG, config)
        trajectory.unlink(missing_ok=True)
        self.addCleanup(rospy.delete_param, "/vins_estimator")
        listener = Listener()
        self.start_node("feature_tracker")
        estimator = self.processes.start("vins_estimator", [
            NODES / "vins_estimator", f"_config_file:={config}", "_set/use_lines:=0",
            f"_trajectory_file:={trajectory}"])
        wait_until(lambda: f"{config} is the configuration in use" in
                   self.processes.log("vins_estimator"), "a warning")
        listener.wait_for_message("feature_tracker", "")
        self.play()
        listener.wait_for_odometry()
        response = rospy.ServiceProxy("/vins_estimator/save_trajectory", Trigger)()
        self.assertFalse(response.success)
        self.assertRegex(response.message, f"poses saved to {trajectory}, but not the calibration: "
                         f"{config} is the configuration in use")
        trajectory.unlink()
        self.assert_end_on(signal.SIGINT, {"vins_estimator": estimator}, exit_code=1)
        self.assertIn("but not the calibration", self.processes.log("vins_estimator"))
        self.assertTrue(trajectory.exists())
        self.assertEqual(config.read_bytes(), CONFIG.read_bytes())


class Restart(OperationsTest):
    def check(self, end, *player_options):
        self.start_all()
        stamps = self.listener.odometry
        for _ in range(2):
            before = len(stamps)
            player = self.play("--duration", "6", *player_options)
            wait_until(lambda: player.poll() == 0, "end of the recording")
            wait_until(lambda: len(stamps) > before, lambda: "poses of " + self.trajectory.name)
        self.listener.wait_for_value("vins_estimator", "resets", lambda resets: resets == "1")
        for tracker in NAMES[:2]:
            self.listener.wait_for_value(tracker, "image_restarts", lambda count: count == "1")
        restart = self.listener.value("vins_estimator", "last_restart")
        self.assertIn(restart, ("requested on /feature_tracker/restart", "timestamps jumped back"))
        log = self.processes.log("vins_estimator")
        self.assertEqual(log.count("new world frame"), 1, log)

        self.listener.wait_for_message("vins_estimator", "waiting: no messages on")
        self.listener.wait_for_value("vins_estimator", "queued", lambda queued: queued == "0")
        response = rospy.ServiceProxy("/vins_estimator/save_trajectory", Trigger)()
        self.assertTrue(response.success, response.message)
        jump, = [i for i in range(1, len(stamps)) if stamps[i] < stamps[i - 1]]
        wait_until(lambda: stamps[jump:] == self.stamps_in_file(),
                   lambda: f"in the file what was published: {stamps[jump:]}")
        self.trajectory.unlink()
        self.assert_end_on(end, self.nodes)
        self.assertEqual(stamps[jump:], self.stamps_in_file()[:len(stamps) - jump])

    def test_in_time_of_the_machine(self):
        self.check(signal.SIGINT)

    def test_in_time_of_the_bag(self):
        rospy.set_param("/use_sim_time", True)
        self.addCleanup(rospy.delete_param, "/use_sim_time")
        self.check(signal.SIGTERM, "--clock")


class Clock(OperationsTest):
    def test_that_an_earlier_bag_leaves_standing_is_named(self):
        rospy.set_param("/use_sim_time", True)
        self.addCleanup(rospy.delete_param, "/use_sim_time")
        self.start_node("vins_estimator")
        wait_until(lambda: "no time is published on /clock" in self.processes.log("vins_estimator"),
                   "a warning")


class WithoutLines(OperationsTest):
    def test_the_line_tracker_is_idle(self):
        rospy.set_param("/linefeature_tracker/set", {"use_lines": "0"})
        self.addCleanup(rospy.delete_param, "/linefeature_tracker/set")
        name = "linefeature_tracker"
        node = self.start_node(name, ROSCONSOLE_STDOUT_LINE_BUFFERED="1")
        wait_until(lambda: "use_lines is 0" in self.processes.log(name), "what it says")
        time.sleep(1)  # time to subscribe to other topics
        publishers, subscribers, _ = rosgraph.Master("/operations_test").getSystemState()
        of_node = [topic for topic, nodes in publishers + subscribers if f"/{name}" in nodes]
        self.assertEqual(of_node, ["/rosout"])
        self.assertEqual(self.processes.log(name).count("not needed"), 1)
        self.assert_end_on(signal.SIGTERM, {name: node})


class Death(OperationsTest):
    def kill(self, name):
        self.nodes[name].kill()
        self.nodes[name].wait()

    def revive(self, name):
        self.nodes[name] = self.start_node(name)

    def test_of_any_node_leaves_the_others_and_is_survived(self):
        self.start_all()
        listener = self.listener
        self.play("--loop")
        listener.wait_for_odometry()

        self.kill("linefeature_tracker")
        listener.wait_for_message("vins_estimator", "points only")
        listener.wait_for_odometry()
        self.revive("linefeature_tracker")
        listener.wait_for_value("vins_estimator", "message",
                                lambda message: "points only" not in message)

        self.kill("feature_tracker")
        listener.wait_for_message("vins_estimator",
                                  "waiting: no messages on /feature_tracker/feature")
        self.revive("feature_tracker")
        listener.wait_for_odometry()

        self.kill("vins_estimator")
        tracked = len(listener.features)
        wait_until(lambda: len(listener.features) > tracked + 20, "features without estimator")
        self.revive("vins_estimator")
        listener.wait_for_odometry()
        listener.wait_for_message("vins_estimator", "tracking")
        self.assert_end_on(signal.SIGINT, self.nodes)


class Overload(OperationsTest):
    def test_leaves_out_what_is_too_late(self):
        """The estimator is suspended for a second of the recording. The bag is played at half
        speed, so that only the estimator's policy determines which images it processes
        afterwards."""
        self.start_all()
        listener = self.listener
        self.play("--rate", "0.5")
        listener.wait_for_odometry(30)
        estimator = self.nodes["vins_estimator"]
        estimator.send_signal(signal.SIGSTOP)
        try:
            behind = len(listener.features) + 20  # a second of the recording
            wait_until(lambda: len(listener.features) > behind, "features without estimator")
        finally:
            estimator.send_signal(signal.SIGCONT)
        newest = listener.features[-1]
        third_after = listener.wait_for_odometry(3)[2]  # earlier images may come first
        self.assertGreater(third_after, newest - MAX_WAIT - 2 * IMAGE_INTERVAL)
        listener.wait_for_value("vins_estimator", "frames_too_late", lambda count: int(count) > 0)
        self.assertEqual(listener.value("vins_estimator", "resets"), "0")


class Stall(OperationsTest):
    def test_of_the_player_loses_no_image_and_no_line(self):
        """The player is suspended, and then sends what is due at once. It plays at half speed, so
        that a busy machine keeps up."""
        self.start_all()
        listener = self.listener
        player = self.play("--rate", "0.5")
        listener.wait_for_odometry(30)
        without_lines = listener.value("vins_estimator", "frames_without_lines")
        for _ in range(5):
            os.killpg(player.pid, signal.SIGSTOP)  # rosbag starts another process
            time.sleep(0.45)  # below 0.5 s, after which images are tracked without the gyro
            os.killpg(player.pid, signal.SIGCONT)
            time.sleep(1)
        for tracker in ("feature_tracker", "linefeature_tracker"):
            listener.wait_for_value(tracker, "images_longest_stall_ms",
                                    lambda stall: stall and float(stall) > 150)
            self.assertEqual(listener.value(tracker, "images_too_late"), "0")
        self.assertEqual(player.wait(), 0)
        listener.wait_for_message("linefeature_tracker", "waiting")
        images = [listener.value(tracker, "images")
                  for tracker in ("feature_tracker", "linefeature_tracker")]
        self.assertEqual(*images)
        self.assertEqual(listener.value("vins_estimator", "frames_without_lines"), without_lines)


class Interrupt(OperationsTest):
    def check(self, end, started, **environment):
        nodes = {name: self.start_node(name, **environment) for name in NAMES}
        for name in NAMES:
            wait_until(lambda: started(name), f"start of {name}")
        self.assert_end_on(end, nodes)
        self.assertFalse(self.trajectory.exists(), "there was no pose")

    def test_without_a_master(self):
        self.check(signal.SIGTERM,
                   lambda name: "Failed to contact master" in self.processes.log(name),
                   ROS_MASTER_URI=f"http://localhost:{free_port()}")

    def test_before_any_data(self):
        self.listener = Listener()
        self.check(signal.SIGINT, lambda name: self.listener.value(name, "message") != "")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], warnings="ignore")
