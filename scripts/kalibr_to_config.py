#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Converts the results of Kalibr to a configuration of one camera and one IMU.

Format of the inputs: https://github.com/ethz-asl/kalibr/wiki/yaml-formats
The files of OpenVINS, kalibr_imucam_chain.yaml and kalibr_imu_chain.yaml, have it as well.
"""

import argparse
import os
import sys

from kalibr.cameras import camera_lines
from kalibr.sections import KalibrError, read_section

NOISE_KEYS = {"acc_n": "accelerometer_noise_density", "gyr_n": "gyroscope_noise_density",
              "acc_w": "accelerometer_random_walk", "gyr_w": "gyroscope_random_walk"}


def matrix_lines(key, matrix, unit):
    """Returns a matrix in OpenCV's notation."""
    rows = [", ".join(repr(float(value)) for value in row) for row in matrix]
    return [f"{key}: !!opencv-matrix  # [{unit}]", f"   rows: {len(matrix)}",
            f"   cols: {len(matrix[0])}", "   dt: d",
            "   data: [" + ",\n          ".join(rows) + "]"]


def camera_in_imu(camera):
    """Returns R_B_C and p_B_C. Kalibr gives p_C = T_cam_imu p_B, OpenVINS p_B = T_imu_cam p_C."""
    if "T_imu_cam" in camera.values:
        return camera.transform("T_imu_cam")
    hint = "give the camchain-imucam file of kalibr_calibrate_imu_camera"
    R_C_B, p_C_B = camera.transform("T_cam_imu", hint)
    return R_C_B.T, -R_C_B.T @ p_C_B


def extrinsic_lines(camera):
    """Returns the extrinsics as lines. The time offset is Kalibr's: t_imu = t_cam + shift."""
    R_B_C, p_B_C = camera_in_imu(camera)
    td = camera.number("timeshift_cam_imu") if "timeshift_cam_imu" in camera.values else 0.0
    return ["# Camera in the IMU frame, T_B_C.", "estimate_extrinsic: 0",
            *matrix_lines("extrinsicRotation", R_B_C, "1"),
            *matrix_lines("extrinsicTranslation", p_B_C.reshape(3, 1), "m"),
            f"td: {td!r}  # t_imu = t_image + td [s]",
            "estimate_td: 0"]


def imu_section(imu_file):
    """Returns the IMU section: the whole file as given to Kalibr, or imu0 in the file that Kalibr
    writes."""
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
    """Returns the configuration as text; raises KalibrError."""
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
