# SPDX-License-Identifier: BSD-3-Clause
"""Where the cameras of a chain of Kalibr are."""

import re

import numpy as np

MAX_DISTANCE = 10  # of a camera from the IMU; the configuration reader accepts as much [m]
MAX_DIFFERENCE, MAX_ANGLE = 2e-3, 0.2  # between two statements of a transform [m], [deg]


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
        return _near(camera, "T_imu_cam", camera.transform("T_imu_cam"))
    number = re.fullmatch(r"cam([1-9]\d*)", name)
    by_chain = None
    if "T_cn_cnm1" in camera.values and number:
        previous = camera_in_imu(chain, f"cam{int(number[1]) - 1}")
        by_chain = previous @ inverse(camera.transform("T_cn_cnm1"))
        if "T_cam_imu" not in camera.values:
            return _near(camera, "T_cn_cnm1", by_chain)
    hint = "give the camchain-imucam file of kalibr_calibrate_imu_camera"
    T_B_C = _near(camera, "T_cam_imu", inverse(camera.transform("T_cam_imu", hint)))
    if by_chain is not None:
        _check_agreement(camera, T_B_C, by_chain)
    return T_B_C


def _near(camera, key, T_B_C):
    distance = np.linalg.norm(T_B_C[:3, 3])
    if distance > MAX_DISTANCE:
        raise camera.error(key, f"the camera is {distance:.4g} m from the IMU: is its translation"
                           " in mm? It must be in m")
    return T_B_C


def _check_agreement(camera, T_B_C, by_chain):
    difference = inverse(T_B_C) @ by_chain
    distance = np.linalg.norm(difference[:3, 3])
    cosine = np.clip((np.trace(difference[:3, :3]) - 1) / 2, -1, 1)
    angle = np.degrees(np.arccos(cosine))
    if distance > MAX_DIFFERENCE or angle > MAX_ANGLE:
        raise camera.error("T_cam_imu", f"contradicts T_cn_cnm1, by {1e3 * distance:.3g} mm and"
                           f" {angle:.3g} deg; correct or remove one of them")
