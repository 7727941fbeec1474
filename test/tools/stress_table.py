#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the odometry on saved features with each fault in turn, and prints the effect of each."""

import argparse
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.append(os.path.join(ROOT, "scripts"))
from evaluation.trajectory import TrajectoryError, read_truth  # noqa: E402
from stress import feature_file  # noqa: E402
from stress.damage import assess  # noqa: E402
from stress.faults import FAULTS  # noqa: E402

RUN_OFFLINE = os.path.join(ROOT, "build", "devel", "lib", "plm_vins", "run_offline")
CONFIG = os.path.join(ROOT, "config", "euroc.yaml")
HEAD = ("| fault | APE [m] | largest error [m] | restarts after [s] | coverage | noticed |\n"
        + 6 * "|---" + "|")
# Counts in summary.json that indicate a fault.
FOUND = ("imu_doubts", "bridged_losses")
NAMED = ("imu_implausible", "imu_replaced", "imu_saturated", "imu_stuck", "imu_gaps",
         "frames_repeated", *FOUND)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("features", help="file of run_offline --save-features")
    parser.add_argument("ground_truth", help="TUM file, EuRoC csv or ASL folder")
    parser.add_argument("--begin", type=float, default=24.0, metavar="S",
                        help="begin of the faults after the first image [s] (default: 24)")
    parser.add_argument("--faults", nargs="+", choices=FAULTS, default=list(FAULTS), metavar="NAME")
    parser.add_argument("--config", default=CONFIG)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--run-offline", default=RUN_OFFLINE, metavar="PROGRAM")
    return parser.parse_args(arguments)


def row(name, options, truth, folder):
    faulty, output = os.path.join(folder, "faulty.feat"), os.path.join(folder, name)
    feature_file.make_faulty(options.features, faulty, FAULTS[name].apply, options.begin)
    command = [options.run_offline, "--config", options.config, "--features", faulty,
               "--output", output]
    for override in options.set:
        command += ["--set", override]
    run = subprocess.run(command, stderr=subprocess.PIPE, encoding="utf-8", errors="replace",
                         check=False)
    if run.returncode != 0:
        why = _why(run)
        if name == "none":
            raise ValueError(f"no trajectory even without a fault: {why}")
        return f"| {name} | no trajectory: {why} |"
    start = feature_file.Features(options.features).measurements().image_ns[0] * 1e-9
    damage = assess(os.path.join(output, "trajectory.tum"), truth, start + options.begin)
    restarts = " ".join(f"{time:.1f}" for time in damage.restarts) or "-"
    return (f"| {name} | {damage.ape:.3f} | {damage.jump:.2f} | {restarts} |"
            f" {100 * damage.coverage:.0f} % | {_noticed(output)} |")


def _why(run):
    """Returns the last error message of run_offline."""
    said = [line for line in run.stderr.splitlines() if line.startswith("run_offline:")]
    return said[-1] if said else f"run_offline ended with {run.returncode}"


def _noticed(output):
    with open(os.path.join(output, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    counts = {**summary["dropped"], **{name: summary[name] for name in FOUND}}
    noticed = [f"{name} {counts[name]}" for name in NAMED if counts.get(name)]
    if summary["imu_noisy_share"] > 0:
        noticed.append(f"IMU noisy {100 * summary['imu_noisy_share']:.0f} %")
    return ", ".join(noticed) or "-"


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        truth = read_truth(options.ground_truth)
        with tempfile.TemporaryDirectory() as folder:
            for number, name in enumerate(options.faults):
                line = row(name, options, truth, folder)
                print(*([] if number else [HEAD]), line, sep="\n", flush=True)
    except (TrajectoryError, OSError, ValueError) as error:
        print(f"stress_table.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
