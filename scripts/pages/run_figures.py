# SPDX-License-Identifier: BSD-3-Clause
"""The figures of a run's page, as plotly wants them."""

import itertools

import numpy as np

from evaluation.metrics import position_errors

ESTIMATE_COLOUR, TRUTH_COLOUR, LOOP_COLOUR = "#d0008f", "#222222", "#ff9a00"
PATH_COLOURS = (ESTIMATE_COLOUR, "#1f77b4", "#2ca02c", "#ff7f0e", "#9467bd", "#8c564b", "#17becf",
                "#bcbd22", "#7f7f7f")
TRUTH = "ground truth"
POINT_COLOUR = "#9aa5b1"
LINE_COLOURS = {"along x": "#dc2828", "along y": "#28a028", "along z": "#325ae6", "free": "#8c8c8c"}
NOTHING = np.empty((0, 3))
TOOLBAR = 35  # height of what plotly shows above a figure [px]
MAX_POINTS = 20000  # more make the browser slow and the picture no clearer
STAGES = ("point_tracking", "line_tracking", "line_merging", "optimization", "marginalization",
          "total")
COUNTS = ("points_observed", "points_in_window", "lines_observed", "lines_in_window",
          "lines_recognised")


def scene_figure(trajectories, points=NOTHING, lines=None, loops=NOTHING):
    """The map in 3-D [m]. `trajectories`: positions (n, 3) by name; points (n, 3); lines: ends
    (n, 2, 3) by axis; loops: ends (n, 2, 3)."""
    inside = _view(points, trajectories.values())
    points = points[inside(points)]
    points = points[::1 + len(points) // MAX_POINTS]
    data = [_spatial("points", points, mode="markers",
                     marker={"size": 1.5, "color": POINT_COLOUR})]
    for axis, ends in (lines or {}).items():
        ends = ends[inside(ends).all(axis=1)]
        data.append(_segments(f"lines {axis}", ends, LINE_COLOURS[axis], 3))
    data.append(_segments("loops", loops, LOOP_COLOUR, 4))
    colours = itertools.cycle(PATH_COLOURS)
    data += [_spatial(name, positions, mode="lines", line={
        "color": TRUTH_COLOUR if name == TRUTH else next(colours), "width": 5})
             for name, positions in trajectories.items()]
    axes = {f"{axis}axis": {"title": {"text": f"{axis} [m]"}} for axis in "xyz"}
    return {"data": [trace for trace in data if trace["x"]],
            "layout": {"scene": dict(axes, aspectmode="data"),
                       "margin": {"l": 0, "r": 0, "t": TOOLBAR, "b": 0}}}


def error_figure(pairs):
    """The APE over time. `pairs`, by name: an aligned estimate and the truth at its poses."""
    begin = min(truth.stamps[0] for _, truth in pairs.values())
    data = []
    for (name, (estimate, truth)), colour in zip(pairs.items(), itertools.cycle(PATH_COLOURS)):
        errors = position_errors(estimate, truth)
        label = f"{name}, RMSE {np.sqrt(np.mean(errors ** 2)):.4f} m"
        data.append(_curve(label, estimate.stamps - begin, errors, colour))
    return _over_time(data, "APE [m]")


def columns_figure(frames, columns, title):
    """Columns of timing.csv over time; those that it lacks are left out."""
    seconds = 1e-9 * (frames["stamp_ns"] - frames["stamp_ns"][0])
    data = [_curve(column.replace("_", " "), seconds, frames[column])
            for column in columns if column in frames]
    return _over_time(data, title)


def _view(points, paths):
    """A function that says which of coordinates (..., 3) lie in the box of the paths and of all but
    the outer points, which would make everything else small."""
    corners = np.concatenate([_extent(path) for path in paths]
                             + ([np.percentile(points, (10, 90), axis=0)] if len(points) else []))
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 0.1 * (high - low)
    return lambda places: ((places >= low - margin) & (places <= high + margin)).all(axis=-1)


def _extent(positions):
    return np.stack([positions.min(axis=0), positions.max(axis=0)])


def _spatial(name, positions, **style):
    x, y, z = (_plain(column) for column in positions.T)
    return {"type": "scatter3d", "name": name, "x": x, "y": y, "z": z, **style}


def _segments(name, ends, colour, width):
    """Ends (n, 2, 3) as one curve with gaps."""
    ends = ends.reshape(-1, 2, 3)
    gaps = np.full((len(ends), 1, 3), np.nan)
    return _spatial(name, np.concatenate([ends, gaps], axis=1).reshape(-1, 3), mode="lines",
                    line={"color": colour, "width": width})


def _curve(name, seconds, values, colour=None):
    """`colour`: plotly's own choice where there is none."""
    return {"type": "scatter", "mode": "lines", "name": name, "x": _plain(seconds),
            "y": _plain(values), "line": {"width": 1.2, "color": colour}}


def _over_time(data, title):
    return {"data": data, "layout": {
        "xaxis": {"title": {"text": "time [s]"}},
        "yaxis": {"title": {"text": title}, "rangemode": "tozero"}, "showlegend": True,
        "margin": {"l": 60, "r": 10, "t": TOOLBAR, "b": 45}}}


def _plain(values):
    """As JSON has them: to a tenth of a millimetre or microsecond, null for NaN."""
    return [None if np.isnan(value) else round(float(value), 4) for value in values]
