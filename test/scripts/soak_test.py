#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of test/tools/soak.py: detection of growth and of runs without any data."""

import argparse
import contextlib
import importlib.util
import io
import os
import sys
import unittest
from unittest import mock

from folder_case import FolderTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))


@unittest.skipUnless(importlib.util.find_spec("rospy"), "needs ROS")
class Soak(FolderTest):
    def series(self, what, values):
        from soak import Series
        series = Series()
        for value in values:
            series.add("node", {what: value})
        return series

    def grows(self, what, values):
        from soak import report
        return not report(self.series(what, values))

    def test_the_first_quarter_does_not_count(self):
        self.assertFalse(self.grows("memory_MB", [10] * 25 + [80] * 75))
        self.assertEqual(list(self.series("files", [1, 2, 3, 4]).growth()),
                         [("node", "files", 2, 4)])

    def test_what_goes_on_growing_is_named(self):
        self.assertTrue(self.grows("memory_MB", range(100)))
        self.assertTrue(self.grows("files", [10] * 75 + [20] * 25))
        self.assertFalse(self.grows("files", [10] * 100))

    def test_a_process_of_today(self):
        from soak import usage
        values = usage(os.getpid())
        self.assertGreater(values["memory_MB"], 1)
        self.assertGreaterEqual(values["threads"], 1)
        self.assertIsNone(usage(2 ** 30))

    def test_a_bag_that_is_not_there(self):
        from soak import main
        self.assert_refused(main, "No such file", "/nowhere.bag", "--config", "/nowhere.yaml")

    def test_roslaunch_that_is_not_there(self):
        from soak import main
        with mock.patch.dict(os.environ, PATH=""):
            self.assert_refused(main, "roslaunch", __file__, "--config", __file__)

    def watch(self, values, player_ended=False):
        """Runs watch() with this process instead of the estimator; its status has the given
        values."""
        from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
        from soak import watch
        array = DiagnosticArray(status=[DiagnosticStatus(
            values=[KeyValue(key, value) for key, value in values.items()])])
        nodes, player = (mock.Mock(**{"poll.return_value": code})
                         for code in (None, 0 if player_ended else None))
        options = argparse.Namespace(minutes=0.005, interval=0.01, config="mine.yaml")
        with mock.patch("soak.find_nodes", lambda found: found.update({"/node": os.getpid()})), \
                mock.patch("rospy.Subscriber", lambda topic, kind, callback: callback(array)), \
                contextlib.redirect_stdout(io.StringIO()):
            return watch(options, nodes, player)

    def test_poses_that_come(self):
        series = self.watch({"pose_age_ms": "40", "resets": "0", "odometry_delay_ms": "50.0"})
        self.assertEqual(series.samples["vins_estimator", "pose_age_ms"][0], 40)
        self.assertGreater(len(series.samples["node", "memory_MB"]), 1)

    def test_an_estimator_without_a_pose_is_an_error(self):
        with self.assertRaisesRegex(RuntimeError, "no pose arrived in 0.005 minutes.* mine.yaml"):
            self.watch({"pose_age_ms": "0", "resets": "0", "odometry_rate_hz": "0.0"})

    def test_a_player_that_has_ended_is_an_error(self):
        with self.assertRaisesRegex(RuntimeError, "rosbag play has ended"):
            self.watch({}, player_ended=True)


if __name__ == "__main__":
    unittest.main()
