# SPDX-License-Identifier: BSD-3-Clause
"""The page of one run."""

import base64
import os

import numpy as np

from evaluate import evaluate, format_report
from evaluation.metrics import alignment, associate, nearest_indices
from evaluation.run_results import check_whole
from evaluation.trajectory import TrajectoryError
from show_result import rows

from . import html, run_figures
from .run_folder import TRAJECTORY

MIME_TYPES = {".jpg": "image/jpeg", ".png": "image/png"}

SLIDER = """<input type='range' id='slider' min='0' max='%(last)d' value='0'>
<div id='caption'></div><img id='image' alt='tracks'>
<script>
const images = %(images)s;
function show(index) {
  document.getElementById('image').src = images[index][1];
  document.getElementById('caption').textContent = images[index][0];
}
document.getElementById('slider').addEventListener('input', event => show(event.target.value));
show(0);
</script>"""


def run_page(run, truth):
    """Returns the text of the page. run: a RunFolder; truth: a Trajectory or None. If the two
    cannot be compared, the page tells why and omits the truth."""
    pair, figures, note = _compare(run, truth)
    table = html.table(rows(run.summary, figures))
    left_out = run.loops_left_out and f"Loops to an earlier map, excluded: {run.loops_left_out}"
    scene = html.figure("scene", _scene(run, truth, pair), 650)
    sections = [("Run", table + _paragraph(note)),
                ("Trajectory and map", scene + _paragraph(left_out))]
    if pair:
        sections.append(("Error", html.figure("error", run_figures.error_figure(*pair))
                         + f"<pre>{html.text(format_report(figures))}</pre>"))
    for name, columns, title in (("counts", run_figures.COUNTS, "count"),
                                 ("timings", run_figures.STAGES, "time [ms]")):
        contents = run_figures.columns_figure(run.frames, columns, title)
        sections.append((name.capitalize(), html.figure(name, contents)))
    rings = run.summary.get("residual_rings")
    if rings:
        sections.append(("Residuals of points",
                         html.figure("rings", run_figures.rings_figure(rings))))
    if run.images:
        sections.append(("Tracks", _slider(run.images)))
    return html.page(os.path.basename(os.path.abspath(run.path)), sections)


def _paragraph(note):
    return f"<p>{html.text(note)}</p>" if note else ""


def _compare(run, truth):
    """Returns the aligned estimate and the truth at its poses, their figures, and the reason if
    there are none."""
    if truth is None:
        return None, None, "No ground truth."
    try:
        check_whole(os.path.join(run.path, TRAJECTORY))
        *pair, figures = evaluate(run.trajectory, truth)
        return pair, figures, ""
    except TrajectoryError as error:
        return None, None, f"Not compared with the ground truth: {error}"


def _scene(run, truth, pair):
    """Returns the scene, aligned with the world of the truth if they can be compared."""
    rotation, translation = np.eye(3), np.zeros(3)
    if pair:
        partners = associate(run.trajectory, truth)
        rotation, translation = alignment(*partners, "se3")
    estimate = run.trajectory.transformed(rotation, translation)
    trajectories = {"estimate": estimate.positions}
    if pair:
        during = ((truth.stamps >= estimate.stamps[0]) & (truth.stamps <= estimate.stamps[-1]))
        trajectories[run_figures.TRUTH] = truth.positions[during]
    lines = {axis: ends @ rotation.T + translation for axis, ends in run.lines.items()}
    return run_figures.scene_figure(trajectories, run.points @ rotation.T + translation, lines,
                                    _loops(run.loops, estimate))


def _loops(loops, estimate):
    """Returns the positions (n, 2, 3) of both ends."""
    ends = np.stack([loops.later, loops.earlier], axis=1)
    return estimate.positions[nearest_indices(estimate.stamps, ends)]


def _slider(images):
    contents = [[caption, _data_url(path)] for caption, path in images.items()]
    return SLIDER % {"last": len(contents) - 1, "images": html.as_json(contents)}


def _data_url(path):
    with open(path, "rb") as file:
        encoded = base64.b64encode(file.read()).decode("ascii")
    return f"data:{MIME_TYPES[os.path.splitext(path)[1]]};base64,{encoded}"
