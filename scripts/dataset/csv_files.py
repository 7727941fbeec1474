# SPDX-License-Identifier: BSD-3-Clause
"""The results for spreadsheets: every run, and medians over repetitions."""

import csv
import os

from .results import METRICS, Spread


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
