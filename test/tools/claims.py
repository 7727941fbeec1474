#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables of figures in README.md and docs/ from runs of the current build.

claims.yaml lists the tables: where they stand, their rows (settings) and columns (recordings with
starts), or their cells where these were measured with other programs. A table stands between
`<!-- claims NAME -->` and `<!-- end of claims -->`. If its recordings are missing, it stays.
"""

import argparse
import dataclasses
import pathlib
import re
import resource
import subprocess
import sys
import textwrap

import numpy as np
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "scripts"))
from evaluation import metrics  # noqa: E402
from evaluation.markdown import Table  # noqa: E402
from evaluation.run_results import read_estimate  # noqa: E402
from evaluation.steps import without_steps  # noqa: E402
from evaluation.trajectory import read_truth  # noqa: E402

END = "<!-- end of claims -->"
STAGES = {"points": "point_tracking", "lines": "line_tracking",
          "of these, detection": "line_detection", "merging, Manhattan frame": "line_merging",
          "optimization, covariance": "optimization", "marginalization": "marginalization",
          "estimator": "estimator", "all": "total"}  # columns of timing.csv


class ClaimsError(Exception):
    pass


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", type=pathlib.Path, metavar="FOLDER",
                        help="where recordings are: NAME, an EuRoC ASL folder, or NAME.bag with"
                        " NAME.tum")
    parser.add_argument("--only", nargs="+", metavar="TABLE", help="only these tables")
    parser.add_argument("--claims", type=pathlib.Path, metavar="FILE",
                        default=pathlib.Path(__file__).with_suffix(".yaml"))
    parser.add_argument("--pages", type=pathlib.Path, default=ROOT, metavar="DIR",
                        help="folder that the pages are relative to (default: the repository)")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "output" / "claims",
                        metavar="DIR", help="results of the runs; complete ones are not repeated"
                        " (default: output/claims)")
    parser.add_argument("--run-offline", metavar="PROGRAM",
                        default=ROOT / "build" / "devel" / "lib" / "plm_vins" / "run_offline")
    return parser.parse_args(arguments)


class Runs:
    """Runs of one commit."""

    def __init__(self, options):
        self.folders, self.program = options.folders, options.run_offline
        self.commit = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"],
                                     stdout=subprocess.PIPE, encoding="utf-8",
                                     check=True).stdout.strip()
        self.output = options.output / self.commit

    def find(self, name):
        """Returns the options of run_offline and the ground truth, or None."""
        for folder in self.folders:
            if (folder / name / "mav0").is_dir():
                return ["--asl", folder / name], folder / name
            if (folder / f"{name}.bag").is_file():
                return ["--bag", folder / f"{name}.bag"], folder / f"{name}.tum"
        return None

    def run(self, recording, start, row, again=False):
        """Returns the folder of results; `again`: repeats a run that is complete."""
        settings = {**row.get("set", {}), **recording.get("set", {})}
        config = recording.get("configs", {}).get(row["title"], row.get("config", "euroc.yaml"))
        words = [recording["name"], pathlib.Path(config).stem, start,
                 *(f"{key}={value}" for key, value in settings.items())]
        results = self.output / re.sub(r"[^\w.=-]", "_", "_".join(map(str, words)))
        if (results / "summary.json").is_file() and not again:
            return results
        source, _ = self.find(recording["name"])
        config = next((folder / config for folder in self.folders if (folder / config).is_file()),
                      ROOT / "config" / config)
        command = [self.program, "--config", config, *source, "--start", start, "--threads", 1,
                   "--output", results]
        if "end" in recording:
            command += ["--duration", recording["end"] - start]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        done = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, encoding="utf-8", check=False)
        if done.returncode != 0:
            raise ClaimsError(f"{recording['name']}, {row['title']}: {done.stderr.strip()}")
        return results

    def errors(self, recording, start, row):
        """Returns APE [mm] after SE3 and after Sim3 alignment, and the error of the scale [%]."""
        trajectory = self.run(recording, start, row) / row.get("file", "trajectory.tum")
        _, truth_file = self.find(recording["name"])
        estimate, truth = metrics.associate(read_estimate(str(trajectory)),
                                            without_steps(read_truth(str(truth_file))))
        scale = metrics.scale(estimate, truth)
        scaled = dataclasses.replace(estimate, positions=estimate.positions / scale)
        return [_ape_mm(estimate, truth), _ape_mm(scaled, truth), 100 * (scale - 1)]


def _ape_mm(estimate, truth):
    aligned = estimate.transformed(*metrics.alignment(estimate, truth, "se3"))
    return 1e3 * np.sqrt(np.mean(metrics.position_errors(aligned, truth) ** 2))


def error_table(table, runs):
    recordings = table["recordings"]
    rows = []
    for row in table["rows"]:
        cells = [row["title"]]
        for recording in recordings:
            values = [runs.errors(recording, start, row) for start in recording["starts"]]
            cells.append(table["cell"].format(*np.mean(values, axis=0)))
        rows.append(cells)
    count = sum(len(recording["starts"]) for recording in recordings) * len(rows)
    titles = [recording.get("title", recording["name"]) for recording in recordings]
    return Table(["", *titles], rows), f"*Commit {runs.commit}, {count} runs.*"


def time_table(table, runs):
    recording = table["recordings"][0]
    results = runs.run(recording, recording["starts"][0], {"title": ""})
    times = np.genfromtxt(results / "timing.csv", delimiter=",", names=True)
    rows = [[title] + [f"{value:.1f}" for value in (
        np.mean(times[stage]), *np.percentile(times[stage], [50, 95, 99]))]
        for title, stage in STAGES.items()]
    return Table(["stage", "mean", "p50", "p95", "p99"], rows), f"*Commit {runs.commit}.*"


def cpu_table(table, runs):
    """User time of each row relative to the first one, in interleaved runs."""
    recording = table["recordings"][0]
    seconds = []
    for _ in range(table["repetitions"]):
        for row in table["rows"]:
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            runs.run(recording, recording["starts"][0], row, again=True)
            seconds.append(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
    ratios = np.reshape(seconds, (table["repetitions"], -1))
    ratios = ratios / ratios[:, :1]
    rows = [[row["title"], f"{np.mean(ratio):.2f} ({min(ratio):.2f} to {max(ratio):.2f})"]
            for row, ratio in zip(table["rows"], ratios.T)]
    return (Table(["", "user CPU time"], rows),
            f"*Commit {runs.commit}, {table['repetitions']} interleaved runs each.*")


def text_table(table, _):
    return Table(table["heading"], table["rows"]), f"*{table['source']}*"


def write(page, name, text):
    """Replaces what stands between the markers."""
    content = page.read_text(encoding="utf-8")
    pattern = re.compile(rf"(<!-- claims {re.escape(name)} -->\n).*?({END})", re.DOTALL)
    if len(pattern.findall(content)) != 1:
        raise ClaimsError(f"{page}: does not have the markers of the table {name} once")
    page.write_text(pattern.sub(lambda found: found[1] + text + found[2], content),
                    encoding="utf-8")


def main(arguments):
    options = parse_arguments(arguments)
    tables = yaml.safe_load(options.claims.read_text(encoding="utf-8"))
    runs = Runs(options)
    for name in options.only or tables:
        if name not in tables:
            raise ClaimsError(f"{name}: no such table; there are {', '.join(tables)}")
        table = tables[name]
        missing = [recording["name"] for recording in table.get("recordings", [])
                   if runs.find(recording["name"]) is None]
        if missing:
            print(f"{name}: stays, without {', '.join(missing)}")
            continue
        make = {"errors": error_table, "times": time_table, "cpu": cpu_table,
                "text": text_table}[table["kind"]]
        made, note = make(table, runs)
        for page in table["pages"]:
            write(options.pages / page, name, f"\n{made}\n\n{textwrap.fill(note, 120)}\n\n")
        print(f"{name}: written")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except ClaimsError as error:
        sys.exit(f"claims.py: {error}")
