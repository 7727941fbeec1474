#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests evaluate.py --compare: several estimates for the same ground truth."""

import unittest

import numpy as np

from known_flight import flight, format_tum, moved  # first: it names the folder
from evaluate import main
from evaluation import metrics
from evaluation.trajectory import Trajectory
from folder_case import FolderTest, call


def vins_mono_csv(trajectory):
    """Returns VINS-Mono's format: timestamp [ns], position, quaternion (w first), velocity, a
    comma."""
    rows = [line.split() for line in format_tum(trajectory).splitlines()]
    return "".join(f"{1e9 * float(t):.0f},{x},{y},{z},{qw},{qx},{qy},{qz},0,0,0,\n"
                   for t, x, y, z, qx, qy, qz, qw in rows)


class SideBySide(FolderTest):
    def test_the_scale_is_that_of_the_estimate(self):
        truth = flight()
        larger = Trajectory(truth.stamps, 1.03 * truth.positions + 5, truth.rotations)
        self.assertAlmostEqual(metrics.scale(larger, truth), 1.03)

    def test_files_of_others(self):
        truth = flight()
        late = truth.select(truth.stamps > truth.stamps[0] + 4)
        wrong = moved(truth, 0.1 * np.sin(7 * truth.stamps)[:, np.newaxis])
        files = [self.write(name, text) for name, text in (
            ("ours.tum", format_tum(truth)), ("truth.tum", format_tum(truth)),
            ("vins_result_no_loop.csv", vins_mono_csv(late)), ("wrong.tum", format_tum(wrong)))]
        rows = call(main, *files[:2], "--compare", *files[2:]).stdout.splitlines()[-3:]
        ours, vins, other = (row.replace("|", " ").split()[1:] for row in rows)
        self.assertEqual(ours, ["0.0000", "100.0", "0.00", "0.0000", "+0.00"])
        self.assertEqual((vins[0], vins[2]), ("0.0000", "4.05"))
        self.assertLess(float(vins[1]), 61)
        self.assertGreater(float(other[0]), 0.05)
        self.assertNotEqual(other[0], other[3])  # the common interval is shorter


if __name__ == "__main__":
    unittest.main()
