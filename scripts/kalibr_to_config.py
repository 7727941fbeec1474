#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns the results of Kalibr into a configuration of one camera and one IMU.

Format of the inputs: https://github.com/ethz-asl/kalibr/wiki/yaml-formats
The files of OpenVINS, kalibr_imucam_chain.yaml and kalibr_imu_chain.yaml, have it as well.
"""

import argparse
import math
import os
import sys

import numpy as np
import yaml

MAX_ROTATION_ERROR = 5e-3  # what the configuration reader accepts
DISTORTION_SIZES = {"radtan": 4, "equidistant": 4, "none": 0}
MODEL_TYPES = {("pinhole", "radtan"): "PINHOLE", ("pinhole", "none"): "PINHOLE",
               ("pinhole", "equidistant"): "EQUIDISTANT",
               ("omni", "radtan"): "MEI", ("omni", "none"): "MEI"}
PROJECTION_NAMES = {"PINHOLE": ("fx", "fy", "cx", "cy"), "EQUIDISTANT": ("fx", "fy", "cx", "cy"),
                    "MEI": ("gamma1", "gamma2", "u0", "v0")}
DISTORTION_NAMES = {"PINHOLE": ("k1", "k2", "p1", "p2"), "EQUIDISTANT": ("k1", "k2", "k3", "k4"),
                    "MEI": ("k1", "k2", "p1", "p2")}
NOISE_KEYS = {"acc_n": "accelerometer_noise_density", "gyr_n": "gyroscope_noise_density",
              "acc_w": "accelerometer_random_walk", "gyr_w": "gyroscope_random_walk"}


class KalibrError(Exception):
    """One problem of an input file; its text names file and key."""


class Section:
    """A map of a Kalibr file. Reads checked values and names file and key where that fails."""

    def __init__(self, file, path, values):
        self.file, self.path, self.values = file, path, values
        if not isinstance(values, dict):
            raise self.error("", "is not a map of keys")

    def error(self, key, problem):
        name = ".".join(part for part in (self.path, key) if part)
        return KalibrError(f"{self.file}: {name + ': ' if name else ''}{problem}")

    def get(self, key, hint="add it"):
        if key not in self.values:
            raise self.error(key, f"is missing; {hint}")
        return self.values[key]

    def section(self, key):
        known = ", ".join(str(name) for name in self.values)
        return Section(self.file, key, self.get(key, f"there is {known}"))

    def text(self, key):
        value = self.get(key)
        if not isinstance(value, str) or not value or '"' in value:
            raise self.error(key, f"must be a name, not {value!r}")
        return value

    def number(self, key):
        return self._as_number(key, self.get(key))

    def numbers(self, key, size):
        values = self.get(key)
        if not isinstance(values, list) or len(values) != size:
            raise self.error(key, f"must be a list of {size} numbers")
        return [self._as_number(key, value) for value in values]

    def transform(self, key, hint="add it"):
        """A 4x4 rigid transform, as rotation (3x3) and translation (3)."""
        rows = self.get(key, hint)
        if not isinstance(rows, list) or len(rows) != 4:
            raise self.error(key, "must have 4 rows")
        if any(not isinstance(row, list) or len(row) != 4 for row in rows):
            raise self.error(key, "must have 4 numbers in each row")
        matrix = np.array([[self._as_number(key, value) for value in row] for row in rows])
        rotation = matrix[:3, :3]
        error = np.abs(rotation @ rotation.T - np.eye(3)).max()
        if error > MAX_ROTATION_ERROR or np.linalg.det(rotation) < 0:
            raise self.error(key, "its upper left 3x3 block is not a rotation")
        if not np.array_equal(matrix[3], [0, 0, 0, 1]):
            raise self.error(key, "its last row must be 0 0 0 1")
        return rotation, matrix[:3, 3]

    def _as_number(self, key, value):
        try:  # YAML 1.1 takes 1e-3 for a text
            number = math.nan if isinstance(value, bool) else float(value)
        except (TypeError, ValueError):
            number = math.nan
        if not math.isfinite(number):
            raise self.error(key, f"must be a number, not {value!r}")
        return number


def read_section(file):
    """The whole file as a Section."""
    try:
        with open(file, encoding="utf-8") as stream:
            text = stream.read()
        # OpenCV's header, which other programs want in Kalibr's files, is no valid YAML.
        header, _, rest = text.partition("\n")
        return Section(file, "", yaml.safe_load(rest if header.startswith("%YAML:") else text))
    except OSError as error:
        raise KalibrError(f"{file}: {error.strerror}") from error
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        raise KalibrError(f"{file}: is not YAML: {' '.join(str(error).split())}") from error


def refuse_rolling_shutter(camera):
    for key, value in camera.values.items():
        if "line_delay" in str(key) and value != 0:
            raise camera.error(key, "a rolling-shutter camera: remove this line, then set"
                               " rolling_shutter and rolling_shutter_tr in the configuration")


def camera_lines(camera):
    """The intrinsics. `camera` is a section of the camera chain."""
    refuse_rolling_shutter(camera)
    model, distortion = camera.text("camera_model"), camera.text("distortion_model")
    if (model, distortion) not in MODEL_TYPES:
        raise camera.error("camera_model", f"{model}-{distortion} is not supported; calibrate with"
                           " pinhole-radtan, pinhole-equi or omni-radtan")
    model_type = MODEL_TYPES[model, distortion]
    width, height = camera.numbers("resolution", 2)
    intrinsics = camera.numbers("intrinsics", 5 if model == "omni" else 4)
    coefficients = camera.numbers("distortion_coeffs", DISTORTION_SIZES[distortion]) or [0.0] * 4

    lines = [f"model_type: {model_type}",
             f"image_width: {width:g}   # [px]", f"image_height: {height:g}  # [px]"]
    if model == "omni":
        lines += ["mirror_parameters:", f"   xi: {intrinsics[0]!r}  # [1]"]
    lines += ["projection_parameters:  # [px]"]
    lines += [f"   {name}: {value!r}"
              for name, value in zip(PROJECTION_NAMES[model_type], intrinsics[-4:])]
    lines += ["distortion_parameters:  # [1]"]
    lines += [f"   {name}: {value!r}"
              for name, value in zip(DISTORTION_NAMES[model_type], coefficients)]
    return lines


def matrix_lines(key, matrix, unit):
    """A matrix in OpenCV's notation."""
    rows = [", ".join(repr(float(value)) for value in row) for row in matrix]
    return [f"{key}: !!opencv-matrix  # [{unit}]", f"   rows: {len(matrix)}",
            f"   cols: {len(matrix[0])}", "   dt: d",
            "   data: [" + ",\n          ".join(rows) + "]"]


def camera_in_imu(camera):
    """R_B_C and p_B_C. Kalibr gives p_C = T_cam_imu p_B, OpenVINS p_B = T_imu_cam p_C."""
    if "T_imu_cam" in camera.values:
        return camera.transform("T_imu_cam")
    hint = "give the camchain-imucam file of kalibr_calibrate_imu_camera"
    R_C_B, p_C_B = camera.transform("T_cam_imu", hint)
    return R_C_B.T, -R_C_B.T @ p_C_B


def extrinsic_lines(camera):
    """The time offset is Kalibr's: t_imu = t_cam + shift."""
    R_B_C, p_B_C = camera_in_imu(camera)
    td = camera.number("timeshift_cam_imu") if "timeshift_cam_imu" in camera.values else 0.0
    return ["# Camera in the IMU frame, T_B_C.", "estimate_extrinsic: 0",
            *matrix_lines("extrinsicRotation", R_B_C, "1"),
            *matrix_lines("extrinsicTranslation", p_B_C.reshape(3, 1), "m"),
            f"td: {td!r}  # t_imu = t_image + td [s]",
            "estimate_td: 0"]


def imu_section(imu_file):
    """The IMU: the whole file as given to Kalibr, imu0 in the file that Kalibr writes."""
    imu = read_section(imu_file)
    if "imu0" in imu.values:
        imu = imu.section("imu0")
    if imu.values.get("model", "calibrated") not in ("calibrated", "kalibr"):
        raise imu.error("model", f"{imu.values['model']} has scale and misalignment, which are not"
                        " supported; calibrate with the model calibrated")
    return imu


def noise_lines(imu):
    lines = ["# Densities as given to Kalibr. What flight shows beyond is learned: docs/tuning.md.",
             "imu_noise_model: continuous"]
    units = {"acc_n": "m/s^2/sqrt(Hz)", "gyr_n": "rad/s/sqrt(Hz)",
             "acc_w": "m/s^3/sqrt(Hz)", "gyr_w": "rad/s^2/sqrt(Hz)"}
    for name, key in NOISE_KEYS.items():
        value = imu.number(key)
        if value <= 0:
            raise imu.error(key, "must be positive")
        lines.append(f"{name}: {value!r}  # [{units[name]}]")
    if "update_rate" in imu.values:
        lines.append(f"imu_rate: {imu.number('update_rate')!r}  # [Hz]")
    return lines


def convert(camchain_file, imu_file, camera_name):
    """The configuration as text; raises KalibrError."""
    camera = read_section(camchain_file).section(camera_name)
    imu = imu_section(imu_file)
    paragraphs = [
        ["%YAML:1.0",
         f"# {camera_name} of {os.path.basename(camchain_file)}, IMU of"
         f" {os.path.basename(imu_file)}; by kalibr_to_config.py.",
         "# Every key with unit, range and default: reference.yaml."],
        [f'image_topic: "{camera.text("rostopic")}"', f'imu_topic: "{imu.text("rostopic")}"'],
        camera_lines(camera),
        extrinsic_lines(camera),
        noise_lines(imu)]
    return "\n\n".join("\n".join(lines) for lines in paragraphs) + "\n"


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("camchain", help="camchain-imucam-*.yaml of kalibr_calibrate_imu_camera, or"
                        " kalibr_imucam_chain.yaml of OpenVINS")
    parser.add_argument("imu", help="imu-*.yaml of Kalibr, the imu.yaml given to it, or"
                        " kalibr_imu_chain.yaml of OpenVINS")
    parser.add_argument("--cam", default="cam0", help="camera of the chain (default: cam0)")
    parser.add_argument("--output", metavar="FILE", help="new file (default: standard output)")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        text = convert(options.camchain, options.imu, options.cam)
        if options.output is None:
            sys.stdout.write(text)
        else:
            with open(options.output, "x", encoding="utf-8") as file:
                file.write(text)
    except KalibrError as error:
        print(f"kalibr_to_config.py: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"kalibr_to_config.py: {options.output}: {error.strerror}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
