# SPDX-License-Identifier: BSD-3-Clause
"""CSV files for spreadsheets: all runs, and means and spread over starts."""

import csv
import os

from .results import METRICS


def write_csv(folder, results):
    """Writes both files and returns their paths."""
    runs = [_run_row(result) for result in results.all()]
    table = [_table_row(results, sequence, variant)
             for sequence in results.sequences for variant in results.variants]
    names = [metric.name for metric in METRICS]
    spread_names = [f"{name}_{part}" for name in names
                    for part in ("mean", "std", "min", "max", "starts")]
    return [_write_rows(os.path.join(folder, "runs.csv"),
                        ["sequence", "variant", "start_s", "repetition", "status"] + names, runs),
            _write_rows(os.path.join(folder, "table.csv"),
                        ["sequence", "variant", "starts", "starts_without_trajectory", "runs",
                         "failed"] + spread_names, table)]


def _run_row(result):
    run, status = result.run, result.failure or result.not_compared or "compared"
    return ([run.sequence.name, run.variant, _plain(run.start), run.repetition, status]
            + [_plain(metric.value(result)) for metric in METRICS])


def _table_row(results, sequence, variant):
    runs = results.runs(sequence, variant)
    failed = sum(r.failure is not None for r in runs)
    spreads = [results.spread(metric, sequence, variant) for metric in METRICS]
    return ([sequence, variant, len({r.run.start for r in runs}),
             len(results.lost_starts(sequence, variant)), len(runs), failed]
            + [_plain(figure) for spread in spreads for figure in _figures(spread)])


def _figures(spread):
    if spread is None:
        return [None, None, None, None, 0]
    return [spread.mean, spread.deviation, spread.low, spread.high, spread.starts]


def _plain(value):
    return "" if value is None else f"{value:.10g}"


def _write_rows(path, heading, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heading)
        writer.writerows(rows)
    return path
