#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Converts the results of Kalibr to a configuration of one to four cameras and one IMU.

Format of the inputs: https://github.com/ethz-asl/kalibr/wiki/yaml-formats
The files of OpenVINS, kalibr_imucam_chain.yaml and kalibr_imu_chain.yaml, have it as well.
"""

import argparse
import os
import re
import sys

from kalibr.cameras import camera_lines
from kalibr.imu import Imu
from kalibr.mounting import camera_in_imu, matrix_lines
from kalibr.sections import KalibrError, read_section

MAX_CAMERAS = 4
MAX_TIME_DIFFERENCE = 1e-3  # between cameras that are triggered together [s]
MAX_TD = 0.1  # of camera and IMU that are stamped by one clock [s]


def extrinsic_lines(T_B_C, td):
    return ["# Camera in the IMU frame, T_B_C.", "estimate_extrinsic: 0",
            *matrix_lines("extrinsicRotation", T_B_C[:3, :3], "1"),
            *matrix_lines("extrinsicTranslation", T_B_C[:3, 3:], "m"),
            f"td: {td!r}  # t_imu = t_image + td [s]",
            "estimate_td: 0"]


def further_camera_lines(number, camera, T_B_C):
    prefix = f"cam{number}_"
    calibration = [line if line.startswith((" ", "#")) else prefix + line
                   for line in camera_lines(camera)]
    return [f'image{number}_topic: "{camera.text("rostopic")}"', *calibration,
            *matrix_lines(f"body_T_cam{number}", T_B_C, "m")]


def warnings_of(chain, imu, names):
    """Returns what a conversion leaves out, and what is implausible."""
    others = [key for key in chain.values if re.fullmatch(r"cam\d+", str(key)) and key not in names]
    warnings = []
    if others:
        warnings.append(f"{chain.file}: {', '.join(others)} not converted; --cam"
                        f" {' '.join([*names, *others])} does that")
    offsets = {name: imu.time_offset_of(chain.section(name)) for name in names}
    if abs(offsets[names[0]]) > MAX_TD:
        warnings.append(f"{chain.file}: td of {names[0]} is {offsets[names[0]]:.3g} s by"
                        " timeshift_cam_imu, which is implausible: camera and IMU must be stamped"
                        " by one clock; correct the stamps and calibrate anew")
    for name in names[1:]:
        later = offsets[name] - offsets[names[0]]
        if abs(later) > MAX_TIME_DIFFERENCE:
            warnings.append(f"{chain.file}: {name}.timeshift_cam_imu differs from that of"
                            f" {names[0]} by {1e3 * later:.3g} ms, which is not converted: cameras"
                            " must be triggered together")
    return warnings


def convert(camchain_file, imu_file, camera_names):
    """Returns the configuration as text, and warnings; raises KalibrError."""
    chain = read_section(camchain_file, "relative_config_imucam")
    if len(camera_names) > MAX_CAMERAS:
        raise KalibrError(f"--cam: {len(camera_names)} cameras; at most {MAX_CAMERAS} are"
                          " supported")
    first, *others = camera_names
    camera = chain.section(first)
    imu = Imu(imu_file)
    T_I_B = imu.pose()
    paragraphs = [
        ["%YAML:1.0",
         f"# {', '.join(camera_names)} of {os.path.basename(camchain_file)}, IMU of"
         f" {os.path.basename(imu_file)}; by kalibr_to_config.py.",
         "# Every key with unit, range and default: reference.yaml."],
        [f"num_of_cam: {len(camera_names)}", f'image_topic: "{camera.text("rostopic")}"',
         f'imu_topic: "{imu.topic()}"'],
        camera_lines(camera),
        extrinsic_lines(T_I_B @ camera_in_imu(chain, first), imu.time_offset_of(camera))]
    for number, name in enumerate(others, start=1):
        paragraphs.append(further_camera_lines(number, chain.section(name),
                                               T_I_B @ camera_in_imu(chain, name)))
    paragraphs += [imu.noise_lines(), imu.correction_lines()]
    text = "\n\n".join("\n".join(lines) for lines in paragraphs if lines) + "\n"
    return text, warnings_of(chain, imu, camera_names)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("camchain", help="camchain-imucam-*.yaml of kalibr_calibrate_imu_camera, or"
                        " kalibr_imucam_chain.yaml or estimator_config.yaml of OpenVINS")
    parser.add_argument("imu", help="imu-*.yaml of Kalibr, the imu.yaml given to it, or"
                        " kalibr_imu_chain.yaml or estimator_config.yaml of OpenVINS")
    parser.add_argument("--cam", nargs="+", default=["cam0"], help="cameras of the chain, by number"
                        " (default: cam0)")
    parser.add_argument("--output", metavar="FILE", help="new file (default: standard output)")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        text, warnings = convert(options.camchain, options.imu, options.cam)
        for warning in warnings:
            print(f"kalibr_to_config.py: warning: {warning}", file=sys.stderr)
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
