# SPDX-License-Identifier: BSD-3-Clause
"""The IMU of Kalibr and OpenVINS as lines of a configuration."""

import numpy as np

from .mounting import matrix_lines
from .sections import read_section

NOISE = {"acc_n": ("accelerometer_noise_density", "m/s^2/sqrt(Hz)"),
         "gyr_n": ("gyroscope_noise_density", "rad/s/sqrt(Hz)"),
         "acc_w": ("accelerometer_random_walk", "m/s^3/sqrt(Hz)"),
         "gyr_w": ("gyroscope_random_walk", "rad/s^2/sqrt(Hz)")}
MODELS = ("calibrated", "kalibr", "rpng", "scale-misalignment")
SCALE_RANGE = (0.5, 2.0)  # what the configuration reader accepts


class Imu:
    """The whole file as given to Kalibr, or imu0 in the file that Kalibr writes."""

    def __init__(self, file):
        self._values = read_section(file, "relative_config_imu")
        if "imu0" in self._values.values:
            self._values = self._values.section("imu0")
        model = self._values.values.get("model", "calibrated")
        if model not in MODELS:
            raise self._values.error("model", f"{model} is not supported; calibrate with calibrated"
                                     " or scale-misalignment")

    def topic(self):
        return self._values.text("rostopic")

    def pose(self):
        """Returns T_I_B, from the frame that the cameras are given in to that of the sensor."""
        return self._values.transform("T_i_b") if "T_i_b" in self._values.values else np.eye(4)

    def time_offset_of(self, camera):
        """Returns td. Kalibr's times: t = t_cam + timeshift_cam_imu = t_imu + time_offset."""
        td = 0.0
        if "timeshift_cam_imu" in camera.values:
            td += camera.number("timeshift_cam_imu")
        if "time_offset" in self._values.values:
            td -= self._values.number("time_offset")
        return td

    def noise_lines(self):
        lines = ["# Densities as given to Kalibr. What flight shows beyond is learned:"
                 " docs/tuning.md.", "imu_noise_model: continuous"]
        for name, (key, unit) in NOISE.items():
            value = self._values.number(key)
            if value <= 0:
                raise self._values.error(key, "must be positive")
            lines.append(f"{name}: {value!r}  # [{unit}]")
        if "update_rate" in self._values.values:
            lines.append(f"imu_rate: {self._values.number('update_rate')!r}  # [Hz]")
        return lines

    def correction_lines(self):
        """Returns the corrections of the readings as lines; none if all are identities.

        A reading of the accelerometer is M a or Ta R_IMUtoACC a, one of the gyro is
        M C_gyro_i w + A a or Tw R_IMUtoGYRO w + Tg a, where a and w are along the axes of the IMU.
        """
        values = self._values
        if values.values.get("model") == "scale-misalignment":
            gyro, accel = values.section("gyroscopes"), values.section("accelerometers")
            _refuse_g_sensitivity(gyro, "A")
            corrections = {"acc_correction": _correction(accel, "M", None),
                           "gyr_correction": _correction(gyro, "M", "C_gyro_i")}
        else:
            _refuse_g_sensitivity(values, "Tg")
            corrections = {"acc_correction": _correction(values, "Ta", "R_IMUtoACC"),
                           "gyr_correction": _correction(values, "Tw", "R_IMUtoGYRO")}
        lines = []
        for key, matrix in corrections.items():
            if not np.array_equal(matrix, np.eye(3)):
                lines += matrix_lines(key, matrix, "1")
        return ["# Corrected reading = matrix * reading.", *lines] if lines else []


def _refuse_g_sensitivity(section, key):
    if key in section.values and section.matrix(key, 3).any():
        raise section.error(key, "g-sensitivity of the gyro is not supported; calibrate without"
                            " it, or set it to zeros")


def _correction(section, scale_key, rotation_key):
    """Returns the inverse of scale matrix times rotation; a missing key is the identity."""
    matrix = np.eye(3)
    if scale_key in section.values:
        scales = np.linalg.svd(section.matrix(scale_key, 3), compute_uv=False)
        if scales.max() > SCALE_RANGE[1] or scales.min() < SCALE_RANGE[0]:
            raise section.error(scale_key, "its scale factors must be 0.5 to 2")
        matrix = np.linalg.inv(section.matrix(scale_key, 3))
    if rotation_key in section.values:
        matrix = section.rotation(rotation_key).T @ matrix
    return matrix
