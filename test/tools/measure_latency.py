#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plays a bag to the nodes and measures their cost: the time from an image's arrival to the
odometry of that image, and the CPU time of each node."""

import argparse
import contextlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import xmlrpc.client

import numpy as np
import rosgraph
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CompressedImage, Image

LAUNCH_FILE = pathlib.Path(__file__).resolve().parents[2] / "launch" / "plm_vins.launch"
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


def find_nodes(processes):
    """Adds the process ids of running nodes to `processes`."""
    for node in NODES:
        if node not in processes:
            with contextlib.suppress(OSError, rosgraph.MasterException):
                uri = rosgraph.Master("/measure_latency").lookupNode(node)
                processes[node] = xmlrpc.client.ServerProxy(uri).getPid("/measure_latency")[2]


def processor_seconds(process):
    with open(f"/proc/{process}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * SECONDS_PER_TICK


def image_source(options):
    """Returns topic and type of the images."""
    found = re.search(r'^image_topic: *"?([^"\s]+)', pathlib.Path(options.config).read_text(
        encoding="utf-8"), re.MULTILINE)
    if not found:
        raise RuntimeError(f"{options.config}: has no image_topic; give the configuration of the"
                           " sensors")
    if options.image_transport == "compressed":
        return found[1] + "/compressed", CompressedImage
    return found[1], Image


@contextlib.contextmanager
def running(command):
    """Runs a program, which is interrupted in the end."""
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        try:
            yield process
        finally:
            process.send_signal(signal.SIGINT)


@contextlib.contextmanager
def nodes(config, **arguments):
    """Launches the nodes with arguments of the launch file, and registers this process as a node
    beside them."""
    values = [f"{name}:={value}" for name, value in arguments.items()]
    with running(["roslaunch", str(LAUNCH_FILE), f"config:={os.path.abspath(config)}",
                  *values]) as process:
        deadline = time.monotonic() + START_TIMEOUT
        while not rosgraph.is_master_online():
            if process.poll() is not None or time.monotonic() > deadline:
                raise RuntimeError("roslaunch did not start")
            time.sleep(0.1)
        rospy.init_node("measure_latency", anonymous=True, disable_signals=True)
        yield process


def player(bag, rate, *options):
    """Plays the bag with a delay that gives the nodes time to subscribe."""
    return running(["rosbag", "play", "--quiet", "--delay", "3", "--rate", str(rate), *options,
                    bag])


def measure(options, output):
    """Returns the latencies and the CPU time [s] by node."""
    (topic, kind), latencies = image_source(options), Latencies()
    arguments = {"output": output, "nodelets": str(options.nodelets).lower(),
                 "image_transport": options.image_transport,
                 # No sensor publishes a clock, which has a cost for each node.
                 "use_sim_time": "false"}
    if options.loop_closure:
        arguments["loop_closure"] = "true"
    span = ["--duration", str(options.duration)] if options.duration else []
    with nodes(options.config, **arguments) as launched:
        rospy.Subscriber(topic, kind, latencies.add_image, queue_size=100, buff_size=1 << 24)
        rospy.Subscriber("/vins_estimator/odometry", Odometry, latencies.add_odometry,
                         queue_size=100)
        with player(options.bag, options.rate, *span) as played:
            costs = watch(latencies, launched, played)
    if not latencies.begun:
        raise RuntimeError(f"no image arrived on {topic}: see image_topic in {options.config},"
                           f" --image-transport, and whether {options.bag} is complete")
    return latencies, costs


def watch(latencies, launched, played):
    """Returns the CPU time [s] by node, once images have ended, the nodes have exited, or no image
    can be expected any more."""
    costs, processes, deadline = {}, {}, time.monotonic() + START_TIMEOUT
    while launched.poll() is None and not latencies.ended:
        find_nodes(processes)
        for node, process in processes.items():
            with contextlib.suppress(OSError):  # a node that has ended
                costs[node] = processor_seconds(process)
        # The last messages may still be in transit when the player has ended.
        is_last = played.poll() is not None or time.monotonic() > deadline
        time.sleep(0.2)
        if is_last and not latencies.begun:
            break
    return costs


def report(latencies, costs):
    lines = [f"{len(latencies.seconds)} poses of {latencies.images} images"]
    if latencies.seconds:
        values = np.percentile(1e3 * np.array(latencies.seconds), QUANTILES)
        lines.append("image to odometry [ms]: " + ", ".join(
            f"p{quantile} {value:.1f}" for quantile, value in zip(QUANTILES, values)))
    for node, seconds in [*costs.items(), ("/all", sum(costs.values()))]:
        lines.append(f"{node[1:]:20s} {seconds:7.2f} s of CPU, "
                     f"{1e3 * seconds / max(latencies.images, 1):6.2f} ms per image")
    return "\n".join(lines)


def parser_of(description, bag_help="ROS bag"):
    """Returns a parser of what is needed to play a bag to the nodes."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("bag", help=bag_help)
    parser.add_argument("--config", required=True, help="configuration of the sensors in the bag")
    parser.add_argument("--rate", type=float, default=1, help="playback rate (default: 1)")
    return parser


def run(program, options, work):
    """Returns what `work` returns for the options and a temporary output folder; if it fails,
    prints the reason and returns None."""
    try:
        open(options.bag, "rb").close()
        with tempfile.TemporaryDirectory() as output:
            return work(options, output)
    except (RuntimeError, OSError, UnicodeDecodeError, rosgraph.MasterException) as error:
        print(f"{program}: {error}", file=sys.stderr)
        return None


def parse_arguments(arguments):
    parser = parser_of(__doc__)
    parser.add_argument("--duration", type=float, help="play this much [s] (default: all)")
    parser.add_argument("--nodelets", action="store_true", help="run all nodes in one process")
    parser.add_argument("--loop-closure", action="store_true",
                        help="enable it, whatever the configuration says")
    parser.add_argument("--image-transport", default="raw", choices=("raw", "compressed"),
                        help="form of the images in the bag (default: raw)")
    return parser.parse_args(arguments)


def main(arguments=None):
    measured = run("measure_latency.py", parse_arguments(arguments), measure)
    if measured is None:
        return 1
    latencies, costs = measured
    print(report(latencies, costs))
    return 0 if latencies.seconds else 1


if __name__ == "__main__":
    sys.exit(main())
