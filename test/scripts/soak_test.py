#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/soak.py: what counts as grown."""

import importlib.util
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))


@unittest.skipUnless(importlib.util.find_spec("rospy"), "needs ROS")
class Soak(unittest.TestCase):
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
        self.assertEqual(main(["/nowhere.bag", "--config", "/nowhere.yaml"]), 1)


if __name__ == "__main__":
    unittest.main()
