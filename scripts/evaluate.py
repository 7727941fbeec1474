#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares a trajectory with ground truth: APE and RPE as evo computes them, and coverage."""

import argparse
import contextlib
import dataclasses
import json
import math
import sys

import numpy as np

from evaluation import consistency, evo_backend, metrics, mistakes, steps
from evaluation.run_results import read_estimate
from evaluation.side_by_side import side_by_side
from evaluation.trajectory import TrajectoryError, read_truth

FIGURES = ("rmse", "mean", "median", "std", "min", "max")
LABELS = {
    "ape_m": "APE [m]",
    "ape_rotation_deg": "APE rotation [deg]",
    "ape_yaw_deg": "APE yaw [deg]",
    "rpe_1m_m": "RPE over 1 m [m]",
    "rpe_1m_deg": "RPE over 1 m [deg]",
    "rpe_1s_m": "RPE over 1 s [m]",
    "rpe_1s_deg": "RPE over 1 s [deg]",
}


def evaluate(estimate, truth, align="se3", max_diff=metrics.MAX_DIFFERENCE,
             max_gap=metrics.MAX_GAP):
    """Returns the paired trajectories (the estimate aligned) and a dictionary of all figures.

    Ignored steps of the ground truth (steps.without_steps()) divide it into pieces: one transform
    aligns all of them, and no relative error spans two pieces.
    """
    paired_estimate, paired_truth = metrics.associate(estimate, truth, max_diff)
    yaw_drift = metrics.yaw_drift(paired_estimate, paired_truth)
    rotation, translation = metrics.alignment(paired_estimate, paired_truth, align)
    paired_estimate = paired_estimate.transformed(rotation, translation)
    result = {
        "poses": len(estimate),
        "ground_truth_poses": len(truth),
        "pairs": len(paired_estimate),
        "alignment": align,
        "t_offset_s": estimate.shift,
        "coverage": metrics.coverage(estimate, truth, max_gap),
        "first_pose_delay_s": float(estimate.stamps[0] - truth.stamps[0]),
        "ground_truth_duration_s": float(truth.duration),
        "ground_truth_path_m": truth.path_length,
        "estimate_path_m": estimate.path_length,
        "worlds": estimate.worlds,
        "yaw_drift_deg": yaw_drift,
        "local_scale": local_scale(paired_estimate, paired_truth),
        "without_steps": bool(truth.steps_left_out),
        "ground_truth_steps": [dataclasses.asdict(step) for step in _steps(truth, paired_truth)],
        "computed_by": "numpy",
    }
    result.update(error_statistics(paired_estimate, paired_truth))
    _replace_by_evo(result, paired_estimate, paired_truth)
    return paired_estimate, paired_truth, result


def _steps(truth, paired_truth):
    """Returns the steps of the ground truth that affect the pairs, or would unless ignored."""
    return steps.affecting(truth.steps_left_out or steps.find_steps(truth), paired_truth.stamps)


def local_scale(estimate, truth):
    """Returns the scale errors of pieces of 5 s, or None if no piece is long enough."""
    errors = metrics.local_scale_errors(estimate, truth)
    if len(errors) == 0:
        return None
    return {"pieces": len(errors), "mean_error_percent": float(errors.mean()),
            "mean_absolute_error_percent": float(np.abs(errors).mean())}


def error_statistics(estimate, truth):
    """Returns statistics of all errors in LABELS for paired and aligned trajectories."""
    path_errors, time_errors = (
        metrics.relative_errors(estimate, truth, metrics.within_pieces(pairs, estimate, truth))
        for pairs in (metrics.pairs_by_path(estimate, 1.0), metrics.pairs_by_time(estimate, 1.0)))
    errors = (metrics.position_errors(estimate, truth), metrics.rotation_errors(estimate, truth),
              metrics.yaw_errors(estimate, truth), *path_errors, *time_errors)
    return {name: metrics.statistics(values) for name, values in zip(LABELS, errors)}


def add_consistency(result, estimate, truth, options):
    """Adds `position_nees`, --nees-after the first pose; prints why if the run is too short."""
    pair = metrics.associate(estimate, truth, options.max_diff)
    covariances = consistency.read_covariances(
        options.covariance, pair[0].stamps - estimate.shift)  # as in the run's files
    try:
        result["position_nees"] = consistency.position_nees(*pair, covariances, options.nees_after)
        result["position_nees_s"] = options.nees_after
    except consistency.NoPoseThenError as error:
        print(f"evaluate.py: --covariance: {error}; choose another time with --nees-after",
              file=sys.stderr)


def _replace_by_evo(result, estimate, truth):
    if truth.steps_left_out or not evo_backend.is_available():  # evo knows no pieces
        return
    try:
        result.update(evo_backend.evo_statistics(estimate, truth))
        result["computed_by"] = "evo"
    except Exception as error:  # evo's own exceptions change between versions
        print(f"evaluate.py: evo failed ({error}), figures are from numpy", file=sys.stderr)


def format_report(result):
    """Returns the figures as a text table, coverage next to the APE."""
    lines = [
        f"ground truth  {result['ground_truth_poses']} poses, path"
        f" {result['ground_truth_path_m']:.2f} m in {result['ground_truth_duration_s']:.1f} s",
        f"estimate      {result['poses']} poses, path {result['estimate_path_m']:.2f} m, first pose"
        f" {result['first_pose_delay_s']:.2f} s after the ground truth begins",
        f"{result['pairs']} pairs, alignment {result['alignment']}, by {result['computed_by']};"
        " RPE over 1 m of the estimate's path (evo_rpe -d 1 -u m) and over 1 s",
        f"{'':20}" + "".join(f"{name:>9}" for name in FIGURES),
    ]
    if result["t_offset_s"]:
        lines.insert(2, f"stamps of the estimate shifted by {1000 * result['t_offset_s']:+.2f} ms"
                     " to the clock of the ground truth")
    for name, label in LABELS.items():
        lines.append(f"{label:20}" + _format_row(result[name]))
        if name == "ape_m":
            lines[-1] += f"   coverage {100 * result['coverage']:.1f} %"
    lines.append(f"yaw error at the end {result['yaw_drift_deg']:.3f} deg,"
                 " with none at the beginning")
    if result["local_scale"]:
        scale = result["local_scale"]
        lines.append(f"scale error over {scale['pieces']} pieces of 5 s:"
                     f" {scale['mean_absolute_error_percent']:.2f} % (mean of absolute errors),"
                     f" {scale['mean_error_percent']:+.2f} % (mean)")
    if "position_nees" in result:
        lines.append(f"position NEES over the first {result['position_nees_s']:g} s:"
                     f" {result['position_nees']:.2f}; consistent: 3 on average")
    if result["ground_truth_steps"]:
        lines.append(_step_note(result))
    if result["worlds"] > 1:
        lines.append(f"{result['worlds']} unconnected world frames: APE and yaw over all of them"
                     " mean little, see the RPE")
    return "\n".join(lines)


def _step_note(result):
    found = steps.describe([steps.Step(**step) for step in result["ground_truth_steps"]])
    around = f"{steps.BEFORE:g} s before and {steps.AFTER:g} s after each"
    if result["without_steps"]:
        return f"excluded from the ground truth: steps of {found}, with {around}"
    return (f"warning: the ground truth has steps of {found}, and drifts before them;"
            f" --without-steps excludes {around}")


def _format_row(figures):
    if figures is None:
        return "   no pair of poses is that far apart"
    return "".join(f"{figures[name]:9.4f}" for name in FIGURES)


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("estimate", help="trajectory in TUM format")
    parser.add_argument("ground_truth", help="TUM file, EuRoC csv (.../data.csv) or ASL folder")
    parser.add_argument("--plots", metavar="DIR", help="write PNG figures there")
    parser.add_argument("--json", metavar="FILE", help="write all figures there")
    parser.add_argument("--align", choices=metrics.ALIGNMENTS, default="se3",
                        help="alignment without scale before the errors are taken (default: se3)")
    parser.add_argument("--max-diff", type=_seconds, default=metrics.MAX_DIFFERENCE, metavar="S",
                        help="largest difference between paired stamps [s] (default: %(default)s)")
    parser.add_argument("--t-offset", type=_finite, metavar="S",
                        help="added to the stamps of the estimate [s] (default: td_s in the"
                        " summary.json beside it, 0 where there is none)")
    parser.add_argument("--max-gap", type=_seconds, default=metrics.MAX_GAP, metavar="S",
                        help="longer gaps between poses are not covered [s] (default:"
                        " %(default)s)")
    parser.add_argument("--without-steps", action="store_true",
                        help=f"exclude {steps.BEFORE:g} s before and {steps.AFTER:g} s after each"
                        " step of the ground truth, where a tracker lost its target")
    parser.add_argument("--compare", nargs="+", default=[], metavar="FILE",
                        help="further trajectories, TUM or VINS-Mono's vins_result_no_loop.csv: a"
                        " table of all, also over the time that all cover")
    parser.add_argument("--covariance", metavar="FILE",
                        help="covariance.csv of the run: compares errors with it")
    parser.add_argument("--nees-after", type=_seconds, default=10.0, metavar="S",
                        help="with --covariance: time after the first pose [s] (default: 10)")
    return parser.parse_args(arguments)


def _finite(text):
    with contextlib.suppress(ValueError):
        if math.isfinite(float(text)):
            return float(text)
    raise argparse.ArgumentTypeError(f"expected seconds instead of {text}")


def _seconds(text):
    if _finite(text) < 0:
        raise argparse.ArgumentTypeError(f"expected seconds, at least 0, instead of {text}")
    return float(text)


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        estimate = read_estimate(options.estimate, options.t_offset)
        truth = read_truth(options.ground_truth)
        if options.without_steps:
            truth = steps.without_steps(truth)
        paired_estimate, paired_truth, result = evaluate(estimate, truth, options.align,
                                                         options.max_diff, options.max_gap)
        for note in mistakes.notes((options.estimate, options.ground_truth), estimate, truth,
                                   options.align, options.max_diff):
            print(f"evaluate.py: warning: {note}", file=sys.stderr)
        if options.covariance:
            add_consistency(result, estimate, truth, options)
        print(format_report(result))
        if options.compare:
            estimates = {options.estimate: estimate}
            estimates.update((file, read_estimate(file)) for file in options.compare)
            print(side_by_side(estimates, truth, options.align, options.max_diff, options.max_gap))
        if options.json:
            with open(options.json, "w", encoding="utf-8") as file:
                json.dump(result, file, indent=2)
        if options.plots:
            from evaluation import plots  # matplotlib is needed for plots only
            print(*plots.write_plots(options.plots, paired_estimate, paired_truth), sep="\n")
    except (TrajectoryError, OSError, ImportError) as error:
        print(f"evaluate.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
