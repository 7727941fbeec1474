#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes one self-contained HTML page on a run of run_offline: trajectory, points, lines by axis
and loops in 3-D, errors, counts and timings over time, and images with tracks."""

import argparse
import os
import sys

from dataset.sequences import find_truth
from evaluation.trajectory import TrajectoryError, read_truth
from pages.run_folder import RunFolder
from pages.run_page import run_page


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", metavar="RUN_DIR", help="folder that run_offline wrote")
    parser.add_argument("--groundtruth", metavar="FILE",
                        help="TUM file, EuRoC csv or ASL folder (default: that of the recording, if"
                        " it is still where it was)")
    parser.add_argument("--output", metavar="FILE", help="the page (default: RUN_DIR/run.html)")
    return parser.parse_args(arguments)


def main(arguments=None):
    options = parse_arguments(arguments)
    output = options.output or os.path.join(options.run, "run.html")
    try:
        run = RunFolder.read(options.run)
        recording = run.summary.get("input")
        truth = options.groundtruth or (recording and find_truth(recording))
        text = run_page(run, truth and read_truth(truth))
        with open(output, "w", encoding="utf-8") as file:
            file.write(text)
    except (TrajectoryError, OSError) as error:
        print(f"show_run.py: {error}", file=sys.stderr)
        return 1
    except ImportError as error:
        print(f"show_run.py: {error}; install python3-plotly", file=sys.stderr)
        return 1
    print(output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
