#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/kalibr_to_config.py on files in Kalibr's format; run_offline reads the result.

Usage: kalibr_to_config_test.py RUN_OFFLINE [unittest option ...]
"""

import copy
import functools
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import unittest

import numpy as np
import yaml

from folder_case import FolderTest, call

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import kalibr_to_config  # noqa: E402
from kalibr import radial_models  # noqa: E402

RUN_OFFLINE = sys.argv[1] if len(sys.argv) > 1 else sys.exit(__doc__)

# The IMU frame is the camera frame rotated by 90 degrees about z; the IMU is 1 m right of the
# camera, 2 m below and 3 m in front of it. So the camera is at (-2, 1, -3) in the IMU frame.
CAMERA = {
    "T_cam_imu": [[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0],
                  [0.0, 0.0, 0.0, 1.0]],
    "cam_overlaps": [],
    "camera_model": "pinhole",
    "distortion_coeffs": [-0.28, 0.07, 1e-4, 2e-5],
    "distortion_model": "radtan",
    "intrinsics": [458.5, 457.5, 367.5, 248.5],
    "resolution": [752, 480],
    "rostopic": "/left/image_raw",
    "timeshift_cam_imu": 0.0125,
}
P_B_C = [-2.0, 1.0, -3.0]
R_B_C = [0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0]  # row-major
IMU = {
    "accelerometer_noise_density": 0.002,
    "accelerometer_random_walk": 0.003,
    "gyroscope_noise_density": 0.0002,
    "gyroscope_random_walk": 2.5e-05,
    "rostopic": "/imu/data",
    "update_rate": 400.0,
}


def edited(values, **changes):
    """Returns a copy with other values; None removes a key."""
    result = copy.deepcopy(values)
    result.update(changes)
    return {key: value for key, value in result.items() if value is not None}


def named(names, values):
    """Returns the values by their names in the configuration."""
    return dict(zip(names.split(), values))


def run(*command):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, encoding="utf-8", check=False)


class Kalibr(FolderTest):
    def convert(self, *options, chain=None, imu=None):
        """Runs the script on a camera chain and an IMU, given as maps."""
        return call(kalibr_to_config.main,
                    self.write("chain.yaml", yaml.safe_dump(chain or {"cam0": CAMERA})),
                    self.write("imu.yaml", yaml.safe_dump(imu or IMU)), *options)

    def load(self, **inputs):
        """Returns the configuration as read by run_offline, from a recording without readable
        images."""
        config = self.path("config.yaml")
        result = self.convert("--output", config, *inputs.pop("options", []), **inputs)
        self.assertEqual(result.returncode, 0, result.stderr)
        for camera in ("cam0", "cam1", "cam2", "cam3"):
            self.write(f"asl/{camera}/data.csv", "100000000,missing.png\n")
        self.write("asl/imu0/data.csv", "100000000,0,0,0,0,0,9.81\n200000000,0,0,0,0,0,9.81\n")
        result = run(RUN_OFFLINE, "--config", config, "--asl", self.path("asl"), "--output",
                     self.path("results"))
        self.assertIn("no trajectory", result.stderr)
        summary = pathlib.Path(self.path("results", "summary.json")).read_text(encoding="utf-8")
        return json.loads(summary)["config"]

    def assert_all_close(self, values, expected):
        self.assertEqual(len(values), len(expected))
        for value, wanted in zip(values, expected):
            self.assertAlmostEqual(value, wanted, 12)


class RoundTrip(Kalibr):
    def test_pinhole_radtan(self):
        sensor = self.load()
        self.assertEqual(sensor["image_topic"], "/left/image_raw")
        self.assertEqual(sensor["imu_topic"], "/imu/data")
        self.assertEqual(sensor["model_type"], "PINHOLE")
        self.assertEqual((sensor["image_width"], sensor["image_height"]), (752, 480))
        self.assertEqual(sensor["projection_parameters"],
                         named("fx fy cx cy", CAMERA["intrinsics"]))
        self.assertEqual(sensor["distortion_parameters"],
                         named("k1 k2 p1 p2", CAMERA["distortion_coeffs"]))
        self.assert_all_close(sensor["extrinsicTranslation"], P_B_C)
        self.assert_all_close(sensor["extrinsicRotation"], R_B_C)
        self.assertEqual(sensor["td"], 0.0125)
        self.assertEqual((sensor["estimate_extrinsic"], sensor["estimate_td"]), (0, False))
        self.assertEqual(sensor["imu_rate"], 400)
        for key, value in {"acc_n": 0.002, "gyr_n": 0.0002, "acc_w": 0.003,
                           "gyr_w": 2.5e-05}.items():
            self.assertEqual(sensor[key], value)

    def test_pinhole_equidistant(self):
        coefficients = [0.0035, 0.0007, -0.0021, 0.0002]
        camera = self.load(chain={"cam0": edited(
            CAMERA, distortion_model="equidistant", distortion_coeffs=coefficients)})
        self.assertEqual(camera["model_type"], "EQUIDISTANT")
        self.assertEqual(camera["projection_parameters"],
                         named("fx fy cx cy", CAMERA["intrinsics"]))
        self.assertEqual(camera["distortion_parameters"], named("k1 k2 k3 k4", coefficients))

    def test_omni_radtan(self):
        camera = self.load(chain={"cam0": edited(
            CAMERA, camera_model="omni", intrinsics=[0.9, 833.0, 830.0, 373.0, 253.0])})
        self.assertEqual(camera["model_type"], "MEI")
        self.assertEqual(camera["mirror_parameters"], {"xi": 0.9})
        self.assertEqual(camera["projection_parameters"],
                         named("gamma1 gamma2 u0 v0", [833.0, 830.0, 373.0, 253.0]))
        self.assertEqual(camera["distortion_parameters"],
                         named("k1 k2 p1 p2", CAMERA["distortion_coeffs"]))

    def test_no_distortion_and_no_time_shift(self):
        sensor = self.load(chain={"cam0": edited(CAMERA, distortion_model="none",
                                                 distortion_coeffs=[], timeshift_cam_imu=None)})
        self.assertEqual(sensor["distortion_parameters"], named("k1 k2 p1 p2", [0, 0, 0, 0]))
        self.assertEqual(sensor["td"], 0)

    def test_second_camera_and_the_imu_file_that_kalibr_writes(self):
        chain = {"cam0": CAMERA, "cam1": edited(CAMERA, rostopic="/right/image_raw")}
        imu = {"imu0": edited(IMU, model="calibrated", time_offset=0.0)}
        sensor = self.load(chain=chain, imu=imu, options=["--cam", "cam1"])
        self.assertEqual(sensor["image_topic"], "/right/image_raw")
        self.assertEqual(sensor["imu_topic"], "/imu/data")

    def test_files_of_openvins(self):
        T_imu_cam = [[0.0, 1.0, 0.0, -2.0], [-1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, -3.0],
                     [0.0, 0.0, 0.0, 1.0]]
        sensor = self.load(chain={"cam0": edited(CAMERA, T_cam_imu=None, T_imu_cam=T_imu_cam)},
                           imu={"imu0": edited(IMU, model="kalibr", time_offset=0.0)})
        self.assert_all_close(sensor["extrinsicTranslation"], P_B_C)
        self.assert_all_close(sensor["extrinsicRotation"], R_B_C)

    def test_an_imu_that_is_not_where_the_body_is(self):
        """The sensor is turned by 90 degrees about z, and moved by (1, 2, 3); its stamps are 50 ms
        early."""
        T_i_b = [[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0],
                 [0.0, 0.0, 0.0, 1.0]]
        sensor = self.load(imu={"imu0": edited(IMU, T_i_b=T_i_b, time_offset=0.05)})
        self.assert_all_close(sensor["extrinsicTranslation"], [0, 0, 0])
        self.assert_all_close(sensor["extrinsicRotation"], [1, 0, 0, 0, 1, 0, 0, 0, 1])
        self.assertAlmostEqual(sensor["td"], 0.0125 - 0.05)

    def test_intrinsics_of_an_imu_of_openvins(self):
        """A gyro of scale 2 whose axes are turned by 90 degrees reads (2 y, -2 x, 2 z) of a rate
        (x, y, z); the accelerometer's z axis is too long and takes some of y."""
        sensor = self.load(imu={"imu0": edited(
            IMU, model="kalibr", Tw=[[2, 0, 0], [0, 2, 0], [0, 0, 2]],
            R_IMUtoGYRO=[[0, 1, 0], [-1, 0, 0], [0, 0, 1]],
            Ta=[[1, 0, 0], [0, 1, 0], [0, 0.5, 1.25]], Tg=[[0.0] * 3] * 3)})
        self.assert_all_close(sensor["gyr_correction"], [0, -0.5, 0, 0.5, 0, 0, 0, 0, 0.5])
        self.assert_all_close(sensor["acc_correction"], [1, 0, 0, 0, 1, 0, 0, -0.4, 0.8])

    def test_intrinsics_of_an_imu_of_kalibr(self):
        sensor = self.load(imu={"imu0": edited(
            IMU, model="scale-misalignment",
            gyroscopes={"M": [[2, 0, 0], [0, 2, 0], [0, 0, 2]], "A": [[0.0] * 3] * 3,
                        "C_gyro_i": [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]},
            accelerometers={"M": [[1, 0, 0], [0, 1, 0], [0, 0.5, 1.25]]})})
        self.assert_all_close(sensor["gyr_correction"], [0, -0.5, 0, 0.5, 0, 0, 0, 0, 0.5])
        self.assert_all_close(sensor["acc_correction"], [1, 0, 0, 0, 1, 0, 0, -0.4, 0.8])

    def test_rig_of_four_cameras(self):
        """Each camera is 0.1 m to the right of the previous one; the second has another lens."""
        T_cn_cnm1 = [[1.0, 0.0, 0.0, -0.1], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0],
                     [0.0, 0.0, 0.0, 1.0]]
        coefficients = [0.1, 0.2, 0.3, 0.4]
        chain = {"cam0": CAMERA}
        for number in (1, 2, 3):
            chain[f"cam{number}"] = edited(CAMERA, rostopic=f"/cam{number}", T_cam_imu=None,
                                           T_cn_cnm1=T_cn_cnm1)
        chain["cam1"].update(distortion_model="equidistant", distortion_coeffs=coefficients)
        sensor = self.load(chain=chain, options=["--cam", *chain])
        self.assertEqual(sensor["num_of_cam"], 4)
        self.assertEqual(sensor["image_topic"], "/left/image_raw")
        self.assertEqual(sensor["image3_topic"], "/cam3")
        self.assertEqual(sensor["cam1_model_type"], "EQUIDISTANT")
        self.assertEqual(sensor["cam1_distortion_parameters"], named("k1 k2 k3 k4", coefficients))
        self.assertEqual(sensor["cam1_projection_parameters"],
                         named("fx fy cx cy", CAMERA["intrinsics"]))
        self.assertEqual(sensor["cam3_model_type"], sensor["model_type"])
        for camera, y in (("cam1", 0.9), ("cam3", 0.7)):
            self.assert_all_close(sensor[f"body_T_{camera}"], [0, 1, 0, -2, -1, 0, 0, y, 0, 0, 1,
                                                               -3, 0, 0, 0, 1])
        self.assert_all_close(sensor["extrinsicTranslation"], P_B_C)

    def test_numbers_that_yaml_takes_for_text(self):
        imu = self.write("imu.yaml", "accelerometer_noise_density: 2e-3\n"
                         "accelerometer_random_walk: 3e-3\ngyroscope_noise_density: 2e-4\n"
                         "gyroscope_random_walk: 2e-5\nrostopic: /imu\n")
        chain = self.write("chain.yaml", "%YAML:1.0\n" + yaml.safe_dump({"cam0": CAMERA}))
        result = call(kalibr_to_config.main, chain, imu)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(yaml.safe_load(result.stdout.split("imu_noise_model")[1].partition(
            "\n")[2]), {"acc_n": 0.002, "gyr_n": 0.0002, "acc_w": 0.003, "gyr_w": "2e-05"})


def ray(theta, phi):
    return np.array([math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi),
                     math.cos(theta)])


def equidistant_pixel(camera, theta, phi):
    """Returns the pixel of a ray by the model of docs/references.md [Kannala2006]."""
    k = [camera["distortion_parameters"][name] for name in ("k1", "k2", "k3", "k4")]
    fx, fy, cx, cy = (camera["projection_parameters"][name] for name in ("fx", "fy", "cx", "cy"))
    radius = theta * (1 + sum(k[i] * theta ** (2 * i + 2) for i in range(4)))
    return np.array([fx * radius * math.cos(phi) + cx, fy * radius * math.sin(phi) + cy])


def double_sphere_pixel(x, y, z, xi, alpha):
    first = math.sqrt(x * x + y * y + z * z)
    second = math.sqrt(x * x + y * y + (xi * first + z) ** 2)
    return np.array([x, y]) / (alpha * second + (1 - alpha) * (xi * first + z))


def extended_unified_pixel(x, y, z, alpha, beta):
    return np.array([x, y]) / (alpha * math.sqrt(beta * (x * x + y * y) + z * z) + (1 - alpha) * z)


def field_of_view_pixel(x, y, z, w):
    radius = math.hypot(x, y) / z
    return np.array([x, y]) / z / radius * math.atan(2 * radius * math.tan(w / 2)) / w


class Fitted(Kalibr):
    """Tests lens models that are approximated by the equidistant one: pixels agree in the whole
    image."""

    FOCAL, CENTRE = np.array([310.0, 306.0]), np.array([340.5, 251.5])
    CORNER = math.hypot((751 - 340.5) / 310.0, 251.5 / 306.0)  # farthest corner, in focal lengths

    def assert_fits(self, pixel, values, **changes):
        """Expects agreement with `pixel`, the lens's projection of a ray with `values`, in focal
        lengths."""
        intrinsics = changes.pop("before", []) + [*self.FOCAL.tolist(), *self.CENTRE.tolist()]
        chain = {"cam0": edited(CAMERA, intrinsics=intrinsics, **changes)}
        text = self.convert(chain=chain).stdout
        stated = re.search(r"errors of at most (\S+) px up to (\S+) deg from the axis", text)
        angle = math.radians(float(stated.group(2)))
        self.assertAlmostEqual(np.linalg.norm(pixel(*ray(angle, 0.3), *values)), self.CORNER, 2)
        camera = self.load(chain=chain)
        self.assertEqual(camera["model_type"], "EQUIDISTANT")
        errors = []
        for theta in np.linspace(0.01, angle - 1e-3, 60):
            for phi in np.linspace(0, 2 * math.pi, 13):
                true_pixel = self.FOCAL * pixel(*ray(theta, phi), *values) + self.CENTRE
                errors.append(np.linalg.norm(equidistant_pixel(camera, theta, phi) - true_pixel))
        self.assertLess(max(errors), 1.02 * float(stated.group(1)) + 1e-9)
        self.assertGreater(max(errors), 0.5 * float(stated.group(1)))
        self.assertLess(max(errors), 0.05)

    def test_double_sphere(self):
        values = [-0.24, 0.56]
        self.assert_fits(double_sphere_pixel, values, camera_model="ds", before=values,
                         distortion_model="none", distortion_coeffs=[])

    def test_extended_unified(self):
        values = [0.59, 1.12]
        self.assert_fits(extended_unified_pixel, values, camera_model="eucm", before=values,
                         distortion_model="none", distortion_coeffs=[])

    def test_field_of_view(self):
        self.assert_fits(field_of_view_pixel, [0.93], distortion_model="fov",
                         distortion_coeffs=[0.93])

    def test_rays_from_behind_do_not_count(self):
        lens = functools.partial(radial_models.ds, xi=-0.27, alpha=0.57)
        self.assertAlmostEqual(math.degrees(radial_models.fit_equidistant(lens, 9.0).angle), 89.9)
        self.assertIsNone(radial_models.fit_equidistant(lambda theta: math.nan * theta, 1.0))


class BadInput(Kalibr):
    def assert_refused(self, file, key, problem, **inputs):
        """Expects one line on stderr with the file, the key and the problem; nothing is written."""
        output = self.path("config.yaml")
        result = self.convert("--output", output, *inputs.pop("options", []), **inputs)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(f"{self.path(file)}: {key}: ", result.stderr)
        self.assertIn(problem, result.stderr)
        self.assertFalse(os.path.exists(output))

    def assert_camera_refused(self, key, problem, **changes):
        self.assert_refused("chain.yaml", "cam0." + key, problem,
                            chain={"cam0": edited(CAMERA, **changes)})

    def test_unsupported_models(self):
        for model, distortion in (("omni", "fov"), ("eucm", "radtan"), ("ds", "equidistant"),
                                  ("omni", "equidistant"), ("pinhole-rs", "radtan")):
            self.assert_camera_refused("camera_model", f"{model}-{distortion} is not supported",
                                       camera_model=model, distortion_model=distortion)
        self.assert_camera_refused("line_delay", "rolling-shutter", line_delay=3e-5)
        self.assert_refused("imu.yaml", "imu0.model", "size-effect is not supported",
                            imu={"imu0": edited(IMU, model="scale-misalignment-size-effect")})

    def test_intrinsics_of_an_imu(self):
        one = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
        for key, value, problem in (
                ("Tg", [[0, 0, 1e-3], [0, 0, 0], [0, 0, 0]], "g-sensitivity of the gyro"),
                ("Tw", [[0.1, 0, 0], [0, 1, 0], [0, 0, 1]], "scale factors must be 0.5 to 2"),
                ("Ta", [[1, 0, 0]], "must have 3 rows"),
                ("R_IMUtoGYRO", [[1, 0, 0], [0, 1, 0], [0, 0, -1]], "is not a rotation"),
                ("T_i_b", one, "must have 4 rows"), ("time_offset", "x", "must be a number")):
            self.assert_refused("imu.yaml", f"imu0.{key}", problem,
                                imu={"imu0": edited(IMU, **{key: value})})
        self.assert_refused("imu.yaml", "imu0.gyroscopes.A", "g-sensitivity of the gyro", imu={
            "imu0": edited(IMU, model="scale-misalignment", accelerometers={"M": one},
                           gyroscopes={"M": one, "A": one})})

    def test_lenses_that_no_equidistant_model_fits(self):
        self.assert_camera_refused("camera_model", "nearest to this pinhole-fov camera is off by up"
                                   " to 0.98 px, of which 0.05 are allowed; calibrate with"
                                   " pinhole-equi", distortion_model="fov",
                                   distortion_coeffs=[1.5])

    def test_parameters_out_of_range(self):
        self.assert_camera_refused("distortion_coeffs", "w must be from 1e-06 to 3.14, not 0",
                                   distortion_model="fov", distortion_coeffs=[0.0])
        for model, first, second, problem in (
                ("ds", -0.2, 1.5, "alpha must be from 0 to 1, not 1.5"),
                ("eucm", 0.5, 0.0, "beta must be from 1e-06 to inf, not 0.0")):
            self.assert_camera_refused(
                "intrinsics", problem, camera_model=model, distortion_model="none",
                distortion_coeffs=[], intrinsics=[first, second, 300.0, 300.0, 376.0, 240.0])
        self.assert_camera_refused("intrinsics", "focal lengths", distortion_model="fov",
                                   distortion_coeffs=[0.9], intrinsics=[300.0, 0.0, 376.0, 240.0])
        self.assert_camera_refused("intrinsics", "a list of 6 numbers", camera_model="ds",
                                   distortion_model="none", distortion_coeffs=[])

    def test_missing_keys(self):
        self.assert_camera_refused("T_cam_imu", "camchain-imucam", T_cam_imu=None)
        self.assert_camera_refused("intrinsics", "is missing", intrinsics=None)
        self.assert_refused("imu.yaml", "gyroscope_random_walk", "is missing",
                            imu=edited(IMU, gyroscope_random_walk=None))
        self.assert_refused("chain.yaml", "cam1", "there is cam0", options=["--cam", "cam1"])

    def test_five_cameras(self):
        result = self.convert("--cam", *["cam0"] * 5)
        self.assertEqual(result.returncode, 1)
        self.assertIn("--cam: 5 cameras; at most 4 are supported", result.stderr)

    def test_bad_values(self):
        self.assert_camera_refused("intrinsics", "a list of 4 numbers", intrinsics=[1.0, 2.0])
        self.assert_camera_refused("intrinsics", "'x'", intrinsics=["x", 1.0, 2.0, 3.0])
        self.assert_camera_refused("resolution", "a list of 2 numbers", resolution=752)
        self.assert_camera_refused("distortion_coeffs", "nan",
                                   distortion_coeffs=[0.1, math.nan, 0.0, 0.0])
        self.assert_camera_refused("rostopic", "must be a name", rostopic=5)
        self.assert_refused("imu.yaml", "accelerometer_random_walk", "must be positive",
                            imu=edited(IMU, accelerometer_random_walk=0))
        self.assert_refused("chain.yaml", "cam0", "must be a mapping", chain={"cam0": [1, 2]})

    def test_bad_transforms(self):
        def rows(*changes):
            matrix = copy.deepcopy(CAMERA["T_cam_imu"])
            for row, column, value in changes:
                matrix[row][column] = value
            return matrix

        self.assert_camera_refused("T_cam_imu", "must have 4 rows", T_cam_imu=rows()[:3])
        self.assert_camera_refused("T_cam_imu", "4 numbers", T_cam_imu=[[1, 0, 0]] * 4)
        self.assert_camera_refused("T_cam_imu", "not a rotation", T_cam_imu=rows((2, 2, -1.0)))
        self.assert_camera_refused("T_cam_imu", "not a rotation", T_cam_imu=rows((2, 2, 1.01)))
        self.assert_camera_refused("T_cam_imu", "last row", T_cam_imu=rows((3, 0, 1.0)))

    def test_files(self):
        imu = self.write("imu.yaml", yaml.safe_dump(IMU))
        for text, problem in (("cam0: [", "is not YAML"), ("", "must be a mapping"),
                              ("[1, 2]", "must be a mapping")):
            result = call(kalibr_to_config.main, self.write("bad.yaml", text), imu)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)
            self.assertIn(f"bad.yaml: {problem}", result.stderr)
        result = call(kalibr_to_config.main, self.path("none.yaml"), imu)
        self.assertIn("none.yaml: No such file", result.stderr)

    def test_an_existing_output_is_kept(self):
        output = pathlib.Path(self.write("mine.yaml", "precious"))
        result = self.convert("--output", output)
        self.assertEqual(result.returncode, 1)
        self.assertIn("mine.yaml: File exists", result.stderr)
        self.assertEqual(output.read_text(encoding="utf-8"), "precious")


class Contradictions(Kalibr):
    def chain(self, **changes):
        """Returns two cameras, the second one 0.1 m beside the first, as both keys state."""
        beside = [[1, 0, 0, -0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
        T_cam_imu = (np.array(beside) @ np.array(CAMERA["T_cam_imu"])).tolist()
        second = edited(CAMERA, rostopic="/right/image_raw", T_cam_imu=T_cam_imu, T_cn_cnm1=beside)
        return {"cam0": CAMERA, "cam1": edited(second, **changes)}

    def assert_refused(self, text, **inputs):
        result = self.convert("--cam", "cam0", "cam1", **inputs)
        self.assertEqual(result.returncode, 1)
        self.assertIn(text, result.stderr)

    def test_two_statements_that_agree(self):
        result = self.convert("--cam", "cam0", "cam1", chain=self.chain())
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_two_statements_that_do_not(self):
        turned = [[1, 0, 0, -0.12], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
        self.assert_refused("T_cam_imu: contradicts T_cn_cnm1, by 20 mm and 0 deg",
                            chain=self.chain(T_cn_cnm1=turned))

    def test_millimeters(self):
        T_cam_imu = np.array(CAMERA["T_cam_imu"])
        T_cam_imu[:3, 3] *= 1000
        self.assert_refused("is its translation in mm", chain=self.chain(
            T_cam_imu=T_cam_imu.tolist(), T_cn_cnm1=None))

    def test_what_is_not_converted_is_said(self):
        chain = self.chain(timeshift_cam_imu=0.0175)
        self.assertIn("cam1 not converted; --cam cam0 cam1", self.convert(chain=chain).stderr)
        result = self.convert("--cam", "cam0", "cam1", chain=chain)
        self.assertEqual(result.returncode, 0)
        self.assertIn("cam1.timeshift_cam_imu differs from that of cam0 by 5 ms", result.stderr)

    def test_implausible_time_shift(self):
        self.assertEqual(self.convert().stderr, "")
        result = self.convert(chain={"cam0": edited(CAMERA, timeshift_cam_imu=1.45)})
        self.assertEqual(result.returncode, 0)
        self.assertIn("td of cam0 is 1.45 s by timeshift_cam_imu", result.stderr)

    def test_plumb_bob_of_ros_has_five_coefficients(self):
        five = edited(CAMERA, distortion_model="plumb_bob",
                      distortion_coeffs=[*CAMERA["distortion_coeffs"], 0.0])
        self.assertEqual(self.convert(chain={"cam0": five}).stdout, self.convert().stdout)
        five["distortion_coeffs"][4] = 0.01
        self.assertIn("the fifth, k3 = 0.01", self.convert(chain={"cam0": five}).stderr)

    def test_estimator_config_of_openvins_leads_to_its_calibration(self):
        expected = self.convert().stdout
        names = {"relative_config_imucam": "chain.yaml", "relative_config_imu": "imu.yaml"}
        config = self.write("estimator_config.yaml", "%YAML:1.0\n\n" + yaml.safe_dump(names))
        result = call(kalibr_to_config.main, config, config)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.splitlines()[2:], expected.splitlines()[2:])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
