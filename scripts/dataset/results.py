# SPDX-License-Identifier: BSD-3-Clause
"""The figures of runs, with means and spread over starts and repetitions."""

import json
import os
import statistics
from dataclasses import dataclass
from typing import Callable, Optional

from evaluate import evaluate
from evaluation import steps
from evaluation.csv_columns import read_columns
from evaluation.run_results import check_whole, read_estimate
from evaluation.trajectory import TrajectoryError, read_trajectory

from .run import Run


@dataclass
class RunResult:
    """Result of a run: `failure` or a summary; `evaluation` or the reason for `not_compared`."""

    run: Run
    failure: Optional[str] = None
    summary: Optional[dict] = None  # summary.json
    line_extraction_ms: Optional[float] = None
    evaluation: Optional[dict] = None  # see evaluate.py
    not_compared: Optional[str] = None
    load: Optional[float] = None  # of the machine, in the last minute of the run
    cores: Optional[int] = None  # of the machine, usable by the run


@dataclass(frozen=True)
class Metric:
    """A figure of a run. `of(result)` may raise KeyError or TypeError if there is none."""

    name: str
    title: str
    decimals: int
    of: Callable[[RunResult], float]
    is_error: bool = False  # against ground truth, the smaller the better

    def value(self, result):
        """Returns the figure, or None if the run has none."""
        try:
            value = self.of(result)
        except (KeyError, TypeError):
            return None
        return None if value is None else float(value)


def _error(name, title, decimals, figure):
    return Metric(name, title, decimals, lambda r: r.evaluation[figure]["rmse"], is_error=True)


def _summary(name, title, decimals, *keys):
    def value(result):
        figure = result.summary
        for key in keys:
            figure = figure[key]
        return figure
    return Metric(name, title, decimals, value)


METRICS = (
    _error("ape_m", "APE RMSE [m]", 4, "ape_m"),
    Metric("coverage_percent", "Coverage: share of the ground truth's time with a pose [%]", 1,
           lambda r: 100 * r.evaluation["coverage"]),
    _error("rpe_1m_m", "RPE over 1 m of the path, RMSE [m]", 4, "rpe_1m_m"),
    _error("rpe_1s_m", "RPE over 1 s, RMSE [m]", 4, "rpe_1s_m"),
    _error("rpe_1s_deg", "RPE over 1 s, RMSE [deg]", 3, "rpe_1s_deg"),
    Metric("yaw_drift_deg", "Yaw error at the end, where there is none at the beginning [deg]", 2,
           lambda r: r.evaluation["yaw_drift_deg"], is_error=True),
    _summary("init_time_s", "Time from the first image to the first pose [s]", 2, "init_time_s"),
    _summary("resets", "Restarts", 0, "resets"),
    _summary("real_time_factor", "Real-time factor", 1, "real_time_factor"),
    _summary("frame_ms", "All of a frame, mean [ms]", 2, "timing_ms", "total", "mean"),
    _summary("line_front_end_ms", "Line front end, mean per frame [ms]", 2, "timing_ms",
             "line_tracking", "mean"),
    Metric("line_extraction_ms", "Line extraction, mean per extraction [ms]", 2,
           lambda r: r.line_extraction_ms),
    _summary("lines_in_window", "Line landmarks in the window, median over the frames", 0,
             "counts_per_frame", "lines_in_window", "median"),
    _summary("lines", "Line landmarks of the whole run", 0, "lines"),
    _summary("merged_lines", "Merged line landmarks of the whole run", 0, "merged_lines"),
    _summary("recognized_lines", "Recognized line landmarks of the whole run", 0,
             "recognized_lines"),
    Metric("manhattan_percent", "Share of the poses with a Manhattan frame [%]", 0,
           lambda r: 100 * r.summary["manhattan_share"]),
    Metric("load", "Load average of the machine in the last minute of the run", 1,
           lambda r: r.load),
)
METRIC = {metric.name: metric for metric in METRICS}


@dataclass(frozen=True)
class Spread:
    """Spread of a figure over starts.

    Each start counts once, with the median of its repetitions: these repeat the trajectory, so only
    the times differ, and the median ignores disturbed ones.
    """

    mean: float
    deviation: Optional[float]  # of the sample, over starts; None for a single one
    low: float  # of all runs
    high: float
    starts: int  # number of starts that have the figure

    @classmethod
    def of(cls, values_by_start):
        """Returns None if no start has the figure."""
        if not values_by_start:
            return None
        medians = [statistics.median(values) for values in values_by_start.values()]
        every = [value for values in values_by_start.values() for value in values]
        deviation = statistics.stdev(medians) if len(medians) > 1 else None
        return cls(statistics.mean(medians), deviation, min(every), max(every), len(medians))


class Results:
    """The results of all runs, by sequence and variant. `duration` [s] is None for complete
    runs."""

    def __init__(self, results, duration=None):
        self._cells = {}
        for result in results:
            key = (result.run.sequence.name, result.run.variant)
            self._cells.setdefault(key, []).append(result)
        self.sequences = list(dict.fromkeys(sequence for sequence, _ in self._cells))
        self.variants = list(dict.fromkeys(variant for _, variant in self._cells))
        self.starts = sorted({result.run.start for result in self.all()})
        self.whole = self.starts == [0.0] and duration is None

    def runs(self, sequence, variant):
        """Returns the runs from every start, with all repetitions."""
        return self._cells.get((sequence, variant), [])

    def lost_starts(self, sequence, variant):
        """Returns the starts from which no run produced a trajectory."""
        runs = self.runs(sequence, variant)
        return sorted({r.run.start for r in runs}
                      - {r.run.start for r in runs if r.failure is None})

    def all(self):
        return [result for cell in self._cells.values() for result in cell]

    def spread(self, metric, sequence, variant):
        return Spread.of(self._values_by_start(metric, sequence, variant))

    def cases(self):
        """Returns all pairs of a sequence and a start."""
        return [(sequence, start) for sequence in self.sequences for start in self.starts]

    def means(self, metric):
        """Returns, for each variant, the mean over cases of its medians over repetitions, for the
        cases in which every variant has the figure; also returns these cases. Ignores variants
        without any figure."""
        medians = {variant: {(sequence, start): statistics.median(values)
                             for sequence in self.sequences for start, values in
                             self._values_by_start(metric, sequence, variant).items()}
                   for variant in self.variants}
        medians = {variant: by_case for variant, by_case in medians.items() if by_case}
        common = [c for c in self.cases() if medians and all(c in m for m in medians.values())]
        if not common:
            return {}, []
        return {variant: statistics.mean(by_case[c] for c in common)
                for variant, by_case in medians.items()}, common

    def _values_by_start(self, metric, sequence, variant):
        """Returns the values of the repetitions that have the figure; omits starts without any."""
        values = {}
        for result in self.runs(sequence, variant):
            value = metric.value(result)
            if value is not None:
                values.setdefault(result.run.start, []).append(value)
        return values

    def typical(self, sequence, variant):
        """Returns the run with the (lower) median APE, or None if none could be compared."""
        ape = METRIC["ape_m"]
        compared = [r for r in self.runs(sequence, variant) if ape.value(r) is not None]
        compared.sort(key=ape.value)
        return compared[(len(compared) - 1) // 2] if compared else None


class Evaluator:
    """Reads the results of runs and compares them with the ground truth of their sequences.

    An unreadable ground truth is ignored; `unreadable` has the reasons by sequence, `steps` the
    steps of the others. `without_steps` ignores the times around these.
    """

    def __init__(self, sequences, duration=None, without_steps=False):
        self._truths, self.steps, self.unreadable = {}, {}, {}
        for sequence in (s for s in sequences if s.truth):
            try:
                truth = read_trajectory(sequence.truth)
                self.steps[sequence.name] = steps.find_steps(truth)
                self._truths[sequence.name] = steps.without_steps(truth) if without_steps else truth
            except (TrajectoryError, OSError) as error:
                self.unreadable[sequence.name] = f"no readable ground truth: {error}"
        self._duration = float("inf") if duration is None else duration

    def result(self, run):
        outcome = run.outcome()
        if outcome["failure"] is not None:
            return RunResult(run, failure=outcome["failure"])
        try:
            result = RunResult(run, load=outcome.get("load_average"), cores=outcome.get("cores"),
                               summary=_read_json(os.path.join(run.folder, "summary.json")),
                               line_extraction_ms=_mean_line_extraction(run.folder))
        except (KeyError, ValueError) as error:
            return RunResult(run, failure=f"damaged results ({error}); remove {run.folder} and run"
                                          " again")
        if run.sequence.truth is None:
            result.not_compared = "no ground truth"
            return result
        if run.sequence.name in self.unreadable:
            result.not_compared = self.unreadable[run.sequence.name]
            return result
        try:
            result.evaluation = self.compare(run, result.summary)[2]
        except TrajectoryError as error:
            result.not_compared = str(error)
        return result

    def compare(self, run, summary):
        """Returns the paired trajectories and their figures, as evaluate() does. Raises
        TrajectoryError."""
        path = os.path.join(run.folder, "trajectory.tum")
        check_whole(path)  # otherwise init_time_s refers to another pose than the first
        estimate = read_estimate(path)
        return evaluate(estimate, self.truth(run, summary, estimate))

    def typical_pairs(self, results, sequence):
        """Returns for each variant the run with the median APE, by a name with its start: the
        aligned estimate and the truth at its poses."""
        typical = [results.typical(sequence, variant) for variant in results.variants]
        return {_label(result.run, results): self.compare(result.run, result.summary)[:2]
                for result in typical if result}

    def truth(self, run, summary, estimate):
        """Returns the ground truth of the processed part, or None. `estimate` has all its poses, in
        IMU time. Raises TrajectoryError."""
        truth = self._truths.get(run.sequence.name)
        if truth is None or (not run.start and self._duration == float("inf")):
            return truth
        return self._during_run(truth, estimate.stamps[0] - summary["init_time_s"])

    def _during_run(self, truth, begin):
        """Returns the part of the ground truth that a run over a part of the recording can
        cover."""
        inside = (truth.stamps >= begin) & (truth.stamps <= begin + self._duration)
        if inside.sum() < 3:
            raise TrajectoryError("no ground truth in the part of the recording that was run")
        return truth.select(inside)


def _label(run, results):
    return run.variant if results.starts == [0.0] else f"{run.variant}, from {run.start:g} s"


def _mean_line_extraction(folder):
    """Returns the mean over frames that extract lines [ms], or None; not every frame does."""
    values = read_columns(os.path.join(folder, "timing.csv"))["line_detection"]
    values = values[values > 0]
    return float(values.mean()) if len(values) else None


def _read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)
