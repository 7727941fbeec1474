#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a short table of a results folder: summary.json and, if present, evaluation.json."""

import argparse
import json
import os
import sys


def rows(summary, evaluation):
    """Returns pairs of label and text; `evaluation` is None without ground truth."""
    def number(key, text):
        value = summary.get(key)
        return "-" if value is None else text.format(value)

    table = [
        ("poses", number("poses", "{} of ") + number("images", "{} images")),
        ("first pose", number("init_time_s", "{:.2f} s after the first image")),
        ("path", number("path_length_m", "{:.2f} m")),
        ("speed", number("real_time_factor", "{:.1f} x real time")),
        ("points", number("points", "{}")),
        ("lines", number("lines", "{}")),
        ("restarts", number("resets", "{}")),
    ]
    if evaluation:
        table.insert(2, ("APE", f"{evaluation['ape_m']['rmse']:.4f} m rmse"))
        table.insert(3, ("coverage", f"{100 * evaluation['coverage']:.1f} % of the ground truth"))
    return table


def read_json(path):
    """Returns the object in the file, or None if there is no file; raises ValueError if it is
    damaged."""
    if not os.path.isfile(path):
        return None
    try:
        with open(path, encoding="utf-8") as file:
            return dict(json.load(file))
    except (TypeError, ValueError) as error:
        raise ValueError(f"{path}: damaged ({error})") from None


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="with summary.json")
    folder = parser.parse_args(arguments).folder
    try:
        summary = read_json(os.path.join(folder, "summary.json"))
        if summary is None:
            raise ValueError(f"{folder}: no summary.json")
        table = rows(summary, read_json(os.path.join(folder, "evaluation.json")))
    except (OSError, ValueError) as error:
        print(f"show_result.py: {error}", file=sys.stderr)
        return 1
    except (KeyError, TypeError) as error:
        print(f"show_result.py: {folder}: a figure is missing or damaged ({error!r})",
              file=sys.stderr)
        return 1
    for label, text in table:
        print(f"{label:12}{text}")
    for parent, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            print(f"{'':12}{os.path.join(parent, name)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
