#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests which images scripts/measure_latency.py waits for, and for how long."""

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

from refusal_case import RefusalTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))


@unittest.skipUnless(importlib.util.find_spec("rospy"), "needs ROS")
class MeasureLatency(RefusalTest):
    def setUp(self):
        config = tempfile.NamedTemporaryFile("w", suffix=".yaml")
        self.addCleanup(config.close)
        config.write("%YAML:1.0\nimage_topic: /cam0/image_raw\n"
                     "extrinsicRotation: !!opencv-matrix\n   rows: 3\n")
        config.flush()
        self.config = config.name

    def measure(self, command, transport="raw", player=("sleep", "60"), timeout=0.1):
        """Runs a measurement with dummy processes instead of roslaunch and rosbag; returns topics
        and types."""
        import measure_latency
        topics = {}

        def subscribe(topic, kind, callback, **_):
            topics[topic] = kind.__name__

        options = argparse.Namespace(bag="a.bag", config=self.config, image_transport=transport)
        with contextlib.ExitStack() as replaced:
            for name, value in (("launch", lambda *_: subprocess.Popen(command)),
                                ("play", lambda *_: subprocess.Popen(player)),
                                ("wait_for_master", mock.Mock()), ("find_nodes", mock.Mock()),
                                ("START_TIMEOUT", timeout)):
                replaced.enter_context(mock.patch.object(measure_latency, name, value))
            replaced.enter_context(mock.patch("rospy.init_node"))
            replaced.enter_context(mock.patch("rospy.Subscriber", subscribe))
            with self.assertRaises(RuntimeError) as raised:
                measure_latency.measure(options, "output")
        return topics, str(raised.exception)

    def test_without_images_it_gives_up(self):
        topics, message = self.measure(["sleep", "60"])
        self.assertEqual(topics["/cam0/image_raw"], "Image")
        self.assertEqual(message, "no image arrived on /cam0/image_raw in 0.1 s: see image_topic in"
                                  f" {self.config} and --image-transport")

    def test_compressed_images(self):
        topics, message = self.measure(["sleep", "60"], "compressed")
        self.assertEqual(topics["/cam0/image_raw/compressed"], "CompressedImage")
        self.assertIn("no image arrived on /cam0/image_raw/compressed", message)

    def test_nodes_that_end(self):
        _, message = self.measure(["true"], timeout=60)
        self.assertIn("ended before an image arrived on /cam0/image_raw", message)

    def test_a_player_that_ends_is_not_waited_for(self):
        _, message = self.measure(["sleep", "60"], player=("false",), timeout=60)
        self.assertEqual(message, "rosbag play ended with code 1: is a.bag complete?")
        _, message = self.measure(["sleep", "60"], player=("true",), timeout=60)
        self.assertEqual(message, "no image arrived on /cam0/image_raw from a.bag: see image_topic"
                                  f" in {self.config} and --image-transport")

    def test_what_is_no_configuration_or_no_bag(self):
        from measure_latency import main
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as empty:
            for text in ("", "%YAML:1.0\n", "- 1\n", "image_topic:\n"):
                empty.seek(0)
                empty.truncate()
                empty.write(text)
                empty.flush()
                self.assert_refused(main, f"{empty.name}: has no image_topic", __file__,
                                    "--config", empty.name)
        folder = os.path.dirname(__file__)
        self.assert_refused(main, f"{folder}: a folder; give the file of the ROS bag", folder,
                            "--config", self.config)
        self.assert_refused(main, f"{folder}: a folder; give the file of the configuration",
                            __file__, "--config", folder)

    def test_other_transports_are_refused(self):
        import measure_latency
        with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit):
            measure_latency.parse_arguments(["a.bag", "--config", "a.yaml", "--image-transport",
                                             "theora"])


if __name__ == "__main__":
    unittest.main()
