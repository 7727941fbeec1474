#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes an animation of a run, such as docs/images/flight.webp: images with tracks, and the growing
map, seen obliquely from above and turned so that its walls are along the picture.

The run needs images with tracks (run_offline --save-track-images 0.15). Writes an animated WebP."""

import argparse
import io
import os
import sys

import matplotlib
import numpy as np
from PIL import Image

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from evaluation.trajectory import TrajectoryError  # noqa: E402
from pages.run_folder import RunFolder  # noqa: E402
from pages.run_figures import LINE_COLORS  # noqa: E402

SIZE_IN = (7.52, 3.6)  # size of the map [inches]
REACH = 8  # a landmark appears when it is in view within this distance [m]
HALF_VIEW = np.cos(np.radians(45))  # cosine of half the field of view
ELEVATION = np.radians(50)  # of the eye that looks at the map
# Least parallax of what is drawn: with less, depths are too uncertain for a picture [rad].
LEAST_PARALLAX = {"points": np.radians(4), "lines": np.radians(8)}


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", help="the output folder of run_offline")
    parser.add_argument("--output", metavar="FILE", help="default: run.webp in that folder")
    parser.add_argument("--width", type=int, default=752, help="width of the picture [px] (752)")
    parser.add_argument("--quality", type=int, default=45, help="WebP quality, 1 to 100 (45)")
    return parser.parse_args(arguments)


def optical_axes(run):
    """Returns the optical axis in the world (n, 3) for each pose."""
    x, y, z, w = run.summary["calibration"]["q_B_C_xyzw"]
    axis_B = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    return run.trajectory.rotations @ axis_B


class Views:
    """Which poses view places: within REACH and in the field of view."""

    def __init__(self, positions, axes):
        self._positions, self._axes = positions[::4], axes[::4]

    def find(self, places, least_parallax):
        """Returns the index of the first pose that views each place (n, 3); -1 if its rays differ
        by less than `least_parallax`."""
        return np.array([self._first(place, least_parallax) for place in places], dtype=int)

    def _first(self, place, least_parallax):
        rays = place - self._positions
        distances = np.linalg.norm(rays, axis=1)
        rays /= distances[:, None]
        seen = np.flatnonzero((distances < REACH) & (np.sum(rays * self._axes, axis=1) > HALF_VIEW))
        if len(seen) == 0 or np.min(rays[seen] @ rays[seen[0]]) > np.cos(least_parallax):
            return -1
        return 4 * seen[0]


def heading_of_walls(lines):
    """Returns the angle [rad] by which the directions of level lines (n, 2, 3), which repeat every
    quarter turn, differ from the axes; long lines count more."""
    ways = lines[:, 1] - lines[:, 0]
    level = ways[np.abs(ways[:, 2]) < 0.2 * np.linalg.norm(ways, axis=1), :2]
    angles = np.arctan2(level[:, 1], level[:, 0])
    return np.angle(np.sum(np.linalg.norm(level, axis=1) * np.exp(4j * angles))) / 4


class GrowingMap:
    """Draws the map as it is known at a pose."""

    def __init__(self, run):
        views = Views(run.trajectory.positions, optical_axes(run))
        self._heading = heading_of_walls(np.concatenate(list(run.lines.values())))
        self._path = self._project(run.trajectory.positions)
        self._points_from = views.find(run.points, LEAST_PARALLAX["points"])
        self._points = self._project(run.points)
        self._lines = []
        for axis, ends in run.lines.items():
            first = views.find(ends.mean(axis=1), LEAST_PARALLAX["lines"])
            drawn = first >= 0
            self._lines.append((LINE_COLORS[axis], self._project(ends)[drawn], first[drawn]))
        shown = [self._path, self._points[self._points_from >= 0]]
        self._low, self._high = np.percentile(np.concatenate(shown), [1, 99], axis=0)

    def _project(self, places):
        """Returns coordinates (..., 2) in the picture: the walls of the map are parallel to it."""
        c, s = np.cos(self._heading), np.sin(self._heading)
        x, y, z = places[..., 0], places[..., 1], places[..., 2]
        right, ahead = c * x + s * y, c * y - s * x
        return np.stack([right, np.sin(ELEVATION) * ahead + np.cos(ELEVATION) * z], axis=-1)

    def draw(self, index, width):
        figure = pyplot.figure(figsize=SIZE_IN, dpi=width / SIZE_IN[0])
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set(xlim=(self._low[0], self._high[0]), ylim=(self._low[1], self._high[1]))
        axes.set_aspect("equal", adjustable="datalim")
        axes.set_axis_off()
        known = (self._points_from >= 0) & (self._points_from <= index)
        axes.plot(*self._points[known].T, ".", color="#7a8794", markersize=2.5)
        for color, ends, first in self._lines:
            for start, end in ends[first <= index]:
                axes.plot(*zip(start, end), color=color, linewidth=1.2)
        axes.plot(*self._path[:index + 1].T, color="#d0008f", linewidth=2)
        axes.plot(*self._path[index], "o", color="#d0008f", markersize=6)
        picture = io.BytesIO()
        figure.savefig(picture, format="png")
        pyplot.close(figure)
        return Image.open(picture).convert("RGB")


def frames_of(run, width):
    """Returns a picture (PIL) for each image with tracks, and the timestamps of the images [s]."""
    growing, pictures, stamps = GrowingMap(run), [], []
    for file in run.images.values():
        stem = os.path.splitext(os.path.basename(file))[0]
        if not stem.isdecimal():
            raise TrajectoryError(f"{run.path}: no tracks/STAMP.jpg; run run_offline with"
                                  " --save-track-images 0.15")
        stamp = 1e-9 * int(stem) + run.trajectory.shift
        index = int(np.searchsorted(run.trajectory.stamps, stamp).clip(0, len(run.trajectory) - 1))
        tracks = Image.open(file).convert("RGB")
        tracks = tracks.resize((width, round(tracks.height * width / tracks.width)))
        map_now = growing.draw(index, width)
        picture = Image.new("RGB", (width, tracks.height + map_now.height), "white")
        picture.paste(tracks, (0, 0))
        picture.paste(map_now, (0, tracks.height))
        pictures.append(picture)
        stamps.append(stamp)
    return pictures, stamps


def main(arguments):
    options = parse_arguments(arguments)
    try:
        pictures, stamps = frames_of(RunFolder.read(options.results), options.width)
    except TrajectoryError as error:
        print(f"animate_run.py: {error}", file=sys.stderr)
        return 1
    output = options.output or os.path.join(options.results, "run.webp")
    interval_ms = 1000 * (stamps[-1] - stamps[0]) / max(1, len(stamps) - 1)
    pictures[0].save(output, save_all=True, append_images=pictures[1:], duration=round(interval_ms),
                     loop=0, quality=options.quality, method=6)
    print(f"{output}: {len(pictures)} images, {os.path.getsize(output) / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
