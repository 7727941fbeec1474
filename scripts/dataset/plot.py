# SPDX-License-Identifier: BSD-3-Clause
"""A PNG figure of the APE of all runs."""

import os

from evaluation.plots import pyplot, save

from .results import METRIC


def write_plot(folder, results):
    """Draws a dot for each run, by sequence and variant; returns the path of ape.png."""
    metric = METRIC["ape_m"]
    figure, axis = pyplot.subplots(figsize=(2 + 1.2 * len(results.sequences), 4),
                                   constrained_layout=True)
    for number, variant in enumerate(results.variants):
        offset = (number + 0.5) / len(results.variants) - 0.5
        dots = [(results.sequences.index(result.run.sequence.name) + 0.8 * offset,
                 metric.value(result)) for result in results.all()
                if result.run.variant == variant and metric.value(result) is not None]
        axis.plot(*zip(*dots) if dots else ((), ()), "o", markersize=4, label=variant)
    axis.set_xticks(range(len(results.sequences)))
    axis.set_xticklabels(results.sequences, rotation=45, ha="right")
    axis.set(ylabel=metric.title, ylim=(0, None))
    axis.grid(axis="y", alpha=0.3)
    axis.legend(fontsize="small")
    return save(figure, os.path.join(folder, "ape.png"))
