#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plays a bag to the nodes and measures their cost: the time from an image's arrival to the
odometry of that image, and the CPU time of each node."""

import argparse
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import xmlrpc.client

import numpy as np
import rosgraph
import rospy
import yaml
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CompressedImage, Image

QUANTILES = (50, 95, 99, 100)
NODES = ("/feature_tracker", "/linefeature_tracker", "/vins_estimator", "/pose_graph",
         "/vins_manager")
START_TIMEOUT = 30  # [s]
END_AFTER = 3  # [s] without images
SECONDS_PER_TICK = 1 / os.sysconf("SC_CLK_TCK")


class Latencies:
    """Time from the arrival of an image to the arrival of its odometry, both measured in this
    process."""

    def __init__(self):
        self._arrivals = {}  # by timestamp
        self._last_arrival = None
        self.seconds = []

    def add_image(self, message):
        self._last_arrival = time.monotonic()
        self._arrivals[message.header.stamp.to_nsec()] = self._last_arrival

    def add_odometry(self, message):
        arrival = self._arrivals.pop(message.header.stamp.to_nsec(), None)
        if arrival is not None:
            self.seconds.append(time.monotonic() - arrival)

    @property
    def begun(self):
        return self._last_arrival is not None

    @property
    def ended(self):
        """True if images arrived, but no more have for END_AFTER seconds."""
        return self.begun and time.monotonic() - self._last_arrival > END_AFTER

    @property
    def images(self):
        """Number of images received, with or without odometry."""
        return len(self._arrivals) + len(self.seconds)


def process_of(node):
    """Returns the id of a node's process, or None if it does not run."""
    try:
        uri = rosgraph.Master("/measure_latency").lookupNode(node)
        return xmlrpc.client.ServerProxy(uri).getPid("/measure_latency")[2]
    except (OSError, rosgraph.MasterException):
        return None


def find_nodes(processes):
    """Adds the running nodes to `processes`."""
    for node in NODES:
        if node not in processes and (found := process_of(node)):
            processes[node] = found


def processor_seconds(process):
    with open(f"/proc/{process}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * SECONDS_PER_TICK


def image_topic(config):
    with open(config, encoding="utf-8") as file:
        text = file.read()
    # OpenCV starts its YAML with an invalid directive.
    lines = [line for line in text.splitlines() if not line.startswith("%YAML")]
    contents = yaml.safe_load("\n".join(lines).replace("!!opencv-matrix", ""))
    topic = contents.get("image_topic") if isinstance(contents, dict) else None
    if not isinstance(topic, str):
        raise RuntimeError(f"{config}: has no image_topic; give the configuration of the sensors")
    return topic


def image_source(options):
    """Returns topic and type of the images."""
    topic = image_topic(options.config)
    if options.image_transport == "compressed":
        return topic + "/compressed", CompressedImage
    return topic, Image


def subscribe(topic, kind, latencies):
    rospy.Subscriber(topic, kind, latencies.add_image, queue_size=100, buff_size=1 << 24)
    rospy.Subscriber("/vins_estimator/odometry", Odometry, latencies.add_odometry, queue_size=100)


def launch_file():
    """Returns the launch file as arguments of roslaunch: that of this checkout, or of the installed
    package."""
    file = pathlib.Path(__file__).resolve().parents[1] / "launch" / "plm_vins.launch"
    return [str(file)] if file.is_file() else ["plm_vins", file.name]


def launch(options, output):
    command = ["roslaunch", *launch_file(), f"config:={os.path.abspath(options.config)}",
               f"nodelets:={str(options.nodelets).lower()}", f"output:={output}",
               "use_sim_time:=false",  # no sensor publishes a clock, which has a cost for each node
               f"image_transport:={options.image_transport}"]
    if options.loop_closure:
        command.append("loop_closure:=true")
    return subprocess.Popen(command, stdout=subprocess.DEVNULL)


def play(options):
    """Plays the bag with a delay that gives the nodes time to subscribe."""
    span = ["--duration", str(options.duration)] if options.duration else []
    return subprocess.Popen(["rosbag", "play", "--quiet", "--delay", "3", "--rate",
                             str(options.rate), *span, options.bag], stdout=subprocess.DEVNULL)


def wait_for_master(process):
    deadline = time.monotonic() + START_TIMEOUT
    while not rosgraph.is_master_online():
        if process.poll() is not None or time.monotonic() > deadline:
            raise RuntimeError("roslaunch did not start")
        time.sleep(0.1)


def measure(options, output):
    """Returns the latencies and the CPU time [s] by node."""
    (topic, kind), latencies = image_source(options), Latencies()
    running = [launch(options, output)]
    try:
        wait_for_master(running[0])
        rospy.init_node("measure_latency", anonymous=True, disable_signals=True)
        subscribe(topic, kind, latencies)
        running.append(play(options))
        return latencies, watch(options, topic, latencies, *running)
    finally:
        for process in reversed(running):
            process.send_signal(signal.SIGINT)
            process.wait()


def watch(options, topic, latencies, nodes, player):
    """Returns the CPU time [s] by node, once images have ended or the nodes have exited. Raises
    RuntimeError if no image comes at all."""
    costs, processes, deadline = {}, {}, time.monotonic() + START_TIMEOUT
    while nodes.poll() is None and not latencies.ended:
        find_nodes(processes)
        for node, identity in processes.items():
            if os.path.exists(f"/proc/{identity}"):
                costs[node] = processor_seconds(identity)
        played = player.poll()  # its last messages may still be in transit
        time.sleep(0.2)
        if not latencies.begun:
            check_player(options, topic, played, time.monotonic() > deadline)
    if not latencies.begun:
        raise RuntimeError(f"the nodes ended before an image arrived on {topic}")
    return costs


def check_player(options, topic, exit_code, is_late):
    """Raises RuntimeError if no more images can be expected; `exit_code` is None while the player
    runs."""
    if exit_code:
        raise RuntimeError(f"rosbag play ended with code {exit_code}: is {options.bag} complete?")
    if exit_code == 0 or is_late:
        when = f"in {START_TIMEOUT} s" if exit_code is None else f"from {options.bag}"
        raise RuntimeError(f"no image arrived on {topic} {when}: see image_topic in"
                           f" {options.config} and --image-transport")


def report(latencies, costs):
    lines = [f"{len(latencies.seconds)} poses of {latencies.images} images"]
    if latencies.seconds:
        values = np.percentile(1e3 * np.array(latencies.seconds), QUANTILES)
        lines.append("image to odometry [ms]: " + ", ".join(
            f"p{quantile} {value:.1f}" for quantile, value in zip(QUANTILES, values)))
    for node, seconds in costs.items():
        lines.append(f"{node[1:]:20s} {seconds:7.2f} s of CPU, "
                     f"{1e3 * seconds / max(latencies.images, 1):6.2f} ms per image")
    total = sum(costs.values())
    lines.append(f"{'all':20s} {total:7.2f} s of CPU, "
                 f"{1e3 * total / max(latencies.images, 1):6.2f} ms per image")
    return "\n".join(lines)


def check_files(options):
    for file, wanted in ((options.bag, "ROS bag"), (options.config, "configuration")):
        if os.path.isdir(file):
            raise RuntimeError(f"{file}: a folder; give the file of the {wanted}")
        if not os.path.isfile(file):
            raise RuntimeError(f"{file}: no such file")


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bag", help="ROS bag")
    parser.add_argument("--config", required=True, help="configuration of the sensors in the bag")
    parser.add_argument("--duration", type=float, help="play this much [s] (default: all)")
    parser.add_argument("--rate", type=float, default=1, help="playback rate (default: 1)")
    parser.add_argument("--nodelets", action="store_true", help="run all nodes in one process")
    parser.add_argument("--loop-closure", action="store_true",
                        help="enable it, whatever the configuration says")
    parser.add_argument("--image-transport", default="raw", choices=("raw", "compressed"),
                        help="form of the images in the bag (default: raw)")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        check_files(options)
        with tempfile.TemporaryDirectory() as output:
            latencies, costs = measure(options, output)
    except (RuntimeError, OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        print(f"measure_latency.py: {error}", file=sys.stderr)
        return 1
    print(report(latencies, costs))
    return 0 if latencies.seconds else 1


if __name__ == "__main__":
    sys.exit(main())
