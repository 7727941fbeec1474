# SPDX-License-Identifier: BSD-3-Clause
"""A result file for evo_res in the format of `evo_ape --save_results`; evo itself is not needed."""

import io
import json
import os
import zipfile

import numpy as np

from .metrics import position_errors, statistics
from .trajectory import format_tum

# evo_res asks before it combines results with different titles, so evo's titles are used.
TITLE = "APE w.r.t. translation part (m)\n"
ALIGNMENT_TITLES = {"se3": "(with SE(3) Umeyama alignment)", "yaw": "(with yaw alignment)",
                    "none": "(not aligned)"}
REFERENCE = "reference"


def write_evo_zip(path, estimate, truth, alignment):
    """Writes the APE [m] of paired, aligned trajectories. `alignment` is one of metrics.ALIGNMENTS.

    evo_res labels the result with the file name, so file names must differ.
    """
    name = os.path.splitext(os.path.basename(path))[0]
    errors = position_errors(estimate, truth)
    info = {"title": TITLE + ALIGNMENT_TITLES[alignment], "ref_name": REFERENCE, "est_name": name,
            "label": "APE (m)"}
    arrays = {"error_array": errors, "timestamps": estimate.stamps,
              "seconds_from_start": estimate.stamps - estimate.stamps[0],
              "distances_from_start": truth.distances, "distances": estimate.distances}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("info.json", json.dumps(info))
        archive.writestr("stats.json", json.dumps(_evo_statistics(errors)))
        for array_name, array in arrays.items():
            archive.writestr(array_name + ".npz", _npy_bytes(array))
        archive.writestr(REFERENCE + ".tum", format_tum(truth))
        archive.writestr(name + ".tum", format_tum(estimate))


def _evo_statistics(errors):
    figures = statistics(errors)
    del figures["count"]
    return dict(figures, sse=float(np.sum(np.square(errors))))


def _npy_bytes(array):
    """Returns the contents of a plain .npy file, which evo names .npz."""
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()
