# SPDX-License-Identifier: BSD-3-Clause
"""The figures of runs, with means and spread over starts and repetitions."""

import json
import os
import statistics
from dataclasses import dataclass
from typing import Callable, Optional

from evaluate import evaluate
from evaluation import steps
from evaluation.run_results import check_whole, read_estimate
from evaluation.trajectory import TrajectoryError, read_trajectory

from .run import Run

NONE = "–"
FAILED = "**failed**"


@dataclass
class RunResult:
    """Result of a run: `failure` or a summary; `evaluation` or the reason for `not_compared`."""

    run: Run
    failure: Optional[str] = None
    summary: Optional[dict] = None  # summary.json
    evaluation: Optional[dict] = None  # see evaluate.py
    not_compared: Optional[str] = None


@dataclass(frozen=True)
class Metric:
    """A figure of a run. `of(result)` may raise KeyError or TypeError if there is none."""

    name: str
    title: str
    decimals: int
    of: Callable[[RunResult], float]
    is_error: bool = True  # against ground truth, the smaller the better

    def value(self, result):
        """Returns the figure, or None if the run has none."""
        try:
            value = self.of(result)
        except (KeyError, TypeError):
            return None
        return None if value is None else float(value)

    def text(self, value):
        return NONE if value is None else f"{value:.{self.decimals}f}"


METRICS = (
    Metric("ape_m", "APE RMSE [m]", 4, lambda r: r.evaluation["ape_m"]["rmse"]),
    Metric("coverage_percent", "Coverage: share of the ground truth's time with a pose [%]", 1,
           lambda r: 100 * r.evaluation["coverage"], is_error=False),
    Metric("rpe_1m_m", "RPE over 1 m of the path, RMSE [m]", 4,
           lambda r: r.evaluation["rpe_1m_m"]["rmse"]),
    Metric("rpe_1s_deg", "RPE over 1 s, RMSE [deg]", 3,
           lambda r: r.evaluation["rpe_1s_deg"]["rmse"]),
    Metric("scale_percent", "Scale error of pieces of 5 s, mean of absolute errors [%]", 2,
           lambda r: r.evaluation["local_scale"]["mean_absolute_error_percent"]),
    Metric("yaw_drift_deg", "Yaw error at the end, where there is none at the beginning [deg]", 2,
           lambda r: r.evaluation["yaw_drift_deg"]),
    Metric("init_time_s", "Time from the first image to the first pose [s]", 2,
           lambda r: r.summary["init_time_s"], is_error=False),
    Metric("resets", "Restarts", 0, lambda r: r.summary["resets"], is_error=False),
    Metric("real_time_factor", "Real-time factor", 1, lambda r: r.summary["real_time_factor"],
           is_error=False),
    Metric("frame_ms", "All of a frame, mean [ms]", 2,
           lambda r: r.summary["timing_ms"]["total"]["mean"], is_error=False),
    Metric("frame_p99_ms", "All of a frame, 99th percentile [ms]", 2,
           lambda r: r.summary["timing_ms"]["total"]["p99"], is_error=False),
)
METRIC = {metric.name: metric for metric in METRICS}


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
        self.runs_per_variant = len(self.all()) // len(self.variants)
        self.whole = duration is None and not any(result.run.start for result in self.all())

    def all(self):
        return [result for cell in self._cells.values() for result in cell]

    def cell(self, metric, sequence, variant):
        """Returns the mean over runs with standard deviation and range, the number of runs that
        have the figure, failures, and for the APE the coverage."""
        runs = self._cells.get((sequence, variant), [])
        failed = sum(r.failure is not None for r in runs)
        if runs and failed == len(runs):
            return FAILED
        values = self._values(metric, sequence, variant)
        if not values:
            return metric.text(None)
        text = metric.text(statistics.mean(values))
        if len(runs) > 1:
            deviation = f" ± {metric.text(statistics.stdev(values))}" if len(values) > 1 else ""
            text += f"{deviation} [{metric.text(min(values))}, {metric.text(max(values))}]"
        if metric.name == "ape_m":
            coverage = self._values(METRIC["coverage_percent"], sequence, variant)
            text += f" ({statistics.mean(coverage):.0f} %)"
        if len(runs) > 1:
            text += f" over {len(values)} run" + "s" * (len(values) > 1)
        return text + (f", {failed} of {len(runs)} failed" if failed else "")

    def means(self, metric):
        """Returns the mean of each variant over the runs whose sequence and start have the figure
        in every variant, and the number of these. Ignores variants without any figure."""
        by_variant = {}
        for result in self.all():
            value = metric.value(result)
            if value is not None:
                case = result.run.sequence.name, result.run.start, result.run.repetition
                by_variant.setdefault(result.run.variant, {})[case] = value
        if not by_variant:
            return {}, 0
        common = set.intersection(*(set(values) for values in by_variant.values()))
        return {variant: statistics.mean(values[case] for case in common)
                for variant, values in by_variant.items() if common}, len(common)

    def _values(self, metric, sequence, variant):
        values = (metric.value(result) for result in self._cells.get((sequence, variant), []))
        return [value for value in values if value is not None]


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
        failure = run.outcome()["failure"]
        if failure is not None:
            return RunResult(run, failure=failure)
        try:
            with open(os.path.join(run.folder, "summary.json"), encoding="utf-8") as file:
                result = RunResult(run, summary=json.load(file))
        except ValueError as error:
            return RunResult(run, failure=f"damaged results ({error}); remove {run.folder} and run"
                                          " again")
        name = run.sequence.name
        if name not in self._truths:
            result.not_compared = self.unreadable.get(name, "no ground truth")
            return result
        try:
            result.evaluation = self.compare(run, result.summary)
        except TrajectoryError as error:
            result.not_compared = str(error)
        return result

    def compare(self, run, summary):
        """Returns the figures of evaluate(). Raises TrajectoryError."""
        path = os.path.join(run.folder, "trajectory.tum")
        check_whole(path)  # otherwise init_time_s refers to another pose than the first
        estimate = read_estimate(path)
        truth = self._truths[run.sequence.name]
        if run.start or self._duration < float("inf"):
            truth = self._during_run(truth, estimate.stamps[0] - summary["init_time_s"])
        return evaluate(estimate, truth)[2]

    def _during_run(self, truth, begin):
        """Returns the part of the ground truth that a run over a part of the recording can
        cover."""
        inside = (truth.stamps >= begin) & (truth.stamps <= begin + self._duration)
        if inside.sum() < 3:
            raise TrajectoryError("no ground truth in the part of the recording that was run")
        return truth.select(inside)
