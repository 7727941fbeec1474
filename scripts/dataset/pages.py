# SPDX-License-Identifier: BSD-3-Clause
"""HTML pages of the results: index.html, and a page for each run."""

import os

from evaluation.trajectory import TrajectoryError
from pages import html, run_figures
from pages.run_folder import RunFolder
from pages.run_page import run_page

from . import cells
from .results import METRIC

LIBRARY = "plotly.js"  # shared by all pages, since it is larger than they are
COLUMNS = ("ape_m", "coverage_percent", "rpe_1m_m", "yaw_drift_deg", "init_time_s",
           "real_time_factor")


def write_pages(output, results, evaluator, facts):
    """Writes index.html with plotly.js, and run.html into the folders of the runs; returns the path
    of index.html. Raises ImportError without plotly."""
    with open(os.path.join(output, LIBRARY), "w", encoding="utf-8") as file:
        file.write(html.plotly_source())
    links = {result.run.name: _write_run_page(output, result, evaluator)
             for result in results.all() if result.failure is None}
    sections = [("About", html.table([[html.text(cell) for cell in fact] for fact in facts])),
                ("Runs", _run_table(results, links))]
    for number, sequence in enumerate(results.sequences):
        pairs = evaluator.typical_pairs(results, sequence)
        if pairs:
            sections.append((sequence, _sequence_figures(pairs, number)))
    path = os.path.join(output, "index.html")
    with open(path, "w", encoding="utf-8") as file:
        file.write(html.page("Odometry over a dataset", sections, html.linked_plotly(LIBRARY)))
    return path


def _write_run_page(output, result, evaluator):
    """Returns its path relative to the index, or None if there are too few data for a page."""
    folder = result.run.folder
    try:
        run = RunFolder.read(folder)
    except TrajectoryError:
        return None
    script = html.linked_plotly(os.path.relpath(os.path.join(output, LIBRARY), folder))
    path = os.path.join(folder, "run.html")
    truth, reason = None, result.not_compared if result.run.sequence.truth else ""
    if result.evaluation is not None:
        truth = evaluator.truth(result.run, result.summary, run.trajectory)
    with open(path, "w", encoding="utf-8") as file:
        file.write(run_page(run, truth, script, reason))
    return os.path.relpath(path, output)


def _run_table(results, links):
    heading = ["run", *(html.text(METRIC[name].title) for name in COLUMNS), ""]
    rows = []
    for result in results.all():
        path = links.get(result.run.name)
        name = html.link(path, result.run.name) if path else html.text(result.run.name)
        figures = [cells.number(METRIC[name].value(result), METRIC[name].decimals)
                   for name in COLUMNS]
        rows.append([name, *figures, html.text(result.failure or result.not_compared or "")])
    return html.table(rows, heading)


def _sequence_figures(pairs, number):
    paths = {variant: estimate.positions for variant, (estimate, _) in pairs.items()}
    longest = max((truth for _, truth in pairs.values()), key=lambda truth: truth.duration)
    scene = run_figures.scene_figure({**paths, run_figures.TRUTH: longest.positions})
    return (html.figure(f"scene{number}", scene, 600)
            + html.figure(f"error{number}", run_figures.error_figure(pairs)))
