# SPDX-License-Identifier: BSD-3-Clause
"""Markdown tables that are readable as plain text."""

from dataclasses import dataclass
from typing import List


@dataclass
class Table:
    heading: List[str]
    rows: List[List[str]]

    def __str__(self):
        rows = [[_escaped(cell) for cell in row] for row in [self.heading] + self.rows]
        widths = [max(3, *map(len, column)) for column in zip(*rows)]
        lines = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |"
                 for row in rows]
        lines.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
        return "\n".join(lines)


def _escaped(cell):
    return cell.replace("|", "\\|").replace("\n", " ")
