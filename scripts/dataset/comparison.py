# SPDX-License-Identifier: BSD-3-Clause
"""Tables and figures of all results in the output folder."""

import math
import os

from .csv_files import write_csv
from .pages import write_pages
from .report import markdown_report
from .results import METRIC


def write_comparison(output, results, evaluator, facts, with_plots):
    """Writes report.md, runs.csv, table.csv, plots/ and HTML pages; returns the paths to print, the
    most important first."""
    pictures = _write_pictures(output, results, evaluator) if with_plots else {}
    path = os.path.join(output, "report.md")
    with open(path, "w", encoding="utf-8") as file:
        file.write(markdown_report(results, facts, pictures))
    pages = _write_pages(output, results, evaluator, facts) if with_plots else []
    return [path, *write_csv(output, results), *pages]


def _write_pages(output, results, evaluator, facts):
    """Returns the path of the first page, or the reason why there are no pages."""
    try:
        return [write_pages(output, results, evaluator, facts)]
    except ImportError as error:
        return [f"no pages for the browser ({error}): install python3-plotly"]


def _write_pictures(output, results, evaluator):
    """Returns the paths relative to `output`, by heading."""
    from evaluation import plots  # only here, since loading takes a second
    pictures = {}
    overview = _overview(results)
    if overview:
        paths = plots.write_overview(os.path.join(output, "plots"), "ape.png", overview,
                                     METRIC["ape_m"].title)
        pictures["All sequences"] = paths
    for sequence in results.sequences:
        pairs = evaluator.typical_pairs(results, sequence)
        if pairs:
            folder = os.path.join(output, "plots", sequence)
            pictures[sequence] = plots.write_comparison(folder, pairs)
    return {heading: [os.path.relpath(path, output) for path in paths]
            for heading, paths in pictures.items()}


def _overview(results):
    """Returns mean APE and standard deviation by variant and sequence, for sequences that have
    any."""
    spreads = {variant: {sequence: results.spread(METRIC["ape_m"], sequence, variant)
                         for sequence in results.sequences} for variant in results.variants}
    sequences = [s for s in results.sequences
                 if any(by_sequence[s] is not None for by_sequence in spreads.values())]
    return sequences and {variant: {s: _bar(by_sequence[s]) for s in sequences}
                          for variant, by_sequence in spreads.items()}


def _bar(spread):
    """Returns the height and the deviation of a bar."""
    return (spread.mean, spread.deviation or 0.0) if spread else (math.nan, 0.0)
