#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the odometry over many recordings, in several variants, and compares the results.

Writes to the output folder: report.md, runs.csv, ape.png, and runs/ with the results of every run.
The same command again executes only missing runs; Ctrl-C stops it.
"""

import argparse
import contextlib
import datetime
import fcntl
import math
import os
import signal
import sys

from dataset.environment import (check_config, find_config, find_program, machine,
                                 usable_cores)
from dataset.errors import DatasetError
from dataset.plot import write_plot
from dataset.report import markdown_report, metric_table, write_csv
from dataset.results import METRIC, Evaluator, Results
from dataset.run import Run, Settings, run_all
from dataset.sequences import find_sequences, select_sequences
from dataset.variants import VARIANTS, describe_variants, select_variants
from evaluation.steps import describe as describe_steps
from evaluation.trajectory import TrajectoryError

INTERRUPTED = 130  # exit code, as of shells
THREADS_PER_RUN = 2  # of run_offline


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, epilog="variants:\n" + describe_variants(),
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", nargs="+", metavar="FOLDER",
                        help="folders with ROS bags or EuRoC ASL folders at any depth, or single"
                        " bags; ground truth inside of X or beside it as X.tum or X.csv")
    parser.add_argument("--sequences", nargs="+", metavar="NAME",
                        help="only these: names, prefixes or wildcards")
    parser.add_argument("--variants", nargs="+", metavar="NAME", default=list(VARIANTS),
                        help="only these (default: all)")
    parser.add_argument("--starts", type=_seconds, nargs="+", metavar="S", default=[0.0],
                        help="run each sequence and variant from each of these [s after the first"
                        " image]: the tables have means and spreads over them")
    parser.add_argument("--repetitions", type=_positive, default=1, metavar="N",
                        help="repeat each run (default: 1; trajectories repeat exactly, times do"
                        " not)")
    parser.add_argument("--duration", type=_seconds, metavar="S", help="process this much [s]")
    parser.add_argument("--without-steps", action="store_true",
                        help="exclude the times around steps of the ground truth, as evaluate.py"
                        " does")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: euroc.yaml)")
    parser.add_argument("--set", action="append", default=[], type=_override, metavar="KEY=VALUE",
                        help="a change to the configuration of all variants; keys that a variant"
                        " sets itself keep its values")
    parser.add_argument("--output", default=os.path.join("output", "dataset"), metavar="DIR",
                        help="folder for everything (default: output/dataset)")
    parser.add_argument("--jobs", type=_positive, metavar="N",
                        default=max(1, usable_cores() // THREADS_PER_RUN),
                        help="runs at the same time (default: %(default)s, one per"
                        f" {THREADS_PER_RUN} cores; more of them disturb the times)")
    parser.add_argument("--run-offline", metavar="FILE",
                        help="path of run_offline, if it is not found")
    options = parser.parse_args(arguments)
    options.starts = sorted(set(options.starts))
    return options


def _positive(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"expected a whole number of at least 1 instead of {text}")
    return int(text)


def _seconds(text):
    with contextlib.suppress(ValueError):
        if math.isfinite(float(text)) and float(text) >= 0:
            return float(text)
    raise argparse.ArgumentTypeError(f"expected seconds, at least 0, instead of {text}")


def _override(text):
    key, equals, value = text.partition("=")
    if not key or not equals:
        raise argparse.ArgumentTypeError(f"expected key=value instead of {text}")
    return key, value


def plan(options):
    """Returns the settings, their fingerprint, the sequences, and all runs, finished or not."""
    sequences = find_sequences(options.recordings)
    if options.sequences:
        sequences = select_sequences(sequences, options.sequences)
    settings = Settings(find_program(options.run_offline), find_config(options.config),
                        os.path.abspath(options.output), options.duration, dict(options.set))
    fingerprint = settings.fingerprint()
    runs = [Run(settings, fingerprint, sequence, variant, VARIANTS[variant], start, repetition)
            for repetition in range(1, options.repetitions + 1) for start in options.starts
            for sequence in sequences for variant in select_variants(options.variants)]
    return settings, fingerprint, sequences, runs


@contextlib.contextmanager
def locked(folder):
    """Creates the folder and locks it against other instances of this program."""
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, ".lock"), "w", encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise DatasetError(f"{folder}: another run_dataset.py works there; wait for it or give"
                               " another --output") from None
        yield


def announce(sequences, evaluator, runs, unfinished):
    for sequence in sequences:
        if sequence.name in evaluator.unreadable:
            print(f"run_dataset.py: {sequence.name}: {evaluator.unreadable[sequence.name]}; it runs"
                  " without ground truth", file=sys.stderr)
        if evaluator.steps.get(sequence.name):
            print(f"run_dataset.py: {sequence.name}: the ground truth has steps of"
                  f" {describe_steps(evaluator.steps[sequence.name])}", file=sys.stderr)
        truth = sequence.truth or "none, so no APE (put it beside the recording as"\
            f" {sequence.name}.tum or .csv)"
        print(f"{sequence.name}: {sequence.path}; ground truth: {truth}")
    print(f"{len(runs)} runs, {len(runs) - len(unfinished)} of them finished before", flush=True)


def describe(result):
    """Describes the outcome of a run in one line."""
    if result.failure is not None:
        return f"FAILED: {result.failure}"
    speed = f"{result.summary['real_time_factor']:.1f} x real time"
    if result.evaluation is None:
        return f"{result.not_compared}, {speed}"
    return (f"APE {METRIC['ape_m'].value(result):.4f} m, coverage"
            f" {METRIC['coverage_percent'].value(result):.0f} %, {speed}")


def facts(options, settings, fingerprint):
    """Returns the facts about the whole run for the report."""
    starts = ", ".join(f"{start:g}" for start in options.starts)
    part = "all" if starts == "0" and options.duration is None else (
        f"from {starts} s on" + ("" if options.duration is None else f", {options.duration:g} s"))
    overrides = " ".join(f"{key}={value}" for key, value in settings.overrides.items())
    return [("recordings", ", ".join(options.recordings)),
            ("part of each", part),
            ("configuration", settings.config + (f" with {overrides}" if overrides else "")),
            ("program", f"{settings.program}, SHA-256 {fingerprint['program_sha256'][:12]}"),
            ("machine", f"{machine()}; {options.jobs} runs at a time; load average of the last 15"
                        f" minutes: {os.getloadavg()[2]:.1f}"),
            ("written", datetime.datetime.now().strftime("%Y-%m-%d %H:%M"))]


def carry_out(runs, jobs, evaluator):
    """Executes runs and prints the outcome of each."""
    ended = []

    def report(run, seconds):
        ended.append(run)
        print(f"[{len(ended)}/{len(runs)}] {run.name}: {describe(evaluator.result(run))}"
              f" ({seconds:.0f} s)", file=sys.stderr, flush=True)

    run_all(runs, jobs, report)


def write_comparison(folder, results, about):
    """Writes the report, the table of runs and the plot; returns their paths."""
    report = os.path.join(folder, "report.md")
    with open(report, "w", encoding="utf-8") as file:
        file.write(markdown_report(results, about))
    return report, write_csv(folder, results), write_plot(folder, results)


def run_dataset(options):
    settings, fingerprint, sequences, runs = plan(options)
    evaluator = Evaluator(sequences, options.duration, options.without_steps)
    with locked(settings.output):
        unfinished = [run for run in runs if not run.is_finished()]
        if unfinished:
            check_config(settings.program, settings.config, settings.overrides)
        announce(sequences, evaluator, runs, unfinished)
        carry_out(unfinished, options.jobs, evaluator)
        if settings.fingerprint() != fingerprint:
            print("run_dataset.py: the program or the configuration has changed meanwhile, so runs"
                  " may not be comparable; the same command repeats them all", file=sys.stderr)
        results = Results((evaluator.result(run) for run in runs), options.duration)
        files = write_comparison(settings.output, results, facts(options, settings, fingerprint))
        print(metric_table(results, METRIC["ape_m"]), *files, sep="\n")
    failures = sum(result.failure is not None for result in results.all())
    if failures:
        print(f"run_dataset.py: {failures} of {len(runs)} runs failed, see the report",
              file=sys.stderr)
    return 1 if failures else 0


def main(arguments=None):
    options = parse_arguments(arguments)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return run_dataset(options)
    except (DatasetError, TrajectoryError) as error:
        print(f"run_dataset.py: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"run_dataset.py: {error.filename or options.output}: {error.strerror or error}",
              file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("run_dataset.py: interrupted; run the same command again to continue",
              file=sys.stderr)
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
