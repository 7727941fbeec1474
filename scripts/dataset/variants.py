# SPDX-License-Identifier: BSD-3-Clause
"""The compared variants, each a set of changes to the configuration."""

from .errors import DatasetError

# The baseline that the paper improves: PL-VINS's corners and lines, without merging.
_BASELINE = {"use_lines": "1", "corner_detector": "harris", "corner_subpixel": "0",
             "line_detector": "lsd", "line_merging": "0", "line_anchors": "0",
             "manhattan_constraints": "0"}
_SUBPIXEL = {"corner_detector": "shi_tomasi", "corner_subpixel": "1"}
_FLD = {"line_detector": "fld"}
_MERGING = {"line_merging": "1"}
_IMPROVED = {**_BASELINE, **_SUBPIXEL, **_FLD, **_MERGING}
_MANHATTAN = {**_IMPROVED, "manhattan_constraints": "1"}

VARIANTS = {
    "points": {**_SUBPIXEL, "use_lines": "0"},
    "baseline": _BASELINE,
    "subpixel": {**_BASELINE, **_SUBPIXEL},
    "fld": {**_BASELINE, **_FLD},
    "merging": {**_BASELINE, **_MERGING},
    "lines": {**_IMPROVED, "line_merging": "0"},
    "improved": _IMPROVED,
    "manhattan": _MANHATTAN,
    "anchors": {key: value for key, value in _MANHATTAN.items() if key != "line_anchors"},
}

DESCRIPTIONS = {
    "points": "no lines; subpixel corners",
    "baseline": "the paper's starting point: Harris corners, LSD lines, no merging",
    "subpixel": "baseline with subpixel corners (Shi-Tomasi)",
    "fld": "baseline with FLD lines",
    "merging": "baseline with merging of redundant lines",
    "lines": "improved without merging",
    "improved": "all three changes of the paper: subpixel corners, FLD lines, merging",
    "manhattan": "improved with constraints from the Manhattan frame",
    "anchors": "manhattan, with frames kept for recognized lines",
}


def select_variants(names):
    """Returns the names in the order of VARIANTS; raises DatasetError for an unknown name."""
    for name in names:
        if name not in VARIANTS:
            raise DatasetError(f"--variants {name}: no such variant; there are "
                               + ", ".join(VARIANTS))
    return [name for name in VARIANTS if name in names]


def describe_variants():
    """Returns one line per variant, and the requirements of some of them."""
    lines = [f"  {name:<10} {DESCRIPTIONS[name]}" for name in VARIANTS]
    with_lsd = [name for name, keys in VARIANTS.items() if keys.get("line_detector") == "lsd"]
    return "\n".join([*lines, f"{', '.join(with_lsd)}: OpenCV has LSD from 4.5.4 on (Ubuntu 20.04:"
                              " 4.2)"])
