# SPDX-License-Identifier: BSD-3-Clause
"""PNG figures of an aligned estimate and the ground truth at its poses."""

import os

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402 (the backend must be chosen first)

from .metrics import position_errors, statistics  # noqa: E402

VIEWS = {"from above": (0, 1), "from the side": (0, 2)}  # the axes to the right and upwards


def write_plots(folder, estimate, truth):
    """Returns the names of the files."""
    os.makedirs(folder, exist_ok=True)
    paths = []
    for name, draw in (("trajectory.png", trajectory_figure), ("ape.png", errors_figure),
                       ("translation.png", translation_figure)):
        paths.append(save(draw(estimate, truth), os.path.join(folder, name)))
    return paths


def save(figure, path):
    """Writes and closes the figure; returns the path."""
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
    return path


def trajectory_figure(estimate, truth):
    """Draws the estimate, colored by its position errors, under the truth."""
    figure, panels = pyplot.subplots(1, 2, figsize=(12, 5), constrained_layout=True)
    for axis, (title, (right, up)) in zip(panels, VIEWS.items()):
        dots = axis.scatter(estimate.positions[:, right], estimate.positions[:, up], s=14, vmin=0,
                            c=position_errors(estimate, truth), cmap="viridis", label="estimate")
        axis.plot(truth.positions[:, right], truth.positions[:, up], "--", color="black",
                  linewidth=1.0, label="ground truth", zorder=3)
        axis.set(title=title, xlabel=f"{'xyz'[right]} [m]", ylabel=f"{'xyz'[up]} [m]")
        axis.set_aspect("equal", adjustable="datalim")
        axis.grid(alpha=0.3)
    panels[0].legend(loc="best", fontsize="small")
    figure.colorbar(dots, ax=list(panels), label="APE [m]")
    return figure


def errors_figure(estimate, truth):
    """Draws position errors over time with their statistics."""
    errors = position_errors(estimate, truth)
    figures = statistics(errors)
    figure, axis = pyplot.subplots(figsize=(8, 3.5), constrained_layout=True)
    axis.plot(estimate.stamps - truth.stamps[0], errors, color="0.35", linewidth=1.0, label="APE")
    for key, color in (("rmse", "tab:red"), ("mean", "tab:blue"), ("median", "tab:green")):
        axis.axhline(figures[key], color=color, linewidth=1.2,
                     label=f"{key} {figures[key]:.4f} m")
    axis.axhspan(max(figures["mean"] - figures["std"], 0.0), figures["mean"] + figures["std"],
                 color="tab:blue", alpha=0.12, label=f"std {figures['std']:.4f} m")
    axis.set(xlabel="time [s]", ylabel="APE [m]", ylim=(0, 1.3 * max(errors.max(), 1e-3)))
    axis.grid(alpha=0.3)
    axis.legend(loc="upper left", ncol=3, fontsize="small")
    return figure


def translation_figure(estimate, truth):
    """Draws each axis over time, and its error."""
    figure, axes = pyplot.subplots(3, 2, figsize=(14, 8), sharex=True, constrained_layout=True)
    seconds = estimate.stamps - truth.stamps[0]
    errors = estimate.positions - truth.positions
    for index, (position, error) in enumerate(axes):
        position.plot(truth.stamps - truth.stamps[0], truth.positions[:, index], color="black",
                      linewidth=1.0, label="ground truth")
        position.plot(seconds, estimate.positions[:, index], linewidth=1.0, label="estimate")
        error.plot(seconds, errors[:, index], linewidth=1.0)
        position.set_ylabel(f"{'xyz'[index]} [m]")
        error.set_ylabel(f"error of {'xyz'[index]} [m]")
        position.grid(alpha=0.3)
        error.grid(alpha=0.3)
    axes[0, 0].legend(loc="best", fontsize="small")
    for axis in axes[-1]:
        axis.set_xlabel("time [s]")
    return figure
