#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a run of run_offline as a COLMAP text model: camera 0 as estimated in the end, its poses,
and the points of the map. Images are named by timestamp, as in an ASL folder. The poses are those
of trajectory_final.tum if the run has loop closure. The model then has no points, since map.ply is
that of the odometry; COLMAP's point_triangulator makes them."""

import argparse
import dataclasses
import json
import pathlib
import sys

import numpy as np

from evaluation.trajectory import RESTART, Trajectory, quaternions_of, rotations_of

MODELS = {"PINHOLE": "OPENCV", "EQUIDISTANT": "OPENCV_FISHEYE", "KANNALA_BRANDT": "OPENCV_FISHEYE"}
GRAY = "128 128 128 0"  # color, and an unknown error


def export(run, output, every):
    summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    config, calibration = summary["config"], summary["calibration"]
    if config["model_type"] not in MODELS:
        raise ValueError(f"COLMAP has no camera model for {config['model_type']}")
    final = run / "trajectory_final.tum"
    has_loops = final.is_file()
    names, poses = read_poses(final if has_loops else run / "trajectory.tum", every)
    points = [] if has_loops else read_points(run / "map.ply")
    output.mkdir(parents=True, exist_ok=True)
    write(output / "cameras.txt", [camera_line(config, calibration)])
    write(output / "images.txt", image_lines(names, camera_poses(poses, calibration)))
    write(output / "points3D.txt", [f"{number} {point} {GRAY}"
                                    for number, point in enumerate(points, start=1)])


def read_poses(path, every):
    """Returns the names of images, and the poses of the body in the first world frame. Names have
    all digits of the timestamps, which floats do not."""
    rows = []
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith(RESTART):
                break
            rows.append(line.split())
    names = [f"{int(row[0].replace('.', ''))}.png" for row in rows[::every]]
    table = np.array(rows[::every], dtype=float).reshape(-1, 8)
    return names, Trajectory(table[:, 0], table[:, 1:4], rotations_of(table[:, 4:8]))


def read_points(path):
    return path.read_text(encoding="utf-8").partition("end_header\n")[2].splitlines()


def camera_line(config, calibration):
    """COLMAP's pixel coordinates start at the corner of the first pixel, ours at its center."""
    fx, fy, cx, cy = calibration["fx_fy_cx_cy_px"]
    numbers = [config["image_width"], config["image_height"], fx, fy, cx + 0.5, cy + 0.5,
               *calibration["distortion"]]
    return f"1 {MODELS[config['model_type']]} " + " ".join(str(number) for number in numbers)


def camera_poses(body, calibration):
    """Returns the poses of the world in the camera."""
    R_B_C = rotations_of(np.array([calibration["q_B_C_xyzw"]]))[0]
    positions = body.positions + body.rotations @ np.array(calibration["p_B_C_m"])
    camera = dataclasses.replace(body, positions=positions, rotations=body.rotations @ R_B_C)
    return camera.inverse()


def image_lines(names, poses):
    """Each image is followed by an empty line, since it has no features."""
    quaternions = quaternions_of(poses.rotations)[:, [3, 0, 1, 2]]
    for number, (name, q, p) in enumerate(zip(names, quaternions, poses.positions), start=1):
        yield f"{number} " + " ".join(f"{value:.9f}" for value in (*q, *p)) + f" 1 {name}\n"


def write(path, lines):
    path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", metavar="RUN_DIR", type=pathlib.Path,
                        help="folder that run_offline wrote")
    parser.add_argument("--output", metavar="DIR", type=pathlib.Path,
                        help="folder of the model (default: RUN_DIR/colmap)")
    parser.add_argument("--every", metavar="N", type=int, default=1,
                        help="only every N-th image (default: all)")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse_arguments(arguments)
    output = options.output or options.run / "colmap"
    try:
        export(options.run, output, options.every)
    except (OSError, KeyError, TypeError, ValueError) as error:
        print(f"export_colmap.py: {options.run} cannot be exported: {error!r}", file=sys.stderr)
        return 1
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
