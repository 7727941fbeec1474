#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Starts the odometry at many times of recordings, and prints when the first pose comes, how large
the errors after it are, and whether the stated covariance is true."""

import argparse
import collections
import os
import subprocess
import sys
import tempfile

import numpy as np

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.append(os.path.join(ROOT, "scripts"))
from evaluation import consistency, metrics  # noqa: E402
from evaluation.run_results import read_estimate  # noqa: E402
from evaluation.trajectory import TrajectoryError, read_truth  # noqa: E402

RUN_OFFLINE = os.path.join(ROOT, "build", "devel", "lib", "plm_vins", "run_offline")
CONFIG = os.path.join(ROOT, "config", "euroc.yaml")
SETTLED = 3.5  # errors are compared from then on, however early the first pose comes [s]
SHORT = 2.0  # after the first pose [s]
LEAST = 2.0  # shortest span of errors [s]
SURE_AND_WRONG = 4.0  # error after SHORT, in standard deviations of its three axes


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("recordings", nargs="+", metavar="RECORDING[=TRUTH]",
                        help="bag with FILE.tum beside it, or ASL folder")
    parser.add_argument("--every", type=float, default=0.5, metavar="S",
                        help="time between starts [s] (default: 0.5)")
    parser.add_argument("--first", type=float, default=0.0, metavar="S")
    parser.add_argument("--last", type=float, default=10.0, metavar="S",
                        help="last start after the first image [s] (default: 10)")
    parser.add_argument("--seconds", type=float, default=10.0, metavar="S",
                        help="errors are measured up to this long after the start has settled")
    parser.add_argument("--config", default=CONFIG)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--features", metavar="DIR",
                        help="tracked features of each start are stored here, and used if there")
    parser.add_argument("--details", action="store_true", help="also print a line for each start")
    parser.add_argument("--run-offline", default=RUN_OFFLINE, metavar="PROGRAM")
    return parser.parse_args(arguments)


class Start:
    """Time to the first pose and errors of one start; NaN if unknown."""

    def __init__(self, begin):
        self.begin = begin  # after the first image of the recording [s]
        self.first_pose = np.nan  # after the first image of the start [s]
        self.settled_ape = np.nan  # from SETTLED after the first image on, SE3 [m]
        self.error = np.nan  # of the displacement within SHORT after the first pose [m]
        self.stated = np.nan  # its stated standard deviation [m]
        self.sigmas = np.nan  # its Mahalanobis distance per axis
        self.scale = np.nan  # error of the size of the path within SHORT, relative
        self.restarts = 0
        self.waited = ""

    def is_sure_and_wrong(self):
        return self.sigmas > SURE_AND_WRONG

    def line(self):
        return (f"{self.begin:7.2f} {self.first_pose:6.2f} {1e3 * self.settled_ape:8.1f}"
                f" {1e3 * self.error:8.1f} {1e3 * self.stated:7.1f} {self.sigmas:6.2f}"
                f" {100 * self.scale:+7.1f} {self.restarts:2d}  {self.waited}")


HEAD = "  start   pose  APE/mm   2s/mm  stated sigmas scale/%   waited for"


def measure(options, recording, truth, begin, folder):
    output = os.path.join(folder, "run")
    start = Start(begin)
    run = subprocess.run(_command(options, recording, begin, output), stderr=subprocess.PIPE,
                         encoding="utf-8", errors="replace", check=False)
    waits = [line for line in run.stderr.splitlines() if line.startswith("no pose for")]
    start.waited = waits[-1].partition(": ")[2] if waits else ""
    if run.returncode != 0:
        start.waited = (run.stderr.splitlines() or ["?"])[-1]
        return start
    try:
        _assess(start, output, truth, options)
    except TrajectoryError as error:
        start.waited += f" [{error}]"
    return start


def _command(options, recording, begin, output):
    """Tracks the images of a start only once if the features are stored."""
    command = [options.run_offline, "--config", options.config, "--output", output]
    for override in options.set:
        command += ["--set", override]
    duration = SETTLED + options.seconds
    images = [] if os.path.isdir(recording) else ["--bag", recording]
    images = images or ["--asl", recording]
    images += ["--start", f"{begin:g}", "--duration", f"{duration:g}"]
    if not options.features:
        return command + images
    name = os.path.basename(os.path.abspath(recording))
    features = os.path.join(options.features, f"{name}_{begin:g}_{duration:g}.feat")
    if os.path.isfile(features):
        return command + ["--features", features]
    return command + images + ["--save-features", features]


def _assess(start, output, truth, options):
    path = os.path.join(output, "trajectory.tum")
    estimate = read_estimate(path)
    with open(path, encoding="utf-8") as file:
        start.restarts = sum(line.startswith("# the world frame") for line in file)
    with open(os.path.join(output, "timing.csv"), encoding="utf-8") as file:
        first_image = int(file.readlines()[1].split(",")[0]) * 1e-9
    start.first_pose = estimate.stamps[0] - estimate.shift - first_image
    covariances = consistency.read_covariances(os.path.join(output, "covariance.csv"),
                                               estimate.stamps - estimate.shift)
    _assess_begin(start, *metrics.associate(estimate, truth), estimate, covariances)
    later = estimate.select(estimate.stamps >= first_image + SETTLED)
    if len(later) and later.duration >= LEAST:
        later, true = metrics.associate(later, truth)
        later = later.transformed(*metrics.alignment(later, true, "se3"))
        start.settled_ape = np.sqrt(np.mean(metrics.position_errors(later, true) ** 2))


def _assess_begin(start, estimate, truth, all_poses, all_covariances):
    """Compares the displacement within SHORT after the first pose with its covariance."""
    inside = np.flatnonzero(estimate.stamps <= all_poses.stamps[0] + SHORT + 0.01)
    if len(inside) < 3 or estimate.stamps[inside[-1]] < all_poses.stamps[0] + SHORT - 0.1:
        return
    estimate, truth = estimate.select(inside), truth.select(inside)
    rows = metrics.nearest_indices(all_poses.stamps, estimate.stamps[[0, -1]])
    rotation, _ = metrics.alignment(truth, estimate, "yaw")
    moved = estimate.positions - estimate.positions[0]
    truly = (truth.positions - truth.positions[0]) @ rotation.T
    error = moved[-1] - truly[-1]
    covariance = all_covariances[rows, :3, :3].sum(axis=0)
    start.error = np.linalg.norm(error)
    start.stated = np.sqrt(np.trace(covariance))
    start.sigmas = np.sqrt(error @ np.linalg.solve(covariance, error) / 3)
    if np.ptp(truly, axis=0).max() > 0.1:
        start.scale = np.sum(moved * truly) / np.sum(truly * truly) - 1


def summary(name, starts):
    def finite(values):
        values = np.array(values)
        return values[np.isfinite(values)]

    def of(values, reduce, scale):
        values = finite(values)
        return scale * reduce(values) if len(values) else np.nan

    times = [s.first_pose for s in starts]
    apes, errors = [s.settled_ape for s in starts], [s.error for s in starts]
    squares = [s.sigmas ** 2 for s in starts]
    none = sum(not np.isfinite(time) for time in times)
    return (f"| {name} | {len(starts)} | {none} | {of(times, np.median, 1):.2f} |"
            f" {of(times, np.mean, 1):.2f} | {of(times, np.max, 1):.2f} |"
            f" {of(apes, np.mean, 1e3):.1f} | {of(apes, np.max, 1e3):.0f} |"
            f" {of(errors, np.mean, 1e3):.1f} | {of(errors, np.max, 1e3):.0f} |"
            f" {of([s.stated for s in starts], np.mean, 1e3):.1f} |"
            f" {3 * of(squares, np.median, 1):.1f} | {3 * of(squares, np.mean, 1):.1f} |"
            f" {sum(s.is_sure_and_wrong() for s in starts)} |"
            f" {sum(s.restarts for s in starts)} |")


TABLE_HEAD = ("| recording | starts | no pose | first pose: median [s] | mean | worst |"
              f" APE from {SETTLED:g} s on [mm] | worst | error after {SHORT:g} s [mm] | worst |"
              " stated | NEES, median | mean | over 4 sigma | restarts |\n" + 15 * "|---" + "|")


def main(arguments=None):
    options = parse_arguments(arguments)
    if options.features:
        os.makedirs(options.features, exist_ok=True)
    results = collections.OrderedDict()
    try:
        for argument in options.recordings:
            recording, _, truth = argument.partition("=")
            truth = read_truth(truth or _truth_beside(recording))
            starts = results.setdefault(os.path.basename(os.path.abspath(recording)), [])
            if options.details:
                print(recording, HEAD, sep="\n", flush=True)
            for begin in np.arange(options.first, options.last + 1e-6, options.every):
                with tempfile.TemporaryDirectory() as folder:
                    starts.append(measure(options, recording, truth, float(begin), folder))
                if options.details:
                    print(starts[-1].line(), flush=True)
    except (TrajectoryError, OSError) as error:
        print(f"measure_starts.py: {error}", file=sys.stderr)
        return 1
    print(TABLE_HEAD)
    for name, starts in results.items():
        print(summary(name, starts))
    if len(results) > 1:
        print(summary("all", [start for starts in results.values() for start in starts]))
    return 0


def _truth_beside(recording):
    return recording if os.path.isdir(recording) else os.path.splitext(recording)[0] + ".tum"


if __name__ == "__main__":
    sys.exit(main())
