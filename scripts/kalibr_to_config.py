#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Converts the results of Kalibr to a configuration of one or two cameras and one IMU.

Format of the inputs: https://github.com/ethz-asl/kalibr/wiki/yaml-formats
The files of OpenVINS, kalibr_imucam_chain.yaml and kalibr_imu_chain.yaml, have it as well.
"""

import argparse
import os
import sys

from kalibr.cameras import camera_lines
from kalibr.imu import Imu
from kalibr.mounting import camera_in_imu, matrix_lines
from kalibr.sections import KalibrError, read_section


def extrinsic_lines(T_B_C, td):
    return ["# Camera in the IMU frame, T_B_C.", "estimate_extrinsic: 0",
            *matrix_lines("extrinsicRotation", T_B_C[:3, :3], "1"),
            *matrix_lines("extrinsicTranslation", T_B_C[:3, 3:], "m"),
            f"td: {td!r}  # t_imu = t_image + td [s]",
            "estimate_td: 0"]


def second_camera_lines(camera, T_B_C):
    calibration = [line if line.startswith((" ", "#")) else "cam1_" + line
                   for line in camera_lines(camera)]
    return ["# The right camera, in the IMU frame as well.", "num_of_cam: 2",
            f'image1_topic: "{camera.text("rostopic")}"', *calibration,
            *matrix_lines("body_T_cam1", T_B_C, "m")]


def convert(camchain_file, imu_file, camera_name, second_name):
    """Returns the configuration as text; raises KalibrError."""
    chain = read_section(camchain_file)
    camera = chain.section(camera_name)
    imu = Imu(imu_file)
    T_I_B = imu.pose()
    names = f"{camera_name} and {second_name}" if second_name else camera_name
    paragraphs = [
        ["%YAML:1.0",
         f"# {names} of {os.path.basename(camchain_file)}, IMU of"
         f" {os.path.basename(imu_file)}; by kalibr_to_config.py.",
         "# Every key with unit, range and default: reference.yaml."],
        [f'image_topic: "{camera.text("rostopic")}"', f'imu_topic: "{imu.topic()}"'],
        camera_lines(camera),
        extrinsic_lines(T_I_B @ camera_in_imu(chain, camera_name), imu.time_offset_of(camera))]
    if second_name:
        paragraphs.append(second_camera_lines(chain.section(second_name),
                                              T_I_B @ camera_in_imu(chain, second_name)))
    paragraphs += [imu.noise_lines(), imu.correction_lines()]
    return "\n\n".join("\n".join(lines) for lines in paragraphs if lines) + "\n"


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("camchain", help="camchain-imucam-*.yaml of kalibr_calibrate_imu_camera, or"
                        " kalibr_imucam_chain.yaml of OpenVINS")
    parser.add_argument("imu", help="imu-*.yaml of Kalibr, the imu.yaml given to it, or"
                        " kalibr_imu_chain.yaml of OpenVINS")
    parser.add_argument("--cam", default="cam0", help="camera of the chain (default: cam0)")
    parser.add_argument("--second", metavar="CAM", help="the right camera of a pair: adds the keys"
                        " of num_of_cam: 2 (default: none)")
    parser.add_argument("--output", metavar="FILE", help="new file (default: standard output)")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        text = convert(options.camchain, options.imu, options.cam, options.second)
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
