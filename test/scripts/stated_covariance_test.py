#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of scripts/evaluation/consistency.py with covariances of known consistency."""

import os
import tempfile
import unittest
import warnings

import numpy as np

from known_flight import flight, moved, rotation  # first: it names the folder
from evaluation import consistency
from evaluation.trajectory import TrajectoryError


class StatedCovariance(unittest.TestCase):
    def test_error_is_taken_in_units_of_its_covariance(self):
        truth = flight(seconds=6.0)
        # A single pose has an error of 0.2 m, which hardly affects the alignment.
        offsets = np.zeros((len(truth), 3))
        offsets[100, 2] = 0.2
        estimate = moved(truth.transformed(rotation((0, 0, 1), 70), np.array([5.0, -3.0, 2.0])),
                         offsets)
        covariances = np.tile(np.diag([0.04, 0.04, 0.01, 1, 1, 1]), (len(truth), 1, 1))
        covariances[0] = 0.0  # the first pose is exact
        self.assertAlmostEqual(
            consistency.position_nees(estimate, truth, covariances, 5.0), 4.0, places=6)
        self.assertLess(consistency.position_nees(estimate, truth, covariances, 4.0), 1e-6)

    def test_is_three_on_average_where_it_is_true(self):
        generator = np.random.default_rng(1)
        truth = flight(seconds=10.0)
        covariance = np.diag([0.01, 0.02, 0.03, 1, 1, 1]) ** 2
        covariances = np.tile(covariance, (len(truth), 1, 1))
        values = []
        for _ in range(500):
            offsets = np.zeros((len(truth), 3))
            for end in (0, -1):
                offsets[end] = generator.multivariate_normal(np.zeros(3), covariance[:3, :3])
            estimate = moved(truth, offsets)
            values.append(consistency.position_nees(estimate, truth, covariances, 10.0))
        self.assertAlmostEqual(np.mean(values), 3.0, delta=0.3)

    def test_reads_the_upper_triangle_of_the_poses_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "covariance.csv")
            triangle = ",".join(str(n) for n in range(1, 22))
            with open(path, "w", encoding="utf-8") as file:
                file.write("stamp_ns\n" + "".join(f"{1000000000 + i * 50000000},{triangle}\n"
                                                  for i in range(4)))
            covariances = consistency.read_covariances(path, np.array([1.05, 1.15]))
            self.assertEqual(covariances.shape, (2, 6, 6))
            np.testing.assert_array_equal(covariances[1], covariances[1].T)
            np.testing.assert_array_equal(covariances[0][0], [1, 2, 3, 4, 5, 6])
            self.assertEqual(covariances[0][5, 5], 21)
            with self.assertRaisesRegex(TrajectoryError, "has no covariance for some poses"):
                consistency.read_covariances(path, np.array([2.0]))
            with open(path, "w", encoding="utf-8") as file:
                file.write("a,b\n1,2\n3,4\n")
            with self.assertRaisesRegex(TrajectoryError, "not the covariance.csv"):
                consistency.read_covariances(path, np.array([1.0]))
            with open(path, "w", encoding="utf-8"):
                pass
            with warnings.catch_warnings(), \
                    self.assertRaisesRegex(TrajectoryError, "not the covariance.csv"):
                warnings.simplefilter("error")
                consistency.read_covariances(path, np.array([1.0]))
            with self.assertRaisesRegex(TrajectoryError, "missing.csv"):
                consistency.read_covariances(os.path.join(folder, "missing.csv"), np.array([1.0]))


if __name__ == "__main__":
    unittest.main()
