#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests scripts/export_colmap.py on a run with a point whose pixel is known."""

import json
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
sys.path.insert(0, SCRIPTS)
import export_colmap  # noqa: E402
from evaluation.trajectory import rotations_of  # noqa: E402

# The body is turned by 90 degrees about z, the camera in it by 90 degrees about x.
HALF = np.sqrt(0.5)
POSE = f"1 2 3 0 0 {HALF} {HALF}"
CALIBRATION = {"fx_fy_cx_cy_px": [200, 210, 160, 120], "distortion": [0, 0, 0, 0],
               "q_B_C_xyzw": [HALF, 0, 0, HALF], "p_B_C_m": [0.1, 0, 0], "td_s": 0}
POINT = "3.4 2.2 2.9"
RESTART = "# the world frame starts anew: lost\n"


class ExportColmapTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder = pathlib.Path(folder.name)
        self.write_run("PINHOLE")

    def write_run(self, model_type):
        config = {"model_type": model_type, "image_width": 320, "image_height": 240}
        summary = {"config": config, "calibration": CALIBRATION}
        self.write("summary.json", json.dumps(summary))
        self.write("trajectory.tum", f"1403636579.763555584 {POSE}\n0.050000000 {POSE}\n{RESTART}"
                                     f"0.100000000 {POSE}\n")
        self.write("map.ply", f"ply\nend_header\n{POINT}\n")

    def write(self, name, text):
        (self.run_folder / name).write_text(text, encoding="utf-8")

    def exported(self, name, *options):
        self.assertEqual(export_colmap.main([str(self.run_folder), *options]), 0)
        return (self.run_folder / "colmap" / name).read_text(encoding="utf-8").splitlines()

    def test_the_point_is_in_front_of_the_camera(self):
        _, w, x, y, z, *p, camera, name = self.exported("images.txt")[0].split()
        self.assertEqual((camera, name), ("1", "1403636579763555584.png"))
        q_C_W, p_C = np.array([[x, y, z, w]], dtype=float), np.array(p, dtype=float)
        point = self.exported("points3D.txt")[0].split()
        at = rotations_of(q_C_W)[0] @ np.array(point[1:4], dtype=float) + p_C
        # In the body (0.2, -2.4, -0.1), of which the camera is at (0.1, 0, 0) and looks along -y.
        np.testing.assert_allclose(at, [0.1, -0.1, 2.4], atol=1e-8)

    def test_the_camera_has_its_origin_at_the_corner_of_the_first_pixel(self):
        self.assertEqual(self.exported("cameras.txt"),
                         ["1 OPENCV 320 240 200 210 160.5 120.5 0 0 0 0"])

    def test_only_the_first_world_has_images_each_with_an_empty_line(self):
        lines = self.exported("images.txt")
        self.assertEqual([line.split()[-1] for line in lines[::2]],
                         ["1403636579763555584.png", "50000000.png"])
        self.assertEqual(lines[1::2], ["", ""])
        self.assertEqual(len(self.exported("images.txt", "--every", "2")), 2)

    def test_poses_of_loop_closure_come_without_points(self):
        self.write("trajectory_final.tum", f"7.000000000 {POSE}\n")
        self.assertEqual(self.exported("points3D.txt"), [])
        self.assertEqual(self.exported("images.txt")[0].split()[-1], "7000000000.png")

    def test_a_run_that_cannot_be_exported(self):
        self.write_run("MEI")
        self.assertEqual(export_colmap.main([str(self.run_folder)]), 1)
        self.assertEqual(export_colmap.main([str(self.run_folder / "missing")]), 1)


if __name__ == "__main__":
    unittest.main()
