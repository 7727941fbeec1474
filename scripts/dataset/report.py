# SPDX-License-Identifier: BSD-3-Clause
"""Writes the results down: report.md, runs.csv (every run) and table.csv (over repetitions)."""

import csv
import os

from . import cells
from .markdown import Table
from .paper import TABLES, paper_sequence
from .paper_tables import paper_table
from .results import METRIC, METRICS, Spread
from .variants import DESCRIPTIONS

COVERAGE = METRIC["coverage_percent"]


def write_csv(folder, results):
    """Returns the paths of both files."""
    names = [metric.name for metric in METRICS]
    runs = [[r.run.sequence.name, r.run.variant, r.run.repetition, _status(r)]
            + [_plain(metric.value(r)) for metric in METRICS] for r in results.all()]
    table = []
    for sequence in results.sequences:
        for variant in results.variants:
            repetitions = results.repetitions(sequence, variant)
            spreads = [results.spread(metric, sequence, variant) for metric in METRICS]
            table.append([sequence, variant, len(repetitions),
                          sum(r.failure is not None for r in repetitions)]
                         + [_plain(figure) for spread in spreads for figure in _figures(spread)])
    spread_names = [f"{name}_{part}" for name in names for part in ("median", "min", "max")]
    return [_write_rows(os.path.join(folder, "runs.csv"),
                        ["sequence", "variant", "repetition", "status"] + names, runs),
            _write_rows(os.path.join(folder, "table.csv"),
                        ["sequence", "variant", "repetitions", "failed"] + spread_names, table)]


def markdown_report(results, facts, figures):
    """The report's text.

    facts: pairs of a label and a text about the whole; figures: paths of pictures, relative to the
    report, by heading.
    """
    parts = ["# Odometry over a dataset", _facts(facts), _variants(results), _failures(results),
             _not_compared(results), "## Accuracy", _ape_notes(results),
             *(_metric_table(results, metric) for metric in METRICS if metric.is_error),
             "## Start, speed and lines", *(_metric_table(results, metric) for metric in METRICS
                                            if not metric.is_error and metric.name != COVERAGE.name),
             _paper_part(results), _pictures(figures)]
    return "\n\n".join(part for part in parts if part) + "\n"


def _metric_table(results, metric):
    rows = [[sequence] + [cells.figure(results, metric, sequence, variant)
                          for variant in results.variants] for sequence in results.sequences]
    if all(cell in (cells.NONE, cells.FAILED) for row in rows for cell in row[1:]):
        return f"### {metric.title}\n\nNo run has this figure."
    table = Table(["sequence"] + results.variants, rows)
    means, common = results.means(metric)
    if len(results.sequences) > 1 and common:
        table.rows.append([_mean_label(common, results.sequences)]
                          + [cells.number(means.get(v), metric.decimals) for v in results.variants])
        first = results.variants[0]
        if metric.is_error and means.get(first):
            table.rows.append([f"against {first}"]
                              + [_change(means.get(v), means[first]) for v in results.variants])
    return f"### {metric.title}\n\n{table}"


def _mean_label(common, sequences):
    if len(common) == len(sequences):
        return "**mean**"
    return f"**mean** of the {len(common)} that all variants have"


def _facts(facts):
    return str(Table(["", ""], [list(fact) for fact in facts]))


def _variants(results):
    return str(Table(["variant", "what it is"], [[v, DESCRIPTIONS[v]] for v in results.variants]))


def _failures(results):
    failed = [r for r in results.all() if r.failure is not None]
    if not failed:
        return f"All {len(results.all())} runs ended with a trajectory."
    rows = [[r.run.sequence.name, r.run.variant, str(r.run.repetition), r.failure] for r in failed]
    return (f"## Failed runs\n\n{len(failed)} of {len(results.all())}:\n\n"
            + str(Table(["sequence", "variant", "repetition", "reason"], rows)))


def _not_compared(results):
    rows = [[r.run.sequence.name, r.run.variant, str(r.run.repetition), r.not_compared]
            for r in results.all() if r.not_compared is not None]
    return rows and ("## Not compared with ground truth\n\n"
                     + str(Table(["sequence", "variant", "repetition", "reason"], rows)))


def _ape_notes(results):
    note = ("Poses as estimated at their time, no loop closure. APE after SE3 alignment without"
            " scale, with the coverage in brackets: the share of the ground truth's time that has a"
            " pose (a late start flatters the APE).")
    if max(len(results.repetitions(s, v)) for s in results.sequences for v in results.variants) > 1:
        note += " Figures are medians over the repetitions, with minimum and maximum."
    return note


def _paper_part(results):
    tables = [paper_table(table, results) for table in TABLES]
    if not any(paper_sequence(name) for name in results.sequences):
        return "## Beside the paper\n\nNone of the sequences is one of the paper's."
    return ("## Beside the paper\n\nThe paper's figures, and ours of the recordings whose name has"
            " the name of its sequence: a part of a sequence or a recording made after it is"
            " another task. The paper gives no coverage; its times are of another computer. Our line"
            " extraction is the mean per extraction; images between extractions follow lines"
            " only.\n\n" + "\n\n".join(tables))


def _pictures(figures):
    if not figures:
        return ""
    parts = [f"### {heading}\n\n" + "\n".join(f"![{os.path.basename(p)}]({p})" for p in paths)
             for heading, paths in figures.items()]
    return ("## Figures\n\nOf each sequence: the trajectories coloured by their error; the APE over"
            " time with its RMSE, mean, median and standard deviation; the paths from above; the"
            " translation per axis and its error. Of repetitions, the one with the median APE is"
            " drawn.\n\n" + "\n\n".join(parts))


def _change(value, reference):
    return cells.NONE if value is None else f"{100 * (value / reference - 1):+.0f} %"


def _status(result):
    return result.failure or result.not_compared or "compared"


def _figures(spread):
    spread = spread or Spread(None, None, None)
    return spread.median, spread.low, spread.high


def _plain(value):
    return "" if value is None else f"{value:.10g}"


def _write_rows(path, heading, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heading)
        writer.writerows(rows)
    return path
