# SPDX-License-Identifier: BSD-3-Clause
"""PNG figures that compare several estimates with the same ground truth, and overviews."""

import math

import numpy as np

from .metrics import position_errors
from .plots import (FROM_ABOVE, draw_errors, draw_path, draw_trajectory, pyplot, save_figures)

COLORS = pyplot.get_cmap("tab10").colors


def write_comparison(folder, pairs):
    """Draws `pairs`, by name: an aligned estimate and the ground truth at its poses. Returns the
    file names."""
    return save_figures(folder, {
        "trajectory_errors.png": _trajectory_errors_figure(pairs),
        "ape.png": _errors_figure(pairs),
        "trajectories.png": _trajectories_figure(pairs),
        "translation.png": _translation_figure(pairs),
    })


def write_overview(folder, name, values, label):
    """Draws a bar per sequence and variant. `values`: variant -> sequence -> figure and standard
    deviation, the same sequences for all, NaN and 0 without a figure. Returns the file names."""
    sequences = list(next(iter(values.values())))
    figure, axis = pyplot.subplots(figsize=(max(6, 1 + 1.6 * len(sequences)), 4.5),
                                   constrained_layout=True)
    width, places = 0.85 / len(values), np.arange(len(sequences))
    for index, (variant, figures) in enumerate(values.items()):
        heights, deviations = np.array([figures[s] for s in sequences], dtype=float).T
        errors = [np.fmin(heights, deviations), deviations]  # no error is below 0
        axis.bar(places + (index - (len(values) - 1) / 2) * width, heights, width, label=variant,
                 color=COLORS[index % len(COLORS)], yerr=errors)
    axis.set_xticks(places)
    axis.set_xticklabels(sequences, rotation=20, ha="right")
    axis.set_ylabel(label)
    axis.grid(axis="y", alpha=0.3)
    axis.legend(ncol=4, fontsize="small", loc="lower center", bbox_to_anchor=(0.5, 1.0))
    return save_figures(folder, {name: figure})


def _panels(count, size):
    """Returns a figure and its first `count` panels, in rows of at most two."""
    columns = min(count, 2)
    rows = math.ceil(count / columns)
    figure, axes = pyplot.subplots(rows, columns, squeeze=False, constrained_layout=True,
                                   figsize=(columns * size[0], rows * size[1]))
    for unused in axes.flat[count:]:
        unused.axis("off")
    return figure, axes.flat[:count]


def _trajectory_errors_figure(pairs):
    highest = max(position_errors(*pair).max() for pair in pairs.values())
    figure, panels = _panels(len(pairs), (6, 5))
    for axis, (name, pair) in zip(panels, pairs.items()):
        dots = draw_trajectory(axis, *pair, FROM_ABOVE, highest)
        axis.set_title(name)
    panels[0].legend(loc="best", fontsize="small")
    figure.colorbar(dots, ax=list(panels), label="APE [m]")
    return figure


def _errors_figure(pairs):
    begin = min(truth.stamps[0] for _, truth in pairs.values())
    errors = {name: position_errors(*pair) for name, pair in pairs.items()}
    highest = 1.3 * max(max(e.max() for e in errors.values()), 1e-3)
    figure, panels = _panels(len(pairs), (8, 3.5))
    for axis, (name, (estimate, _)) in zip(panels, pairs.items()):
        draw_errors(axis, estimate.stamps - begin, errors[name])
        axis.set(title=name, ylim=(0, highest))
        axis.legend(loc="upper left", ncol=3, fontsize="small")
    return figure


def _trajectories_figure(pairs):
    figure, axis = pyplot.subplots(figsize=(8, 7), constrained_layout=True)
    draw_path(axis, _longest_truth(pairs), FROM_ABOVE, color="black", label="ground truth")
    for (name, (estimate, _)), color in zip(pairs.items(), COLORS):
        draw_path(axis, estimate, FROM_ABOVE, color=color, label=name)
    axis.legend(loc="best", fontsize="small")
    return figure


def _translation_figure(pairs):
    figure, axes = pyplot.subplots(3, 2, figsize=(14, 8), sharex=True, constrained_layout=True)
    truth = _longest_truth(pairs)
    for index, (position, error) in enumerate(axes):
        position.plot(truth.stamps - truth.stamps[0], truth.positions[:, index], color="black",
                      linewidth=1.0, label="ground truth")
        for (name, (estimate, own_truth)), color in zip(pairs.items(), COLORS):
            seconds = estimate.stamps - truth.stamps[0]
            options = {"color": color, "linewidth": 1.0, "label": name}
            position.plot(seconds, estimate.positions[:, index], **options)
            error.plot(seconds, (estimate.positions - own_truth.positions)[:, index], **options)
        position.set_ylabel(f"{'xyz'[index]} [m]")
        error.set_ylabel(f"error of {'xyz'[index]} [m]")
        position.grid(alpha=0.3)
        error.grid(alpha=0.3)
    axes[0, 0].legend(loc="best", fontsize="small")
    for axis in axes[-1]:
        axis.set_xlabel("time [s]")
    return figure


def _longest_truth(pairs):
    return max((truth for _, truth in pairs.values()), key=lambda truth: truth.duration)
