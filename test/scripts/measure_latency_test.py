#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/measure_latency.py: which images it waits for, and for how long."""

import argparse
import contextlib
import importlib.util
import io
import os
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))


@unittest.skipUnless(importlib.util.find_spec("rospy"), "needs ROS")
class MeasureLatency(unittest.TestCase):
    def setUp(self):
        config = tempfile.NamedTemporaryFile("w", suffix=".yaml")
        self.addCleanup(config.close)
        config.write("%YAML:1.0\nimage_topic: /cam0/image_raw\n"
                     "extrinsicRotation: !!opencv-matrix\n   rows: 3\n")
        config.flush()
        self.config = config.name

    def measure(self, command, transport="raw"):
        """With a process in the place of roslaunch; returns the topics with their types."""
        import measure_latency
        topics = {}

        def subscribe(topic, kind, callback, **_):
            topics[topic] = kind.__name__

        options = argparse.Namespace(config=self.config, image_transport=transport)
        with contextlib.ExitStack() as replaced:
            for name, value in (("launch", lambda *_: subprocess.Popen(command)),
                                ("wait_for_master", mock.Mock()), ("find_nodes", mock.Mock()),
                                ("START_TIMEOUT", 0.1)):
                replaced.enter_context(mock.patch.object(measure_latency, name, value))
            replaced.enter_context(mock.patch("rospy.init_node"))
            replaced.enter_context(mock.patch("rospy.Subscriber", subscribe))
            with self.assertRaises(RuntimeError) as raised:
                measure_latency.measure(options, "output")
        return topics, str(raised.exception)

    def test_without_images_it_gives_up(self):
        topics, message = self.measure(["sleep", "60"])
        self.assertEqual(topics["/cam0/image_raw"], "Image")
        self.assertEqual(message, "no image came on /cam0/image_raw in 0.1 s: see image_topic in"
                                  f" {self.config} and --image-transport")

    def test_compressed_images(self):
        topics, message = self.measure(["sleep", "60"], "compressed")
        self.assertEqual(topics["/cam0/image_raw/compressed"], "CompressedImage")
        self.assertIn("no image came on /cam0/image_raw/compressed", message)

    def test_nodes_that_end(self):
        _, message = self.measure(["true"])
        self.assertIn("ended before an image came on /cam0/image_raw", message)

    def test_other_transports_are_refused(self):
        import measure_latency
        with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit):
            measure_latency.parse_arguments(["a.bag", "--config", "a.yaml", "--image-transport",
                                             "theora"])


if __name__ == "__main__":
    unittest.main()
