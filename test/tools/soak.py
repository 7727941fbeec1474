#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plays a bag to the nodes repeatedly and monitors values that must not grow: their memory, open
files and threads, and the age of the poses. Exit code 1 if one grows."""

import os
import sys
import time

import numpy as np
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from measure_latency import find_nodes, nodes, parser_of, player, run

# Permitted increase from the second quarter of the time to the last; caches and pools fill up in
# the first.
LIMITS = {"memory_MB": 20, "files": 3, "threads": 2, "pose_age_ms": 50}
HEAD = "| node | what | second quarter | last quarter |\n|---|---|---|---|"


class PoseAge:
    """The last age of a pose that the estimator reported [ms]."""

    def __init__(self):
        self.value = None  # unknown
        self.resets = 0
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._add)

    def _add(self, array):
        for status in array.status:
            values = {value.key: value.value for value in status.values}
            if "pose_age_ms" in values:
                self.resets = int(values["resets"])
                if "odometry_delay_ms" in values:  # the age is 0 before the first pose
                    self.value = float(values["pose_age_ms"])


def usage(process):
    """Returns the current usage of a process, or None if it does not exist."""
    try:
        with open(f"/proc/{process}/status", encoding="ascii") as file:
            fields = dict(line.split(":", 1) for line in file)
        return {"memory_MB": int(fields["VmRSS"].split()[0]) / 1024,
                "threads": int(fields["Threads"]), "files": len(os.listdir(f"/proc/{process}/fd"))}
    except (OSError, KeyError):
        return None


class Series:
    """Samples by node and quantity."""

    def __init__(self):
        self.samples = {}

    def add(self, node, values):
        for what, value in values.items():
            self.samples.setdefault((node, what), []).append(value)

    def growth(self):
        """Yields (node, quantity, mean of the second quarter, mean of the last quarter)."""
        for (node, what), values in self.samples.items():
            quarter = max(1, len(values) // 4)
            yield (node, what, float(np.mean(values[quarter:2 * quarter] or values)),
                   float(np.mean(values[-quarter:])))


def watch(options, launched, played):
    """Returns samples of every running node, until the time is over. Raises RuntimeError if a
    process has ended that should run, or if no pose came."""
    series, age = Series(), PoseAge()
    end = time.monotonic() + 60 * options.minutes
    processes = {}
    while time.monotonic() < end:
        time.sleep(options.interval)
        find_nodes(processes)
        for node, process in processes.items():
            values = usage(process)
            if values is None:
                raise RuntimeError(f"{node} has ended")
            series.add(node[1:], values)
        if launched.poll() is not None:
            raise RuntimeError("the nodes have ended")
        if played.poll() is not None:
            raise RuntimeError("rosbag play has ended")
        if age.value is not None:
            series.add("vins_estimator", {"pose_age_ms": age.value})
    if age.value is None:
        raise RuntimeError(f"no pose arrived in {options.minutes:g} minutes: see the topics in"
                           f" {options.config}, and /diagnostics")
    print(f"{options.minutes:g} minutes, {age.resets} world frames lost")
    return series


def soak(options, output):
    """Starts the nodes and the player, and stops them after the time."""
    with nodes(options.config, output=output, use_sim_time="true") as launched, \
            player(options.bag, options.rate, "--loop", "--clock") as played:
        return watch(options, launched, played)


def report(series):
    """Prints the table; returns True if nothing has grown."""
    print(HEAD)
    grown = []
    for node, what, before, after in series.growth():
        print(f"| {node} | {what} | {before:.1f} | {after:.1f} |")
        if after - before > LIMITS[what]:
            grown.append(f"{what} of {node}")
    if grown:
        print("soak.py: growth in " + ", ".join(grown), file=sys.stderr)
    return not grown


def parse_arguments(arguments):
    parser = parser_of(__doc__, "ROS bag, played in a loop")
    parser.add_argument("--minutes", type=float, default=60, help="(default: 60)")
    parser.add_argument("--interval", type=float, default=5,
                        help="time between samples [s] (default: 5)")
    return parser.parse_args(arguments)


def main(arguments=None):
    series = run("soak.py", parse_arguments(arguments), soak)
    return 0 if series is not None and report(series) else 1


if __name__ == "__main__":
    sys.exit(main())
