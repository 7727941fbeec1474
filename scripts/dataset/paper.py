# SPDX-License-Identifier: BSD-3-Clause
"""The figures of the paper: [Paper] of docs/references.md.

The paper repeats its Tables 1 and 2 with differences and averages as Tables 4 and 5, and Table 3 as
Table 6, so one table here stands for both. Averages are computed here from the rows, since the
paper prints only those of the differences.
"""

import re
from dataclasses import dataclass
from typing import Dict, Tuple

SEQUENCES = ("MH_01_easy", "MH_02_easy", "MH_03_medium", "MH_04_difficult", "MH_05_difficult",
             "V1_01_easy", "V1_02_medium", "V1_03_difficult", "V2_01_easy", "V2_02_medium",
             "V2_03_difficult")


def _by_sequence(*values):
    return dict(zip(SEQUENCES, values))


# APE RMSE [m]
PL_VINS_APE = _by_sequence(0.18, 0.18, 0.27, 0.36, 0.38, 0.14, 0.31, 0.31, 0.12, 0.25, 0.28)
PLS_VINS_APE = _by_sequence(0.16, 0.14, 0.24, 0.35, 0.35, 0.12, 0.31, 0.29, 0.12, 0.22, 0.25)
IMPROVED_APE = _by_sequence(0.14, 0.13, 0.22, 0.30, 0.31, 0.12, 0.30, 0.25, 0.12, 0.20, 0.24)
# Line extraction time, LSD in PL-VINS and FLD in the improved one [ms per image]
PL_VINS_TIME = _by_sequence(6.29, 7.50, 8.76, 7.12, 8.10, 4.33, 7.21, 3.66, 4.24, 5.62, 9.68)
IMPROVED_TIME = _by_sequence(6.02, 4.97, 5.54, 5.63, 5.47, 5.82, 4.58, 3.32, 5.11, 4.86, 4.75)


@dataclass(frozen=True)
class PaperTable:
    """Two columns of the paper and the results to compare with them."""

    title: str
    columns: Dict[str, Dict[str, float]]  # heading -> sequence -> figure
    metric: str  # name of our metric
    variants: Tuple[str, ...]  # our variants, in the order of columns


TABLES = (
    PaperTable("Tables 1 and 4. APE RMSE [m]: PL-VINS and improved",
               {"PL-VINS": PL_VINS_APE, "improved": IMPROVED_APE}, "ape_m",
               ("baseline", "improved")),
    PaperTable("Tables 2 and 5. APE RMSE [m]: PLS-VINS and improved",
               {"PLS-VINS": PLS_VINS_APE, "improved": IMPROVED_APE}, "ape_m", ("improved",)),
    PaperTable("Tables 3 and 6. Line extraction [ms]: LSD and FLD",
               {"PL-VINS (LSD)": PL_VINS_TIME, "improved (FLD)": IMPROVED_TIME},
               "line_extraction_ms", ("baseline", "improved")))

_KEY = re.compile(r"(MH|V1|V2)_?(0[1-5])(?!\d)")


def paper_sequence(name):
    """Returns the paper's name of the sequence that `name` contains (MH_01, V102,
    MH_05_difficult-weak), or None."""
    match = _KEY.search(name)
    if match is None:
        return None
    return next((s for s in SEQUENCES if s.startswith("_".join(match.groups()))), None)
