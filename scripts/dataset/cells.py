# SPDX-License-Identifier: BSD-3-Clause
"""Text of single cells of the report's tables."""

from .results import METRIC

NONE = "–"
FAILED = "**failed**"


def number(value, decimals):
    return NONE if value is None else f"{value:.{decimals}f}"


def figure(results, metric, sequence, variant):
    """Returns the mean with its spread over starts, the number of starts that have the figure,
    failures, and for the APE the coverage."""
    runs = results.runs(sequence, variant)
    failed = sum(r.failure is not None for r in runs)
    if not runs:
        return NONE
    if failed == len(runs):
        return FAILED
    spread = results.spread(metric, sequence, variant)
    text = _mean(spread, metric.decimals, len(runs))
    coverage = results.spread(METRIC["coverage_percent"], sequence, variant)
    if metric.name == "ape_m" and coverage is not None:
        text += f" ({coverage.mean:.0f} %)"
    if spread is not None and len(results.starts) > 1:
        text += f" over {spread.starts} start" + "s" * (spread.starts > 1)
    return text + (f", {failed} of {len(runs)} failed" if failed else "")


def _mean(spread, decimals, runs):
    if spread is None:
        return NONE
    text = number(spread.mean, decimals)
    if spread.deviation is not None:
        text += f" ± {number(spread.deviation, decimals)}"
    if runs > 1:
        text += f" [{number(spread.low, decimals)}, {number(spread.high, decimals)}]"
    return text
