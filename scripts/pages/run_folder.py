# SPDX-License-Identifier: BSD-3-Clause
"""The files of run_offline in a result folder, as arrays."""

import csv
import glob
import json
import os
import re
from dataclasses import dataclass, field
from typing import Dict

import numpy as np

from evaluation.loops import Loops, read_loops
from evaluation.run_results import read_estimate
from evaluation.trajectory import Trajectory, TrajectoryError

TRAJECTORY = "trajectory.tum"
# Categories of the edges in lines.ply, by their color there.
LINE_COLORS = {(220, 40, 40): "along x", (40, 160, 40): "along y", (50, 90, 230): "along z"}
FREE = "free"
NO_LOOPS = Loops(np.empty(0), np.empty(0), np.empty((0, 3)), np.empty(0))


@dataclass
class RunFolder:
    """The results of a run. Coordinates are in the world of the estimate [m]."""

    path: str
    summary: dict
    trajectory: Trajectory  # in IMU time, like the loops
    frames: Dict[str, np.ndarray]  # the columns of timing.csv
    points: np.ndarray  # (n, 3)
    lines: Dict[str, np.ndarray]  # (n, 2, 3) endpoints, by Manhattan axis
    loops: Loops  # between poses of the trajectory
    loops_left_out: int  # number of loops to poses of an earlier map
    images: Dict[str, str] = field(default_factory=dict)  # files with tracks, by caption

    @classmethod
    def read(cls, path):
        """Raises TrajectoryError if trajectory, summary or timing is missing, or any file is
        damaged."""
        try:
            with open(os.path.join(path, "summary.json"), encoding="utf-8") as file:
                summary = dict(json.load(file))
            frames = _read_columns(os.path.join(path, "timing.csv"))
        except (OSError, TypeError, ValueError) as error:
            raise TrajectoryError(f"{path}: not the folder of a finished run ({error})") from None
        trajectory = read_estimate(os.path.join(path, TRAJECTORY))
        first_image = trajectory.stamps[0] - trajectory.shift
        accepted = _read_loops(os.path.join(path, "loops.csv")).shifted(trajectory.shift)
        loops = accepted.between(trajectory.stamps)
        return cls(path, summary, trajectory, frames,
                   _read_ply(os.path.join(path, "map.ply"))[0],
                   _by_axis(*_read_ply(os.path.join(path, "lines.ply"))[1:]),
                   loops, len(accepted) - len(loops), _find_images(path, first_image))


def _read_columns(path):
    """Returns the columns by heading. Raises ValueError with the line if there are no rows or one
    is truncated, as in the files of an unfinished run."""
    rows = []
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.reader(file)
        try:
            names = next(reader, [])
            for row in filter(None, reader):
                rows.append(_numbers(row, len(names)))
        except (ValueError, csv.Error) as error:
            raise ValueError(f"{path}:{reader.line_num}: {error}") from None
    if not rows:
        raise ValueError(f"{path}: no rows")
    return dict(zip(names, np.array(rows).T))


def _numbers(row, columns):
    if len(row) != columns:
        raise ValueError(f"{len(row)} columns, expected {columns}")
    return [float(word) for word in row]


def _read_ply(path):
    """Returns vertices (n, 3), and endpoints (m, 2, 3) and colors (m, 3) of edges, of an ASCII
    PLY; empty arrays if there is no file."""
    if not os.path.isfile(path):
        return np.empty((0, 3)), np.empty((0, 2, 3)), np.empty((0, 3), dtype=int)
    with open(path, encoding="utf-8") as file:
        header, _, body = file.read().partition("end_header\n")
    rows = [line.split() for line in body.splitlines()]
    try:
        # The number is written last: it is blank after an unfinished run.
        count = int(re.search(r"^element vertex +(\d*)", header, re.MULTILINE)[1])
        vertices = np.array(rows[:count], dtype=float).reshape(count, 3)
        edges = np.array(rows[count:], dtype=int).reshape(-1, 5)
        return vertices, vertices[edges[:, :2]], edges[:, 2:]
    except (IndexError, TypeError, ValueError):
        raise TrajectoryError(f"{path}: damaged, or of a run that did not finish; run again"
                              ) from None


def _by_axis(ends, colors):
    axes = [LINE_COLORS.get(tuple(color), FREE) for color in colors]
    return {name: ends[[axis == name for axis in axes]] for name in (*LINE_COLORS.values(), FREE)}


def _read_loops(path):
    return read_loops(path) if os.path.isfile(path) else NO_LOOPS


def _find_images(path, first_stamp):
    """Returns tracks/STAMP_NS.jpg in temporal order, or else the pictures that every run writes."""
    stems = {os.path.basename(file)[:-len(".jpg")]: file
             for file in glob.glob(os.path.join(glob.escape(path), "tracks", "*.jpg"))}
    files = {int(stem): file for stem, file in stems.items() if stem.isdecimal()}
    if files:
        return {f"{1e-9 * stamp - first_stamp:+.2f} s from the first pose": files[stamp]
                for stamp in sorted(files)}
    names = {"points": "tracks.png", "lines": "line_tracks.png"}
    return {caption: os.path.join(path, name) for caption, name in names.items()
            if os.path.isfile(os.path.join(path, name))}
