#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the loops of a run with ground truth: how many are false, how large their errors are,
and how many of the true revisits they close. Also prints the APE before and after, with coverage
and number of worlds."""

import argparse
import json
import pathlib
import sys

from evaluate import evaluate
from evaluation import loops as loop_metrics
from evaluation import metrics
from evaluation.run_results import read_estimate
from evaluation.trajectory import LEAST_POSES, TrajectoryError, read_truth

FALSE_DISTANCE = 0.3  # loops with larger errors are false [m]
FALSE_TURN = 5.0  # [deg]
ODOMETRY, IN_MAP, FINAL = "trajectory.tum", "trajectory_map.tum", "trajectory_final.tum"
TRAJECTORIES = {ODOMETRY: "odometry", IN_MAP: "map, as known at each time",
                FINAL: "map, as known in the end"}


def evaluate_loops(folder, truth_path, t_offset=None):
    """Returns all figures of a run's results in `folder` as a dictionary. `t_offset` [s] overrides
    the `td` of the run."""
    truth = read_truth(truth_path)
    odometry = read_estimate(folder / ODOMETRY, t_offset)
    trajectories = {ODOMETRY: odometry,
                    # Empty if the pose in the map is never found.
                    IN_MAP: read_estimate(folder / IN_MAP, t_offset, least=0),
                    FINAL: read_estimate(folder / FINAL, t_offset)}
    figures = {name: _figures(trajectory, folder / name, truth, truth_path)
               for name, trajectory in trajectories.items()}
    accepted = loop_metrics.read_loops(folder / "loops.csv").shifted(odometry.shift)
    return {"t_offset_s": odometry.shift, **_loop_figures(accepted, odometry, truth),
            **{key: {name: of_one[key] for name, of_one in figures.items()}
               for key in ("poses", "ape_m", "coverage", "worlds")}}


def _loop_figures(accepted, odometry, truth):
    # The map of an earlier recording has an unknown transform to this one's world.
    own = accepted.between(odometry.stamps)
    loops = own.with_truth(truth)
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
    }


def _figures(trajectory, path, truth, truth_path):
    """Returns poses, APE [m] (None with too few poses), coverage and worlds."""
    figures = {"poses": len(trajectory), "ape_m": None, "worlds": trajectory.worlds,
               "coverage": metrics.coverage(trajectory, truth)}
    if len(trajectory) < LEAST_POSES:
        return figures
    try:
        return {**figures, "ape_m": evaluate(trajectory, truth)[2]["ape_m"]["rmse"]}
    except TrajectoryError as error:
        raise TrajectoryError(f"{path} against {truth_path}: {error}") from None


def format_closed(share, seconds, what):
    if share is None:
        return f"no {what}"
    return f"{100 * share:.0f} % of {seconds:.0f} s of {what} are closed"


def format_report(result):
    lines = [
        _loops_line(result),
        format_closed(result["closed_share"], result["revisited_s"], "revisits"),
        format_closed(result["closed_share_of_returns"], result["returned_s"],
                      "returns after having left"),
    ]
    if result["loops_left_out"]:
        lines.insert(1, f"excluded: {result['loops_left_out']} to poses that are not in"
                        " trajectory.tum, such as those of an earlier map (--map-in)")
    if result["loops_without_truth"]:
        lines.insert(1, f"excluded: {result['loops_without_truth']} where the ground truth has a"
                        " gap")
    if result["t_offset_s"]:
        lines.append(f"stamps of the run shifted by {1000 * result['t_offset_s']:+.2f} ms to the"
                     " clock of the ground truth")
    lines += [_ape_line(result, name) for name in TRAJECTORIES]
    if any(worlds > 1 for worlds in result["worlds"].values()):
        lines.append("the APE over several world frames means little: one transform aligns all")
    return "\n".join(lines)


def _loops_line(result):
    if result["loops"] == 0:
        return "no loops to compare"
    return (f"{result['loops']} loops, {result['false_loops']} false (errors of more"
            f" than {FALSE_DISTANCE} m or {FALSE_TURN:.0f} deg), largest error"
            f" {1000 * result['largest_error_m']:.0f} mm, {result['largest_error_deg']:.1f} deg")


def _ape_line(result, name):
    ape, poses, worlds = (result[key][name] for key in ("ape_m", "poses", "worlds"))
    if ape is None:
        few = f"{poses} poses in the map, too few for an APE" if poses else "no pose in the map"
        return f"{TRAJECTORIES[name]}: {few}"
    return (f"APE {1000 * ape:7.1f} mm  {ape / result['ape_m'][ODOMETRY]:4.2f}  coverage"
            f" {100 * result['coverage'][name]:5.1f} %  {worlds} world{'s' * (worlds > 1)}"
            f"  {TRAJECTORIES[name]}")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=pathlib.Path,
                        help="folder that run_offline wrote with loop_closure: 1")
    parser.add_argument("ground_truth", help="TUM file, EuRoC csv (.../data.csv) or ASL folder")
    parser.add_argument("--json", metavar="FILE", help="write all figures there")
    parser.add_argument("--t-offset", type=float, metavar="S",
                        help="added to the stamps of the run [s] (default: td_s in its"
                        " summary.json)")
    options = parser.parse_args(arguments)
    try:
        result = evaluate_loops(options.results, options.ground_truth, options.t_offset)
        print(format_report(result))
        if options.json:
            pathlib.Path(options.json).write_text(json.dumps(result, indent=2), encoding="utf-8")
    except (TrajectoryError, OSError) as error:
        print(f"evaluate_loops.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
