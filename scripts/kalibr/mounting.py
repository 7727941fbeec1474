# SPDX-License-Identifier: BSD-3-Clause
"""Where the cameras of a chain of Kalibr are."""

import re

import numpy as np


def matrix_lines(key, matrix, unit):
    """Returns a matrix in OpenCV's notation."""
    rows = [", ".join(repr(float(value)) for value in row) for row in matrix]
    return [f"{key}: !!opencv-matrix  # [{unit}]", f"   rows: {len(matrix)}",
            f"   cols: {len(matrix[0])}", "   dt: d",
            "   data: [" + ",\n          ".join(rows) + "]"]


def inverse(transform):
    """Returns the inverse of a rigid transform."""
    result = np.eye(4)
    result[:3, :3] = transform[:3, :3].T
    result[:3, 3] = -transform[:3, :3].T @ transform[:3, 3]
    return result


def camera_in_imu(chain, name):
    """Returns T_B_C, where B is the frame of the chain's IMU.

    Kalibr gives p_C = T_cam_imu p_B or, for a camera after the first, p_Cn = T_cn_cnm1 p_Cn-1;
    OpenVINS gives p_B = T_imu_cam p_C.
    """
    camera = chain.section(name)
    if "T_imu_cam" in camera.values:
        return camera.transform("T_imu_cam")
    number = re.fullmatch(r"cam([1-9]\d*)", name)
    if "T_cam_imu" not in camera.values and "T_cn_cnm1" in camera.values and number:
        previous = camera_in_imu(chain, f"cam{int(number[1]) - 1}")
        return previous @ inverse(camera.transform("T_cn_cnm1"))
    hint = "give the camchain-imucam file of kalibr_calibrate_imu_camera"
    return inverse(camera.transform("T_cam_imu", hint))
