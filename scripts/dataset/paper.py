# SPDX-License-Identifier: BSD-3-Clause
"""The APE in Tables 1 and 2 of the paper, which is [Paper] of docs/references.md."""

import re

SEQUENCES = ("MH_01_easy", "MH_02_easy", "MH_03_medium", "MH_04_difficult", "MH_05_difficult",
             "V1_01_easy", "V1_02_medium", "V1_03_difficult", "V2_01_easy", "V2_02_medium",
             "V2_03_difficult")

APE = {  # RMSE [m] in the order of SEQUENCES
    "PL-VINS": (0.18, 0.18, 0.27, 0.36, 0.38, 0.14, 0.31, 0.31, 0.12, 0.25, 0.28),
    "PLS-VINS": (0.16, 0.14, 0.24, 0.35, 0.35, 0.12, 0.31, 0.29, 0.12, 0.22, 0.25),
    "improved": (0.14, 0.13, 0.22, 0.30, 0.31, 0.12, 0.30, 0.25, 0.12, 0.20, 0.24),
}

_KEY = re.compile(r"(MH|V1|V2)_?(0[1-5])(?!\d)")


def paper_sequence(name):
    """Returns the paper's name of the sequence that `name` contains (MH_01, V102,
    MH_05_difficult-weak), or None."""
    match = _KEY.search(name)
    if match is None:
        return None
    return next((s for s in SEQUENCES if s.startswith("_".join(match.groups()))), None)


def paper_ape(name):
    """Returns the paper's figures for such a sequence by their heading."""
    index = SEQUENCES.index(paper_sequence(name))
    return {heading: figures[index] for heading, figures in APE.items()}
