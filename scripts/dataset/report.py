# SPDX-License-Identifier: BSD-3-Clause
"""The report on all results, in markdown."""

import os

from evaluation.steps import AFTER, BEFORE

from . import cells
from .markdown import Table
from .paper import TABLES, paper_sequence
from .paper_tables import paper_table
from .results import METRIC, METRICS
from .variants import DESCRIPTIONS

COVERAGE = METRIC["coverage_percent"]


def markdown_report(results, facts, figures):
    """Returns the text of the report.

    facts: pairs of a label and a text about the whole run; figures: picture paths relative to the
    report, by heading.
    """
    errors = [metric for metric in METRICS if metric.is_error]
    others = [metric for metric in METRICS if not metric.is_error and metric is not COVERAGE]
    parts = ["# Odometry over a dataset", _facts(facts), _variants(results), _failures(results),
             _not_compared(results), "## Accuracy", _ape_notes(results),
             *(_metric_table(results, metric) for metric in errors), "## Start, speed and lines",
             _time_notes(results),
             *(_metric_table(results, metric) for metric in others),
             _paper_part(results, _time_notes(results)), _pictures(figures)]
    return "\n\n".join(part for part in parts if part) + "\n"


def _metric_table(results, metric):
    rows = [[sequence] + [cells.figure(results, metric, sequence, variant)
                          for variant in results.variants] for sequence in results.sequences]
    if all(cell in (cells.NONE, cells.FAILED) for row in rows for cell in row[1:]):
        return f"### {metric.title}\n\nNo run has this figure."
    table = Table(["sequence"] + results.variants, rows)
    means, common = results.means(metric)
    if len(results.cases()) > 1 and common:
        table.rows.append([_mean_label(common, results)]
                          + [cells.number(means.get(v), metric.decimals) for v in results.variants])
        first = results.variants[0]
        if metric.is_error and means.get(first):
            table.rows.append([f"against {first}"]
                              + [_change(means.get(v), means[first]) for v in results.variants])
    return f"### {metric.title}\n\n{table}"


def _mean_label(common, results):
    if len(common) == len(results.cases()):
        return "**mean**"
    starts = " starts" if len(results.starts) > 1 else ""
    return f"**mean** of the {len(common)}{starts} that all variants have"


def _facts(facts):
    return str(Table(["", ""], [list(fact) for fact in facts]))


def _variants(results):
    return str(Table(["variant", "what it is"], [[v, DESCRIPTIONS[v]] for v in results.variants]))


def _failures(results):
    failed = [r for r in results.all() if r.failure is not None]
    if not failed:
        return f"All {len(results.all())} runs ended with a trajectory."
    return (f"## Failed runs\n\n{len(failed)} of {len(results.all())}:\n\n"
            + _reasons([(r.run, r.failure) for r in failed]))


def _not_compared(results):
    reasons = [(r.run, r.not_compared) for r in results.all() if r.not_compared is not None]
    return reasons and "## Not compared with ground truth\n\n" + _reasons(reasons)


def _reasons(reasons):
    rows = [[run.sequence.name, run.variant, f"{run.start:g}", str(run.repetition), reason]
            for run, reason in reasons]
    return str(Table(["sequence", "variant", "start [s]", "repetition", "reason"], rows))


def _ape_notes(results):
    note = ("Poses as estimated at their time, no loop closure. APE after SE3 alignment without"
            " scale, with the coverage in brackets: the share of the ground truth's time that has a"
            " pose (a late start flatters the APE).")
    if len(results.starts) > 1:
        note += (" Figures are mean ± standard deviation [minimum, maximum] over those of"
                 f" {len(results.starts)} starts that have them.")
    note += _step_notes(results)
    shifts = [abs(r.evaluation.get("t_offset_s", 0.0)) for r in results.all() if r.evaluation]
    if any(shifts):
        note += (" Stamps are shifted by the `td` that each run ended with, by up to"
                 f" {1000 * max(shifts):.2f} ms.")
    if max(r.run.repetition for r in results.all()) > 1:
        note += (" Repetitions count with their median, and in brackets with their minimum and"
                 " maximum.")
    return note


def _step_notes(results):
    """Returns a note on steps in ground truths, and whether the times around them are ignored."""
    sizes = {}  # by sequence and timestamp
    compared = [r for r in results.all() if r.evaluation and r.evaluation["ground_truth_steps"]]
    for r in compared:
        sizes.setdefault(r.run.sequence.name, {}).update(
            (step["stamp"], step["size"]) for step in r.evaluation["ground_truth_steps"])
    if not sizes:
        return ""
    named = "; ".join(f"{name}: {len(by_stamp)}, of up to {1000 * max(by_stamp.values()):.0f} mm"
                      for name, by_stamp in sizes.items())
    if compared[0].evaluation["without_steps"]:
        return (f" Ground truth without {BEFORE:g} s before and {AFTER:g} s after each of its steps"
                f" ({named}); one transform aligns what is between.")
    return (f" **The ground truth has steps** ({named}), and drifts before them; `--without-steps`"
            " leaves them out.")


def _time_notes(results):
    """Returns a warning if other work slowed down the runs."""
    known = [(r.load, r.cores) for r in results.all() if None not in (r.load, r.cores)]
    busy = [(load, cores) for load, cores in known if load > cores + 1]
    if not busy:
        return ""
    load, cores = max(busy)
    return (f"**The times are too long:** {len(busy)} of {len(known)} runs shared their machine"
            f" with other work (load average up to {load:.0f}, on {cores} cores).")


def _paper_part(results, time_notes):
    tables = [paper_table(table, results) for table in TABLES]
    if not any(paper_sequence(name) for name in results.sequences):
        return "## Beside the paper\n\nNone of the sequences is one of the paper's."
    return ("## Beside the paper\n\nThe paper's figures, and ours of the recordings whose name has"
            " the name of its sequence. A part of a sequence, or a recording made after it, is"
            " another task: only recordings with just that name, run uncut, have a difference to"
            " the paper and count in averages. The paper gives no coverage; its times are of"
            " another computer. Ours are means over the images that lines are extracted from; in"
            " the others they are only followed.\n\n"
            + "\n\n".join([time_notes] * bool(time_notes) + tables))


def _pictures(figures):
    if not figures:
        return ""
    parts = [f"### {heading}\n\n" + "\n".join(f"![{os.path.basename(p)}]({p})" for p in paths)
             for heading, paths in figures.items()]
    return ("## Figures\n\nOf each sequence: the trajectories colored by their error; the APE over"
            " time with its RMSE, mean, median and standard deviation; the paths from above; the"
            " translation per axis and its error. Of starts and repetitions, the one with the"
            " median APE is drawn.\n\n" + "\n\n".join(parts))


def _change(value, reference):
    return cells.NONE if value is None else f"{100 * (value / reference - 1):+.0f} %"
