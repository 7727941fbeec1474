# SPDX-License-Identifier: BSD-3-Clause
"""PNG figures of one or several estimates with the same ground truth, and overviews. `pairs`, by
name: an aligned estimate and the ground truth at its poses."""

import math
import os

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402 (the backend must be chosen first)

from .metrics import position_errors, statistics  # noqa: E402

COLORS = pyplot.get_cmap("tab10").colors
FROM_ABOVE, FROM_THE_SIDE = (0, 1), (0, 2)  # the axes to the right and upwards


def write_plots(folder, estimate, truth):
    """Draws one pair; returns the file names."""
    pairs = {"estimate": (estimate, truth)}
    return _save_figures(folder, {
        "trajectory.png": _trajectory_errors_figure([
            ("from above", FROM_ABOVE, *pairs["estimate"]),
            ("from the side", FROM_THE_SIDE, *pairs["estimate"])]),
        "ape.png": _errors_figure(pairs),
        "translation.png": _translation_figure(pairs),
    })


def write_comparison(folder, pairs):
    """Draws several pairs; returns the file names."""
    return _save_figures(folder, {
        "trajectory_errors.png": _trajectory_errors_figure(
            [(name, FROM_ABOVE, *pair) for name, pair in pairs.items()]),
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
    return _save_figures(folder, {name: figure})


def _save_figures(folder, figures):
    """Writes and closes figures, by file name; returns the paths."""
    os.makedirs(folder, exist_ok=True)
    paths = []
    for name, figure in figures.items():
        paths.append(os.path.join(folder, name))
        figure.savefig(paths[-1], dpi=120)
        pyplot.close(figure)
    return paths


def _panels(count, size):
    """Returns a figure and its first `count` panels, in rows of at most two."""
    columns = min(count, 2)
    rows = math.ceil(count / columns)
    figure, axes = pyplot.subplots(rows, columns, squeeze=False, constrained_layout=True,
                                   figsize=(columns * size[0], rows * size[1]))
    for unused in axes.flat[count:]:
        unused.axis("off")
    return figure, axes.flat[:count]


def _draw_path(axis, trajectory, plane, style="-", **options):
    """Draws positions as a line, with the same scale on both axes."""
    horizontal, vertical = plane
    axis.plot(trajectory.positions[:, horizontal], trajectory.positions[:, vertical], style,
              linewidth=1.0, **options)
    axis.set(xlabel=f"{'xyz'[horizontal]} [m]", ylabel=f"{'xyz'[vertical]} [m]")
    axis.set_aspect("equal", adjustable="datalim")
    axis.grid(alpha=0.3)


def _trajectory_errors_figure(views):
    """Draws estimates colored by their position errors. `views`: title, plane, and pair."""
    errors = [position_errors(*pair) for _, _, *pair in views]
    highest = max(e.max() for e in errors)
    figure, panels = _panels(len(views), (6, 5))
    for axis, (title, plane, estimate, truth), colors in zip(panels, views, errors):
        dots = axis.scatter(*estimate.positions[:, plane].T, c=colors, cmap="viridis", s=14,
                            label="estimate", vmin=0, vmax=highest)
        _draw_path(axis, truth, plane, "--", color="black", label="ground truth", zorder=3)
        axis.set_title(title)
    panels[0].legend(loc="best", fontsize="small")
    figure.colorbar(dots, ax=list(panels), label="APE [m]")
    return figure


def _errors_figure(pairs):
    """Draws position errors over time with their statistics."""
    begin = min(truth.stamps[0] for _, truth in pairs.values())
    errors = {name: position_errors(*pair) for name, pair in pairs.items()}
    highest = 1.3 * max(max(e.max() for e in errors.values()), 1e-3)
    figure, panels = _panels(len(pairs), (8, 3.5))
    for axis, (name, (estimate, _)) in zip(panels, pairs.items()):
        axis.plot(estimate.stamps - begin, errors[name], color="0.35", linewidth=1.0, label="APE")
        figures = statistics(errors[name])
        for key, color in (("rmse", "tab:red"), ("mean", "tab:blue"), ("median", "tab:green")):
            axis.axhline(figures[key], color=color, linewidth=1.2,
                         label=f"{key} {figures[key]:.4f} m")
        axis.axhspan(max(figures["mean"] - figures["std"], 0.0), figures["mean"] + figures["std"],
                     color="tab:blue", alpha=0.12, label=f"std {figures['std']:.4f} m")
        axis.set(title=name, xlabel="time [s]", ylabel="APE [m]", ylim=(0, highest))
        axis.grid(alpha=0.3)
        axis.legend(loc="upper left", ncol=3, fontsize="small")
    return figure


def _trajectories_figure(pairs):
    figure, axis = pyplot.subplots(figsize=(8, 7), constrained_layout=True)
    _draw_path(axis, _longest_truth(pairs), FROM_ABOVE, color="black", label="ground truth")
    for (name, (estimate, _)), color in zip(pairs.items(), COLORS):
        _draw_path(axis, estimate, FROM_ABOVE, color=color, label=name)
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
