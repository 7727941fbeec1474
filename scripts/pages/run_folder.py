# SPDX-License-Identifier: BSD-3-Clause
"""What run_offline left in its folder, as arrays."""

import csv
import glob
import json
import os
from dataclasses import dataclass, field
from typing import Dict, Optional

import numpy as np

from evaluation.trajectory import Trajectory, TrajectoryError, read_trajectory

# Of the edges in lines.ply, by their colour there.
LINE_COLOURS = {(220, 40, 40): "along x", (40, 160, 40): "along y", (50, 90, 230): "along z"}
FREE = "free"


@dataclass
class RunFolder:
    """Coordinates are in the world of the estimate [m]."""

    path: str
    summary: dict
    trajectory: Trajectory
    frames: Dict[str, np.ndarray]  # the columns of timing.csv
    points: np.ndarray  # (n, 3)
    lines: Dict[str, np.ndarray]  # (n, 2, 3) ends, by Manhattan axis
    loops: Optional[np.ndarray] = None  # (n, 2) stamps [s] of poses that were recognised as near
    images: Dict[str, str] = field(default_factory=dict)  # files with tracks, by caption

    @classmethod
    def read(cls, path):
        """Raises TrajectoryError where trajectory, summary or timing is missing or not readable."""
        try:
            with open(os.path.join(path, "summary.json"), encoding="utf-8") as file:
                summary = json.load(file)
            frames = _read_columns(os.path.join(path, "timing.csv"))
        except (OSError, ValueError) as error:
            raise TrajectoryError(f"{path}: not the folder of a run ({error})") from None
        trajectory = read_trajectory(os.path.join(path, "trajectory.tum"))
        return cls(path, summary, trajectory, frames, _read_points(os.path.join(path, "map.ply")),
                   _read_lines(os.path.join(path, "lines.ply")),
                   _read_loops(os.path.join(path, "loops.csv")),
                   _find_images(path, trajectory.stamps[0]))


def _read_columns(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    names = rows[0] if rows else ()
    return {name: np.array([float(row[name]) for row in rows]) for name in names}


def _read_ply(path):
    """The lines of an ASCII PLY after its header; none where there is no file."""
    if not os.path.isfile(path):
        return [], {}
    with open(path, encoding="utf-8") as file:
        header, _, body = file.read().partition("end_header\n")
    counts = {words[1]: int(words[2]) for words in map(str.split, header.splitlines())
              if words[0] == "element"}
    return body.splitlines(), counts


def _read_points(path):
    lines, counts = _read_ply(path)
    return _numbers(lines[:counts.get("vertex", 0)], 3)


def _read_lines(path):
    lines, counts = _read_ply(path)
    vertices = _numbers(lines[:counts.get("vertex", 0)], 3)
    edges = [tuple(map(int, line.split())) for line in lines[len(vertices):]]
    by_axis = {axis: [] for axis in (*LINE_COLOURS.values(), FREE)}
    for first, second, *colour in edges:
        by_axis[LINE_COLOURS.get(tuple(colour), FREE)].append(vertices[[first, second]])
    return {axis: np.array(ends).reshape(-1, 2, 3) for axis, ends in by_axis.items()}


def _numbers(lines, columns):
    return np.array([line.split() for line in lines], dtype=float).reshape(-1, columns)


def _read_loops(path):
    """Stamps [s] of both ends of the loops that were accepted."""
    if not os.path.isfile(path):
        return None
    with open(path, encoding="utf-8", newline="") as file:
        accepted = [(row["later_ns"], row["earlier_ns"]) for row in csv.DictReader(file)
                    if row["result"] == "accepted"]
    return 1e-9 * np.array(accepted, dtype=float).reshape(-1, 2)


def _find_images(path, first_stamp):
    """tracks/STAMP_NS.jpg in order of time, or what every run writes."""
    files = {int(os.path.basename(file)[:-4]): file
             for file in glob.glob(os.path.join(glob.escape(path), "tracks", "*.jpg"))}
    if files:
        return {f"{1e-9 * stamp - first_stamp:+.2f} s from the first pose": files[stamp]
                for stamp in sorted(files)}
    names = {"points": "tracks.png", "lines": "line_tracks.png"}
    return {caption: os.path.join(path, name) for caption, name in names.items()
            if os.path.isfile(os.path.join(path, name))}
