# SPDX-License-Identifier: BSD-3-Clause
"""The report on all results in markdown, and a CSV file of all runs."""

import csv
import os

from evaluation.markdown import Table
from evaluation.steps import AFTER, BEFORE

from .paper import paper_ape, paper_sequence
from .results import FAILED, METRIC, METRICS, NONE
from .variants import DESCRIPTIONS

COVERAGE = METRIC["coverage_percent"]


def markdown_report(results, facts):
    """Returns the text of the report. `facts`: pairs of a label and a text about the whole run."""
    errors = [metric for metric in METRICS if metric.is_error]
    others = [metric for metric in METRICS if not metric.is_error and metric is not COVERAGE]
    parts = ["# Odometry over a dataset", str(Table(["", ""], [list(fact) for fact in facts])),
             str(Table(["variant", "what it is"],
                       [[v, DESCRIPTIONS[v]] for v in results.variants])),
             _reasons("Failed runs", [(r.run, r.failure) for r in results.all()]),
             _reasons("Not compared with ground truth",
                      [(r.run, r.not_compared) for r in results.all()]),
             "## Accuracy", _ape_notes(results),
             *(metric_table(results, metric) for metric in errors), _paper_part(results),
             "## Start and speed", *(metric_table(results, metric) for metric in others)]
    return "\n\n".join(part for part in parts if part) + "\n"


def metric_table(results, metric):
    """Returns one metric by sequence and variant, with means."""
    rows = [[sequence] + [results.cell(metric, sequence, variant) for variant in results.variants]
            for sequence in results.sequences]
    if all(cell in (NONE, FAILED) for row in rows for cell in row[1:]):
        return f"### {metric.title}\n\nNo run has this figure."
    table = Table(["sequence"] + results.variants, rows)
    means, common = results.means(metric)
    cases = results.runs_per_variant
    if cases > 1 and common:
        label = "**mean**" + (f" of the {common} that all variants have" if common < cases else "")
        table.rows.append([label] + [metric.text(means.get(v)) for v in results.variants])
        reference = means.get(results.variants[0])
        if metric.is_error and reference:
            table.rows.append([f"against {results.variants[0]}"]
                              + [_change(means.get(v), reference) for v in results.variants])
    return f"### {metric.title}\n\n{table}"


def _change(value, reference):
    return NONE if value is None else f"{100 * (value / reference - 1):+.0f} %"


def _reasons(heading, reasons):
    rows = [[run.sequence.name, run.variant, f"{run.start:g}", reason]
            for run, reason in reasons if reason is not None]
    if not rows:
        return ""
    table = Table(["sequence", "variant", "start [s]", "reason"], rows)
    return f"## {heading}\n\n{len(rows)} of {len(reasons)}:\n\n{table}"


def _ape_notes(results):
    note = ("Poses as estimated at their time, no loop closure. APE after SE3 alignment without"
            " scale, with the coverage in brackets: the share of the ground truth's time that has a"
            " pose (a late start flatters the APE).")
    runs = results.runs_per_variant // len(results.sequences)
    if runs > 1:
        note += (" Figures are mean ± standard deviation [minimum, maximum] over those of"
                 f" {runs} runs that have them.")
    return note + _step_notes(results) + _shift_notes(results)


def _shift_notes(results):
    largest = max((abs(r.evaluation.get("t_offset_s", 0.0)) for r in results.all()
                   if r.evaluation), default=0.0)
    if not largest:
        return ""
    return (" Stamps are shifted by the `td` that each run ended with, by up to"
            f" {1000 * largest:.2f} ms.")


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


def _paper_part(results):
    """Returns the APE of whole sequences of the paper beside its own."""
    names = [name for name in results.sequences if paper_sequence(name) == name]
    if not names or not results.whole:
        return ""
    rows = [[name, *(f"{ape:.2f}" for ape in paper_ape(name).values()),
             *(results.cell(METRIC["ape_m"], name, variant) for variant in results.variants)]
            for name in names]
    heading = ["sequence", *(f"paper: {column}" for column in paper_ape(names[0])),
               *(f"ours: {variant}" for variant in results.variants)]
    return ("### APE RMSE [m] beside the paper\n\nThe paper gives no coverage."
            f"\n\n{Table(heading, rows)}")


def write_csv(folder, results):
    """Writes all runs with all figures to runs.csv; returns its path."""
    path = os.path.join(folder, "runs.csv")
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["sequence", "variant", "start_s", "repetition", "status", *METRIC])
        for result in results.all():
            run, status = result.run, result.failure or result.not_compared or "compared"
            writer.writerow([run.sequence.name, run.variant, f"{run.start:g}", run.repetition,
                             status, *(_plain(metric.value(result)) for metric in METRICS)])
    return path


def _plain(value):
    return "" if value is None else f"{value:.10g}"
