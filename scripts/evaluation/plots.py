# SPDX-License-Identifier: BSD-3-Clause
"""PNG figures of one evaluation."""

import os

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402 (the backend must be chosen first)

from .metrics import position_errors  # noqa: E402

FROM_ABOVE, FROM_THE_SIDE = (0, 1), (0, 2)  # the axes to the right and upwards


def write_plots(folder, estimate, truth):
    """Draws paired, aligned trajectories and their position errors [m]; returns the file names."""
    errors = position_errors(estimate, truth)
    figures = {
        "trajectory.png": _trajectory_figure(estimate, truth),
        "ape.png": _error_figure(estimate.stamps, errors),
        "translation.png": _translation_figure(estimate, truth),
    }
    return save_figures(folder, figures)


def save_figures(folder, figures):
    """Writes and closes figures, by file name; returns the paths."""
    os.makedirs(folder, exist_ok=True)
    paths = []
    for name, figure in figures.items():
        paths.append(os.path.join(folder, name))
        figure.savefig(paths[-1], dpi=120)
        pyplot.close(figure)
    return paths


def draw_trajectory(axis, estimate, truth, plane, highest_error=None):
    """Draws the ground truth over the estimate, which is colored by its position errors; returns
    the dots, to which a color bar belongs. `plane`: indices of the axes to the right and
    upwards."""
    horizontal, vertical = plane
    dots = axis.scatter(estimate.positions[:, horizontal], estimate.positions[:, vertical],
                        c=position_errors(estimate, truth), cmap="viridis", s=14, label="estimate",
                        vmin=0 if highest_error else None, vmax=highest_error)
    draw_path(axis, truth, plane, "--", color="black", label="ground truth", zorder=3)
    return dots


def draw_path(axis, trajectory, plane, style="-", **options):
    """Draws positions as a line, with the same scale on both axes."""
    horizontal, vertical = plane
    axis.plot(trajectory.positions[:, horizontal], trajectory.positions[:, vertical], style,
              linewidth=1.0, **options)
    axis.set(xlabel=f"{'xyz'[horizontal]} [m]", ylabel=f"{'xyz'[vertical]} [m]")
    axis.set_aspect("equal", adjustable="datalim")
    axis.grid(alpha=0.3)


def draw_errors(axis, seconds, errors):
    """Draws position errors [m] over time with their RMSE, mean, median and standard deviation."""
    axis.plot(seconds, errors, color="0.35", linewidth=1.0, label="APE")
    mean, deviation = np.mean(errors), np.std(errors)
    for value, name, color in [(np.sqrt(np.mean(errors ** 2)), "rmse", "tab:red"),
                               (mean, "mean", "tab:blue"),
                               (np.median(errors), "median", "tab:green")]:
        axis.axhline(value, color=color, linewidth=1.2, label=f"{name} {value:.4f} m")
    axis.axhspan(max(mean - deviation, 0.0), mean + deviation, color="tab:blue", alpha=0.12,
                 label=f"std {deviation:.4f} m")
    axis.set(xlabel="time [s]", ylabel="APE [m]", ylim=(0, 1.15 * max(errors.max(), 1e-3)))
    axis.grid(alpha=0.3)


def _trajectory_figure(estimate, truth):
    figure, axes = pyplot.subplots(1, 2, figsize=(13, 6), constrained_layout=True)
    for axis, plane, title in zip(axes, [FROM_ABOVE, FROM_THE_SIDE],
                                  ["from above", "from the side"]):
        dots = draw_trajectory(axis, estimate, truth, plane)
        axis.set_title(title)
    axes[0].legend(loc="best")
    figure.colorbar(dots, ax=axes, label="APE [m]")
    return figure


def _error_figure(stamps, errors):
    figure, axis = pyplot.subplots(figsize=(10, 4), constrained_layout=True)
    draw_errors(axis, stamps - stamps[0], errors)
    axis.legend(loc="upper left", ncol=5, fontsize="small")
    return figure


def _translation_figure(estimate, truth):
    figure, axes = pyplot.subplots(3, 1, figsize=(10, 7), sharex=True, constrained_layout=True)
    seconds = estimate.stamps - truth.stamps[0]
    for index, axis in enumerate(axes):
        axis.plot(truth.stamps - truth.stamps[0], truth.positions[:, index], "--", color="0.55",
                  label="ground truth")
        axis.plot(seconds, estimate.positions[:, index], color="tab:blue", linewidth=1.0,
                  label="estimate")
        axis.set_ylabel(f"{'xyz'[index]} [m]")
        axis.grid(alpha=0.3)
    axes[0].legend(loc="best")
    axes[-1].set_xlabel("time [s]")
    return figure
