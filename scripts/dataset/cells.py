# SPDX-License-Identifier: BSD-3-Clause
"""The text of single cells of the report's tables."""

from .results import METRIC

NONE = "–"
FAILED = "**failed**"


def number(value, decimals):
    return NONE if value is None else f"{value:.{decimals}f}"


def figure(results, metric, sequence, variant):
    """A median with its spread over repetitions, the coverage beside the APE, and failures."""
    repetitions = results.repetitions(sequence, variant)
    failed = sum(r.failure is not None for r in repetitions)
    if not repetitions:
        return NONE
    if failed == len(repetitions):
        return FAILED
    text = _median(results.spread(metric, sequence, variant), metric.decimals, len(repetitions))
    coverage = results.spread(METRIC["coverage_percent"], sequence, variant)
    if metric.name == "ape_m" and coverage is not None:
        text += f" ({coverage.median:.0f} %)"
    return text + (f", {failed} of {len(repetitions)} failed" if failed else "")


def _median(spread, decimals, repetitions):
    if spread is None:
        return NONE
    text = number(spread.median, decimals)
    if repetitions > 1:
        text += f" [{number(spread.low, decimals)}, {number(spread.high, decimals)}]"
    return text
