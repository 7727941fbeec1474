# SPDX-License-Identifier: BSD-3-Clause
"""Starts a ROS master and nodes as processes of a test, and collects their messages."""

import contextlib
import os
import pathlib
import signal
import socket
import subprocess
import sys
import time
import unittest

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from sensor_msgs.msg import PointCloud

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONFIG = ROOT / "config" / "euroc.yaml"
PATIENCE = 60  # [s], generous for a busy machine


def arguments(usage):
    """Returns the arguments NODES, BAG and FOLDER; prints the usage and exits if one is missing."""
    if len(sys.argv) < 4:
        sys.exit(usage)
    return pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])


def wait_until(condition, what, seconds=PATIENCE):
    """Returns the value of `condition` as soon as it is true; AssertionError on timeout."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        result = condition()
        if result:
            return result
        time.sleep(0.05)
    raise AssertionError(f"not within {seconds} s: {what() if callable(what) else what}")


def free_port():
    with contextlib.closing(socket.socket()) as listener:
        listener.bind(("", 0))
        return listener.getsockname()[1]


class Processes:
    """Starts programs with output to FOLDER/NAME.log; close() terminates those still running."""

    def __init__(self, folder, master_uri):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        for log in self.folder.glob("*.log"):
            log.unlink()
        self.environment = {**os.environ, "ROS_MASTER_URI": master_uri,
                            "ROS_HOME": str(self.folder / "ros_home")}
        self._running = []

    def start(self, name, command, **environment):
        with open(self.folder / f"{name}.log", "a", encoding="utf-8") as log:
            process = subprocess.Popen([str(word) for word in command], stdout=log,
                                       stderr=subprocess.STDOUT, start_new_session=True,
                                       env={**self.environment, **environment})
        self._running.append(process)
        return process

    def start_node(self, program, *arguments, prefix=(), **environment):
        """Starts one of the package's nodes by the path of its program."""
        return self.start(pathlib.Path(program).name,
                          [*prefix, program, f"_config_file:={CONFIG}", *arguments], **environment)

    def log(self, name):
        return (self.folder / f"{name}.log").read_text(encoding="utf-8")

    def close(self):
        for process in self._running:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def start_master(folder, name):
    """Runs a master until the end of the test module, with this process as its node NAME."""
    port = free_port()
    os.environ["ROS_MASTER_URI"] = f"http://localhost:{port}"
    master = Processes(pathlib.Path(folder) / "master", os.environ["ROS_MASTER_URI"])
    unittest.addModuleCleanup(master.close)
    master.start("master", ["rosmaster", "--core", "-p", str(port)])
    wait_until(rosgraph.is_master_online, "the master")
    rospy.init_node(name, disable_signals=True)


class Listener:
    """Collects timestamps [s] of odometry and features, and the last status of each node, within a
    namespace."""

    def __init__(self, namespace=""):
        self._prefix = f"{namespace[1:]}/" if namespace else ""
        self.odometry = []
        self.features = []
        self._statuses = {}
        rospy.Subscriber(f"{namespace}/vins_estimator/odometry", Odometry,
                         lambda message: self.odometry.append(message.header.stamp.to_sec()))
        rospy.Subscriber(f"{namespace}/feature_tracker/feature", PointCloud,
                         lambda message: self.features.append(message.header.stamp.to_sec()))
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._add)

    def _add(self, array):
        for status in array.status:
            values = {value.key: value.value for value in status.values}
            self._statuses[status.name.split(":")[0]] = {"message": status.message, **values}

    def value(self, node, key):
        return self._statuses.get(self._prefix + node, {}).get(key, "")

    def wait_for_value(self, node, key, condition):
        wait_until(lambda: condition(self.value(node, key)),
                   lambda: f"{key} of {node} is '{self.value(node, key)}'")

    def wait_for_message(self, node, part):
        self.wait_for_value(node, "message", lambda message: message and part in message)

    def wait_for_odometry(self, count=10):
        """Waits for `count` more poses; returns their timestamps."""
        before = len(self.odometry)
        wait_until(lambda: len(self.odometry) >= before + count,
                   lambda: "odometry: " + self.value("vins_estimator", "message"))
        return self.odometry[before:]
