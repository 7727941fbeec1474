#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts how often run_offline names the right cause first.

Simulates flights with two cameras and depth, and estimates each with one mistake at a time in
the configuration. Prints a row for each mistake: how often "most wrong" names it, and the other
answers.
Takes about a minute for each flight and ten mistakes.
"""

import argparse
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

R_B_C = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])
P_B_C0, P_B_C1 = [0.05, 0.03, 0.02], [0.05, -0.07, 0.02]
MONO, STEREO, DEPTH = "one camera", "stereo", "depth"
LENS = {"fx": 240.0, "fy": 240.0, "cx": 200.0, "cy": 150.0, "k1": 0.0, "k2": 0.0}
FLIGHTS = {"gentle": "room", "fast": "room", "gentle in a corridor": "corridor"}


def turned(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turn = {"x": [[1, 0, 0], [0, c, -s], [0, s, c]], "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis]
    return R_B_C @ np.array(turn)


def transform(rotation, position):
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = rotation, position
    return result


def beside(factor):
    """Returns the pose of the second camera at a multiple of the true baseline."""
    return transform(R_B_C, [0.05, 0.03 - 0.1 * factor, 0.02])


T0, T1 = transform(R_B_C, P_B_C0), transform(R_B_C, P_B_C1)
ROTATION, BASELINE, FOCAL = r"extrinsicRotation", r"baseline", r"focal length"
# Name, sensors, changes, and what the answer must contain. Changes of lens0 and lens1 are those of
# LENS, T0 and T1 are transforms; all others are keys.
MISTAKES = [
    *((f"baseline x {factor}", STEREO, {"T1": beside(factor)}, BASELINE)
      for factor in (10, 2.5, 1.3, 0.9, 0.5, 0.05)),
    *((f"depth x {1000 * unit:g}", DEPTH, {"depth_unit": unit}, "depths are")
      for unit in (0.01, 0.005, 0.00328, 0.0011, 0.0009, 0.0001)),
    ("both inverted", STEREO, {"T0": np.linalg.inv(T0), "T1": np.linalg.inv(T1)}, "invert|inverse"),
    ("first inverted", MONO, {"T0": np.linalg.inv(T0)}, "inverse"),
    ("second inverted", STEREO, {"T1": np.linalg.inv(T1)}, "(?<!and )body_T_cam1"),
    ("second on the other side", STEREO, {"T1": beside(-1)}, "swapped|body_T_cam1"),
    ("cameras swapped", STEREO, {"image_topic": "/cam1", "image1_topic": "/cam0"}, "swapped"),
    ("second turned by 1 deg", STEREO, {"T1": transform(turned("y", 1), P_B_C1)}, "turned by"),
    ("upside down", MONO, {"T0": transform(turned("z", 180), P_B_C0)}, ROTATION),
    ("turned by 90 deg", MONO, {"T0": transform(turned("z", 90), P_B_C0)}, ROTATION),
    ("turned by 10 deg", MONO, {"T0": transform(turned("x", 10), P_B_C0)}, ROTATION),
    ("turned by 4 deg", MONO, {"T0": transform(turned("y", 4), P_B_C0)}, ROTATION),
    ("focal length 300 for 240", MONO, {"lens0": {"fx": 300.0, "fy": 300.0}}, FOCAL),
    ("focal length 190 for 240", MONO, {"lens0": {"fx": 190.0, "fy": 190.0}}, FOCAL),
    ("both focal lengths 300", STEREO, {"lens0": {"fx": 300.0, "fy": 300.0},
                                        "lens1": {"fx": 300.0, "fy": 300.0}}, FOCAL),
    *((f"focal length x {factor}", MONO, {"lens0": {"fx": 240 * factor, "fy": 240 * factor}}, FOCAL)
      for factor in (1.05, 0.95)),
    *((f"second focal length x {factor}", STEREO,
       {"lens1": {"fx": 240 * factor, "fy": 240 * factor}}, FOCAL) for factor in (1.05, 0.98)),
    ("principal point 16 px off", MONO, {"lens0": {"cx": 216.0}}, "principal point"),
    ("principal point 12 px too high", MONO, {"lens0": {"cy": 138.0}}, "principal point"),
    ("second principal point 16 px off", STEREO, {"lens1": {"cx": 216.0}}, "principal point"),
    ("td 50 ms off", MONO, {"td": 0.05}, r"\btd\b"),
    ("td 30 ms off", MONO, {"td": -0.03}, r"\btd\b"),
    ("td 20 ms off", MONO, {"td": 0.02}, r"\btd\b"),
    ("distortion of the first lens", STEREO, {"lens0": {"k1": -0.28, "k2": 0.07}}, "distortion"),
    ("distortion of another lens", MONO, {"lens0": {"k1": -0.28, "k2": 0.07}}, "distortion"),
    ("scale of the gyro 5 % off", MONO, {"gyr_correction": 0.95 * np.eye(3)}, "gyro"),
    ("one axis of the gyro 5 % off", MONO, {"gyr_correction": np.diag([1.05, 1, 1])}, "gyro"),
    ("gyro 5 % off", MONO, {"gyr_correction": np.diag([1.06, 0.95, 1.03])}, "gyro"),
]
RIGHT = [(sensors, sensors, {}, "^nothing$") for sensors in (MONO, STEREO, DEPTH)]


def matrix(key, values):
    rows, columns = values.shape
    data = ", ".join(repr(float(value)) for value in values.flat)
    return [f"{key}: !!opencv-matrix", f"   rows: {rows}", f"   cols: {columns}", "   dt: d",
            f"   data: [{data}]"]


def camera(prefix, lens):
    return [f"{prefix}model_type: PINHOLE", f"{prefix}image_width: 400",
            f"{prefix}image_height: 300", f"{prefix}projection_parameters:",
            *(f"   {key}: {lens[key]}" for key in ("fx", "fy", "cx", "cy")),
            f"{prefix}distortion_parameters:", f"   k1: {lens['k1']}", f"   k2: {lens['k2']}",
            "   p1: 0.0", "   p2: 0.0"]


def configuration(sensors, changes):
    """Returns a configuration with some changes; None: all sensors."""
    changes = dict(changes)
    two = sensors in (STEREO, None)
    keys = {"image_topic": "/cam0", "imu_topic": "/imu0", "imu_noise_model": "continuous",
            "acc_n": 1e-2, "gyr_n": 8e-4, "acc_w": 3e-3, "gyr_w": 2e-5}
    if two:
        keys.update({"num_of_cam": 2, "image1_topic": "/cam1"})
    if sensors in (DEPTH, None):
        keys["depth_topic"] = "/depth"
    lines = ["%YAML:1.0", *camera("", {**LENS, **changes.pop("lens0", {})}),
             *matrix("body_T_cam0", changes.pop("T0", T0))]
    if two:
        lines += [*camera("cam1_", {**LENS, **changes.pop("lens1", {})}),
                  *matrix("body_T_cam1", changes.pop("T1", T1))]
    for key, value in {**keys, **changes}.items():
        if isinstance(value, np.ndarray):
            lines += matrix(key, value)
        else:
            lines.append(f'{key}: "{value}"' if isinstance(value, str) else f"{key}: {value}")
    return "\n".join(lines) + "\n"


def fly(options, folder):
    """Simulates the flights; returns their bags."""
    config = folder / "all.yaml"
    config.write_text(configuration(None, {}), encoding="utf-8")
    bags = {}
    for number, (name, world) in enumerate(FLIGHTS.items()):
        bag = folder / f"{number}.bag"
        if not bag.exists():
            subprocess.run([options.programs / "simulate", "--rig", config, "--depth", "--world",
                            world, "--motion", name.split()[0], "--duration", str(options.duration),
                            "--seed", str(number + 1), "--output", bag], check=True,
                           stderr=subprocess.DEVNULL)
        bags[name] = bag
    return bags


def answer(options, folder, bag, text):
    """Returns what is most wrong according to run_offline."""
    config = folder / "config.yaml"
    config.write_text(text, encoding="utf-8")
    result = subprocess.run([options.programs / "run_offline", "--config", config, "--bag", bag,
                             "--output", folder / "results"], stderr=subprocess.PIPE,
                            encoding="utf-8", check=False)
    if result.returncode:
        return result.stderr.splitlines()[-1]
    found = re.search("^most wrong: (.*)$", result.stderr, re.MULTILINE)
    return found[1] if found else "nothing"


def count(options, folder):
    bags = fly(options, folder)
    right = total = 0
    for name, sensors, changes, expected in RIGHT + MISTAKES:
        if options.only and not re.search(options.only, name):
            continue
        answers = [answer(options, folder, bag, configuration(sensors, changes))
                   for bag in bags.values()]
        wrong = [text for text in answers if not re.search(expected, text)]
        right += len(answers) - len(wrong)
        total += len(answers)
        print(f"{name:28} {len(answers) - len(wrong)} of {len(answers)}"
              + "".join(f"\n     {text[:150]}" for text in wrong), flush=True)
    print(f"{right} of {total} right")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=pathlib.Path, help="folder of simulate and run_offline")
    parser.add_argument("--folder", type=pathlib.Path, help="of the flights, to keep them")
    parser.add_argument("--duration", type=float, default=15, help="of each flight [s]")
    parser.add_argument("--only", help="regular expression of the mistakes to try")
    options = parser.parse_args()
    if options.folder:
        count(options, options.folder)
    else:
        with tempfile.TemporaryDirectory() as folder:
            count(options, pathlib.Path(folder))


if __name__ == "__main__":
    sys.exit(main())
