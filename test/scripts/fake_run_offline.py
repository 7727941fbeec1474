#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Replaces run_offline in tests of run_dataset.py.

The "recording" is a text file whose words select the behavior: `fly` writes results; `fail`,
`crash` and `hang` write none; `lose` ends with exit code 0
but without results; `meet` flies as soon as another run is active too; `stumble` fails from STUMBLE
on; `jump` flies twice, the second time with the timestamps of the first. The estimate is flight()
with offsets of alternating sign, so that the APE is known: OFFSETS, with `drift` increased by DRIFT
for every second that is skipped. Every call appends a line to calls.txt in the program's folder.
"""

import argparse
import glob
import json
import math
import os
import signal
import sys
import time

START = 1403636580.0  # [s]
RATE, SECONDS = 20.0, 20.0
LATE = 1.0  # delay of the first pose after the first image [s]
OFFSETS = {"harris": 0.2, "shi_tomasi": 0.1}  # by corner detector [m]
DRIFT = 0.01  # [m/s]
STUMBLE = 8.0  # [s]


def flight(rate=RATE):
    """Returns timestamps [s] and positions [m]. (NumPy would take most of a run's time to load.)"""
    times = [i / rate for i in range(round(SECONDS * rate) + 1)]
    return [START + t for t in times], [
        [3 * math.cos(t), 2 * math.sin(0.7 * t), 0.5 * math.sin(1.3 * t)] for t in times]


def write_tum(path, stamps, positions):
    with open(path, "w", encoding="utf-8") as file:
        for stamp, (x, y, z) in zip(stamps, positions):
            file.write(f"{stamp:.9f} {x:.9f} {y:.9f} {z:.9f} 0 0 0 1\n")


def parse_arguments():
    parser = argparse.ArgumentParser(allow_abbrev=False)
    for option in ("config", "bag", "asl", "output"):
        parser.add_argument("--" + option)
    parser.add_argument("--start", type=float, default=0.0)
    parser.add_argument("--duration", type=float, default=SECONDS)
    parser.add_argument("--set", action="append", default=[])
    return parser.parse_args()


def write_results(options, settings, drift):
    begin = START + options.start
    inside = [pose for pose in zip(*flight())
              if begin + LATE <= pose[0] <= begin + options.duration + 1e-6]
    stamps, positions = zip(*inside)
    offset = OFFSETS[settings["corner_detector"]] + drift * options.start
    for index, position in enumerate(positions):
        position[2] += -offset if index % 2 else offset
    write_tum(os.path.join(options.output, "trajectory.tum"), stamps, positions)
    with open(os.path.join(options.output, "timing.csv"), "w", encoding="utf-8") as file:
        file.write("stamp_ns,total\n" + "".join(f"{round(s * 1e9)},10\n" for s in stamps))
    summary = {"init_time_s": LATE, "real_time_factor": 5.0, "resets": 0,
               "timing_ms": {"total": {"mean": 10.0, "p99": 21.0}}}
    with open(os.path.join(options.output, "summary.json"), "w", encoding="utf-8") as file:
        json.dump(summary, file)


def meet(folder):
    """Waits until another run is active; returns whether one started."""
    with open(os.path.join(folder, f"{os.getpid()}.here"), "w", encoding="utf-8"):
        pass
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        if len(glob.glob(os.path.join(folder, "*.here"))) > 1:
            return True
        time.sleep(0.02)
    return False


def main():
    options = parse_arguments()
    settings = dict(text.split("=", 1) for text in options.set)
    folder = os.path.dirname(os.path.abspath(__file__))
    if "nonsense" in settings:
        sys.exit("run_offline: --set nonsense: unknown key; remove it")
    recording = options.bag or os.path.join(options.asl, "mav0", "cam0", "data.csv")
    if not os.path.isfile(recording):
        sys.exit(f"run_offline: not an ASL folder: {recording} is missing")
    with open(os.path.join(folder, "calls.txt"), "a", encoding="utf-8") as file:
        file.write(" ".join(sys.argv[1:]) + "\n")
    with open(recording, encoding="utf-8") as file:
        words = file.read().split()
    if "fail" in words or ("stumble" in words and options.start >= STUMBLE):
        sys.exit("run_offline: no trajectory from 400 images: too little motion")
    if "crash" in words:
        os.kill(os.getpid(), signal.SIGKILL)
    if "hang" in words:
        with open(os.path.join(options.output, "pid"), "w", encoding="utf-8") as file:
            file.write(f"{os.getpid()}\n")
        time.sleep(600)
    if "meet" in words and not meet(folder):
        sys.exit("run_offline: nobody came")
    if "jump" in words:
        write_tum(os.path.join(options.output, "trajectory_1.tum"), *flight())
    if "lose" not in words:
        write_results(options, settings, DRIFT if "drift" in words else 0.0)


if __name__ == "__main__":
    main()
