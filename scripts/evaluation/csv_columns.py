# SPDX-License-Identifier: BSD-3-Clause
"""Tables of numbers, such as the timing.csv of run_offline."""

import csv

import numpy as np


def read_columns(path):
    """Returns the columns by heading. Raises ValueError with the line if there are no rows or one
    is truncated, as in the files of an unfinished run."""
    rows = []
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.reader(file)
        try:
            names = next(reader, [])
            for row in filter(None, reader):
                rows.append(_numbers(row, len(names)))
        except (ValueError, csv.Error) as error:
            raise ValueError(f"{path}:{reader.line_num}: {error}") from None
    if not rows:
        raise ValueError(f"{path}: no rows")
    return dict(zip(names, np.array(rows).T))


def _numbers(row, columns):
    if len(row) != columns:
        raise ValueError(f"{len(row)} columns, expected {columns}")
    return [float(word) for word in row]
