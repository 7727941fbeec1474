#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the loops of a run with ground truth: how many are false, how far they are off, and how
many of the true revisits they close. Prints what happened to the APE as well."""

import argparse
import json
import pathlib
import sys

from evaluate import evaluate
from evaluation import loops as loop_metrics
from evaluation.trajectory import TrajectoryError, read_trajectory

FALSE_DISTANCE = 0.3  # a loop that is off by more is false [m]
FALSE_TURN = 5.0  # [deg]
TRAJECTORIES = {"trajectory.tum": "odometry", "trajectory_map.tum": "map, as known at each time",
                "trajectory_final.tum": "map, as known in the end"}


def evaluate_loops(folder, truth_path):
    """All figures of the results of a run in `folder`, as a dictionary."""
    truth = read_trajectory(truth_path)
    trajectories = {name: read_trajectory(folder / name) for name in TRAJECTORIES}
    ape = {name: _ape(trajectory, folder / name, truth, truth_path)
           for name, trajectory in trajectories.items()}
    odometry = trajectories["trajectory.tum"]
    accepted = loop_metrics.read_loops(folder / "loops.csv")
    # Where the poses of an earlier recording's map are in this one's world is not known.
    own = accepted.between(odometry.stamps)
    loops = own.between(truth.stamps, loop_metrics.TRUE_POSE_WITHIN)
    distances, turns = loop_metrics.loop_errors(loops, odometry, truth)
    flown = (truth.stamps >= odometry.stamps[0]) & (truth.stamps <= odometry.stamps[-1])
    revisited, returned = loop_metrics.revisits(truth.select(flown))
    return {
        "loops": len(loops),
        "loops_left_out": len(accepted) - len(own),
        "loops_without_truth": len(own) - len(loops),
        "false_loops": int(((distances > FALSE_DISTANCE) | (turns > FALSE_TURN)).sum()),
        "largest_error_m": float(distances.max(initial=0)),
        "largest_error_deg": float(turns.max(initial=0)),
        "revisited_s": len(revisited) * loop_metrics.SAMPLING,
        "closed_share": loop_metrics.closed_share(own, revisited),
        "returned_s": int(returned.sum()) * loop_metrics.SAMPLING,
        "closed_share_of_returns": loop_metrics.closed_share(own, revisited[returned]),
        "ape_m": ape,
    }


def _ape(trajectory, path, truth, truth_path):
    try:
        return evaluate(trajectory, truth)[2]["ape_m"]["rmse"]
    except TrajectoryError as error:
        raise TrajectoryError(f"{path} against {truth_path}: {error}") from None


def format_closed(share, seconds, what):
    if share is None:
        return f"no {what}"
    return f"{100 * share:.0f} % of {seconds:.0f} s of {what} are closed"


def format_report(result):
    lines = [
        f"{result['loops']} loops, {result['false_loops']} false (off by more than"
        f" {FALSE_DISTANCE} m or {FALSE_TURN:.0f} deg), the largest error"
        f" {1000 * result['largest_error_m']:.0f} mm, {result['largest_error_deg']:.1f} deg",
        format_closed(result["closed_share"], result["revisited_s"], "revisits"),
        format_closed(result["closed_share_of_returns"], result["returned_s"],
                      "returns after having left"),
    ]
    if result["loops_left_out"]:
        lines.insert(1, f"left out: {result['loops_left_out']} to poses that are not in"
                        " trajectory.tum, such as those of a map of earlier (--map-in)")
    if result["loops_without_truth"]:
        lines.insert(1, f"left out: {result['loops_without_truth']} where the ground truth has a"
                        " gap")
    odometry = result["ape_m"]["trajectory.tum"]
    lines += [f"APE {1000 * ape:7.1f} mm  {ape / odometry:4.2f}  {TRAJECTORIES[name]}"
              for name, ape in result["ape_m"].items()]
    return "\n".join(lines)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=pathlib.Path,
                        help="folder that run_offline wrote with loop_closure: 1")
    parser.add_argument("ground_truth", help="TUM file or EuRoC csv (.../data.csv)")
    parser.add_argument("--json", metavar="FILE", help="write all figures there")
    options = parser.parse_args(arguments)
    try:
        result = evaluate_loops(options.results, options.ground_truth)
        print(format_report(result))
        if options.json:
            pathlib.Path(options.json).write_text(json.dumps(result, indent=2), encoding="utf-8")
    except (TrajectoryError, OSError) as error:
        print(f"evaluate_loops.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
