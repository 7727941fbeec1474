#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the estimator on another host than camera, IMU, trackers and master, with an interrupted
link.

The hosts are network namespaces, which only root can create; otherwise the test is skipped (exit
code 77).

Usage: several_machines_test.py NODES BAG FOLDER [unittest option ...]
NODES: folder of the nodes' programs; BAG: a recording; FOLDER: for logs.
"""

import contextlib
import ctypes
import os
import subprocess
import sys
import time
import unittest

import rosgraph
import rospy

from node_processes import Listener, Processes, arguments, wait_until

NODES, BAG, FOLDER = arguments(__doc__)
SKIPPED = 77

ROBOT, STATION = f"robot{os.getpid()}", f"station{os.getpid()}"  # the two hosts
ROBOT_IP, STATION_IP = "10.213.7.1", "10.213.7.2"
ON_ROBOT = ("ip", "netns", "exec", ROBOT)
LINK = "to_robot"  # name of the link on the station
OUTAGE = 5  # [s]


def ip(*words):
    subprocess.run(["ip", *words], check=True, stderr=subprocess.PIPE, encoding="utf-8")


def make_hosts():
    for host in (ROBOT, STATION):
        ip("netns", "add", host)
    ip("link", "add", "to_station", "netns", ROBOT, "type", "veth",
       "peer", "name", LINK, "netns", STATION)
    for host, link, address in ((ROBOT, "to_station", ROBOT_IP), (STATION, LINK, STATION_IP)):
        ip("-n", host, "address", "add", f"{address}/24", "dev", link)
        for device in ("lo", link):
            ip("-n", host, "link", "set", device, "up")


def remove_hosts():
    for host in (ROBOT, STATION):
        with contextlib.suppress(OSError, subprocess.CalledProcessError):
            ip("netns", "delete", host)


def move_to(host):
    """Moves this process and its later children to another host."""
    libc = ctypes.CDLL(None, use_errno=True)
    with open(f"/run/netns/{host}", encoding="utf-8") as namespace:
        if libc.setns(namespace.fileno(), 0) != 0:
            raise OSError(ctypes.get_errno(), f"cannot enter the network namespace {host}")


class SeveralMachines(unittest.TestCase):
    def setUp(self):
        os.environ["ROS_MASTER_URI"] = f"http://{ROBOT_IP}:11311"
        os.environ["ROS_IP"] = STATION_IP
        self.processes = Processes(FOLDER, os.environ["ROS_MASTER_URI"])
        self.addCleanup(self.processes.close)
        self.start_on_robot("master", ["rosmaster", "--core"])
        wait_until(rosgraph.is_master_online, "the master")
        rospy.init_node("several_machines_test", disable_signals=True)
        self.listener = Listener()
        for tracker in ("feature_tracker", "linefeature_tracker"):
            self.processes.start_node(NODES / tracker, prefix=ON_ROBOT, ROS_IP=ROBOT_IP)
        self.estimator = self.processes.start_node(NODES / "vins_estimator")
        for node in ("feature_tracker", "linefeature_tracker", "vins_estimator"):
            self.listener.wait_for_message(node, "")

    def start_on_robot(self, name, command):
        return self.processes.start(name, [*ON_ROBOT, *command], ROS_IP=ROBOT_IP)

    def test_a_lost_link_degrades_and_recovers(self):
        listener = self.listener
        self.start_on_robot("player", ["rosbag", "play", "--delay", "1", BAG])
        listener.wait_for_odometry()

        ip("link", "set", LINK, "down")
        down = time.monotonic()
        listener.wait_for_message("vins_estimator", "waiting: no messages on /imu0 and "
                                                    "/feature_tracker/feature")
        before = listener.odometry[-1]
        time.sleep(max(0.0, down + OUTAGE - time.monotonic()))
        self.assertEqual(listener.odometry[-1], before, "a pose out of nothing")

        ip("link", "set", LINK, "up")
        after = listener.wait_for_odometry()
        self.assertGreater(after[-1], before + OUTAGE - 1, "stale data only")
        listener.wait_for_message("vins_estimator", "tracking")
        stamps = listener.odometry
        self.assertEqual(stamps, sorted(set(stamps)), "poses go back in time")
        self.assertIsNone(self.estimator.poll())


def main():
    try:
        make_hosts()
        move_to(STATION)
    except (OSError, subprocess.CalledProcessError) as error:
        why = getattr(error, "stderr", None) or error
        print(f"SKIPPED: no network namespaces on this machine: {why}")
        remove_hosts()
        return SKIPPED
    try:
        program = unittest.main(argv=[sys.argv[0], *sys.argv[4:]], exit=False,
                                warnings="ignore")
        return 0 if program.result.wasSuccessful() else 1
    finally:
        remove_hosts()


if __name__ == "__main__":
    sys.exit(main())
