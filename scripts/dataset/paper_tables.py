# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the paper with our results next to them."""

import statistics
from dataclasses import dataclass
from typing import Callable, Optional

from . import cells
from .markdown import Table
from .paper import SEQUENCES, paper_sequence
from .results import METRIC


@dataclass
class _Column:
    """`value` and `text` take the paper's name of a sequence and that of our recording, which may
    be None."""

    heading: str
    value: Callable[[str, Optional[str]], Optional[float]]
    text: Callable[[str, Optional[str]], str]
    decimals: int = 2


def paper_table(table, results):
    """Returns one table of the paper as markdown: its columns, then ours. Our recording is assigned
    to the sequence whose name it contains; sequences without one have a line as well. Differences
    to the paper and averages use complete sequences only: recordings with exactly that name,
    uncut."""
    lines = [(sequence, name) for sequence in SEQUENCES
             for name in [n for n in results.sequences if paper_sequence(n) == sequence] or [None]]
    paper, ours = _paper_columns(table), _our_columns(table, results)
    rows = [[sequence] + [column.text(sequence, name) for column in paper]
            + [name or cells.NONE] + [column.text(sequence, name) for column in ours]
            for sequence, name in lines]
    rows += _averages([line for line in lines if _is_the_same(*line, results)], paper, ours)
    heading = ["sequence", *(c.heading for c in paper), "recording", *(c.heading for c in ours)]
    return f"### {table.title}\n\n{Table(heading, rows)}"


def _is_the_same(sequence, name, results):
    """Returns whether our recording is, by its name and length, the paper's sequence."""
    return name == sequence and results.whole


def _paper_columns(table):
    first, second = table.columns.values()
    values = {**{heading: lambda sequence, _, figures=figures: figures[sequence]
                 for heading, figures in table.columns.items()},
              "difference": lambda sequence, _: first[sequence] - second[sequence]}
    return [_Column(heading, value, lambda *line, value=value: f"{value(*line):.2f}")
            for heading, value in values.items()]


def _our_columns(table, results):
    metric = METRIC[table.metric]

    def column(variant):
        def value(_, name):
            spread = name and results.spread(metric, name, variant)
            return spread.mean if spread else None

        def text(_, name):
            return cells.figure(results, metric, name, variant) if name else cells.NONE

        return _Column(f"ours: {variant}", value, text, metric.decimals)

    columns = [column(variant) for variant in table.variants]
    return columns + [_our_difference(table, columns, results)]


def _our_difference(table, ours, results):
    """Returns the difference of our two variants, or of the paper's first column and our only
    variant."""
    heading, first = "ours: difference", ours[0].value
    if len(ours) == 1:
        name, figures = next(iter(table.columns.items()))
        heading = f"{name} - ours"

        def first(sequence, name):
            return figures[sequence] if _is_the_same(sequence, name, results) else None

    def value(*line):
        before, after = first(*line), ours[-1].value(*line)
        return None if before is None or after is None else before - after

    decimals = ours[0].decimals
    return _Column(heading, value, lambda *line: cells.number(value(*line), decimals), decimals)


def _averages(lines, paper, ours):
    """Returns rows of averages over all sequences and, if different, over those `lines` for which
    all our columns have a figure."""
    complete = [line for line in lines if all(c.value(*line) is not None for c in ours)]
    every = [(sequence, None) for sequence in SEQUENCES]
    have_all = {sequence for sequence, _ in complete} == set(SEQUENCES)
    rows = [["average"] + _means(paper, every) + [cells.NONE]
            + (_means(ours, complete) if have_all else [cells.NONE] * len(ours))]
    if complete and not have_all:
        rows.append(["average of ours"] + _means(paper, complete)
                    + [f"of {len(complete)}"] + _means(ours, complete))
    return rows


def _means(columns, lines):
    return [cells.number(statistics.mean(c.value(*line) for line in lines), c.decimals)
            for c in columns]
