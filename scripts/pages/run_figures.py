# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a run's page, in plotly's format."""

import numpy as np

from evaluation.metrics import position_errors

ESTIMATE_COLOR, TRUTH_COLOR, LOOP_COLOR = "#d0008f", "#222222", "#ff9a00"
TRUTH = "ground truth"
POINT_COLOR = "#9aa5b1"
LINE_COLORS = {"along x": "#dc2828", "along y": "#28a028", "along z": "#325ae6", "free": "#8c8c8c"}
NOTHING = np.empty((0, 3))
DIRECTION = np.array([0.56, 0.56, 0.61])  # of the initial view, from the scene to the camera
VIEW_DISTANCE = 2.6  # of the camera, in radii of the visible scene
TOOLBAR = 35  # height of plotly's toolbar above a figure [px]
MAX_POINTS = 20000  # more points make the browser slow, but the picture no clearer
STAGES = ("point_tracking", "line_tracking", "line_merging", "optimization", "marginalization",
          "total")
COUNTS = ("points_observed", "points_in_window", "lines_observed", "lines_in_window",
          "lines_recognized")


def scene_figure(trajectories, points=NOTHING, lines=None, loops=NOTHING):
    """Returns the map in 3-D [m]. `trajectories`: positions (n, 3) by name; points (n, 3); lines:
    endpoints (n, 2, 3) by axis; loops: endpoints (n, 2, 3)."""
    paths = np.concatenate(list(trajectories.values()))
    low, high = _box(points, paths)

    def inside(places):
        return ((places >= low) & (places <= high)).all(axis=-1)

    points = points[inside(points)]
    points = points[::1 + len(points) // MAX_POINTS]
    data = [_spatial("points", points, mode="markers",
                     marker={"size": 1.5, "color": POINT_COLOR})]
    for axis, ends in (lines or {}).items():
        ends = ends[inside(ends).all(axis=1)]
        data.append(_segments(f"lines {axis}", ends, LINE_COLORS[axis], 3))
    data.append(_segments("loops", loops, LOOP_COLOR, 4))
    data += [_spatial(name, positions, mode="lines", line={
        "color": TRUTH_COLOR if name == TRUTH else ESTIMATE_COLOR, "width": 5})
             for name, positions in trajectories.items()]
    return {"data": [trace for trace in data if trace["x"]],
            "layout": {"scene": _first_view(points, paths, low, high),
                       "margin": {"l": 0, "r": 0, "t": TOOLBAR, "b": 0}}}


def error_figure(estimate, truth):
    """Returns the APE over time of an aligned estimate and the truth at its poses."""
    errors = position_errors(estimate, truth)
    label = f"APE, RMSE {np.sqrt(np.mean(errors ** 2)):.4f} m"
    return _over_time([_curve(label, estimate.stamps - truth.stamps[0], errors, ESTIMATE_COLOR)],
                      "APE [m]")


def columns_figure(frames, columns, title):
    """Returns columns of timing.csv over time; missing columns are ignored."""
    seconds = 1e-9 * (frames["stamp_ns"] - frames["stamp_ns"][0])
    data = [_curve(column.replace("_", " "), seconds, frames[column])
            for column in columns if column in frames]
    return _over_time(data, title)


def rings_figure(rings):
    """Returns the residuals by distance from the image center: `residual_rings` of summary.json."""
    rings = [ring for ring in rings if ring["count"]]
    radii = np.array([(ring["inner_px"] + ring["outer_px"]) / 2 for ring in rings])
    data = [{**_curve(name, radii, np.array([ring[key] for ring in rings])),
             "mode": "lines+markers"} for name, key in (
                 ("median of the radial component", "radial_px"),
                 ("standard deviation", "deviation_px"))]
    layout = _over_time(data, "residual [px]")["layout"]
    layout["xaxis"]["title"]["text"] = "distance from the image center [px]"
    return {"data": data, "layout": layout}


def _box(points, paths):
    """Returns the corners of a box around the paths and all points except outliers, which would
    make everything else small."""
    corners = paths
    if len(points):
        corners = np.concatenate([paths, np.percentile(points, (5, 95), axis=0)])
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = np.maximum(0.1 * (high - low), 0.02 * (high - low).max() + 1e-3)
    return low - margin, high + margin


def _first_view(points, paths, low, high):
    """Returns axes with equal scale, and a camera directed at the middle of the paths from which
    they and half of the points are visible."""
    middle = (paths.min(axis=0) + paths.max(axis=0)) / 2
    radius = np.linalg.norm(paths - middle, axis=1).max()
    if len(points):
        radius = max(radius, np.median(np.linalg.norm(points - middle, axis=1)))
    size = (high - low).max()  # plotly's unit for the camera, whose origin is the middle of the box
    center = (middle - (low + high) / 2) / size
    eye = center + DIRECTION * VIEW_DISTANCE * radius / size
    scene = {f"{axis}axis": {"title": {"text": f"{axis} [m]"}, "range": [first, last]}
             for axis, first, last in zip("xyz", low.tolist(), high.tolist())}
    return {**scene, "aspectmode": "manual", "aspectratio": _xyz((high - low) / size),
            "camera": {"center": _xyz(center), "eye": _xyz(eye)}}


def _xyz(vector):
    return dict(zip("xyz", vector.tolist()))


def _spatial(name, positions, **style):
    x, y, z = (_plain(column) for column in positions.T)
    return {"type": "scatter3d", "name": name, "x": x, "y": y, "z": z, **style}


def _segments(name, ends, color, width):
    """Returns endpoints (n, 2, 3) as one curve with gaps."""
    ends = ends.reshape(-1, 2, 3)
    gaps = np.full((len(ends), 1, 3), np.nan)
    return _spatial(name, np.concatenate([ends, gaps], axis=1).reshape(-1, 3), mode="lines",
                    line={"color": color, "width": width})


def _curve(name, seconds, values, color=None):
    """Returns a curve; plotly selects the color if it is None."""
    return {"type": "scatter", "mode": "lines", "name": name, "x": _plain(seconds),
            "y": _plain(values), "line": {"width": 1.2, "color": color}}


def _over_time(data, title):
    return {"data": data, "layout": {
        "xaxis": {"title": {"text": "time [s]"}},
        "yaxis": {"title": {"text": title}, "rangemode": "tozero"}, "showlegend": True,
        "margin": {"l": 60, "r": 10, "t": TOOLBAR, "b": 45}}}


def _plain(values):
    """Returns values for JSON: rounded to a tenth of a millimeter or microsecond, null for NaN."""
    return [None if np.isnan(value) else round(float(value), 4) for value in values]
