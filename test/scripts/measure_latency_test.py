#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests which images test/tools/measure_latency.py waits for, and for how long."""

import contextlib
import importlib.util
import io
import os
import sys
import tempfile
import time
import unittest
from unittest import mock

from folder_case import FolderTest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))


@unittest.skipUnless(importlib.util.find_spec("rospy"), "needs ROS")
class MeasureLatency(FolderTest):
    def setUp(self):
        config = tempfile.NamedTemporaryFile("w", suffix=".yaml")
        self.addCleanup(config.close)
        config.write("%YAML:1.0\nimage_topic: /cam0/image_raw\n"
                     "extrinsicRotation: !!opencv-matrix\n   rows: 3\n")
        config.flush()
        self.config = config.name

    def measure(self, command, transport="raw", player=("sleep", "60"), timeout=0.1):
        """Runs a measurement without images, with dummy processes instead of roslaunch and rosbag;
        returns topics and types."""
        import measure_latency
        topics = {}

        def subscribe(topic, kind, callback, **_):
            topics[topic] = kind.__name__

        options = measure_latency.parse_arguments(
            ["a.bag", "--config", self.config, "--image-transport", transport])
        with contextlib.ExitStack() as replaced:
            for name, value in (("nodes", lambda *_, **__: measure_latency.running(command)),
                                ("player", lambda *_: measure_latency.running(player)),
                                ("find_nodes", mock.Mock()), ("START_TIMEOUT", timeout)):
                replaced.enter_context(mock.patch.object(measure_latency, name, value))
            replaced.enter_context(mock.patch("rospy.Subscriber", subscribe))
            with self.assertRaisesRegex(RuntimeError, "^no image arrived on .* --image-transport"):
                measure_latency.measure(options, "output")
        return topics

    def test_without_images_it_gives_up(self):
        self.assertEqual(self.measure(["sleep", "60"])["/cam0/image_raw"], "Image")

    def test_compressed_images(self):
        topics = self.measure(["sleep", "60"], "compressed")
        self.assertEqual(topics["/cam0/image_raw/compressed"], "CompressedImage")

    def test_processes_that_end_are_not_waited_for(self):
        begin = time.monotonic()
        self.measure(["true"], timeout=600)
        for player in ("true", "false"):
            self.measure(["sleep", "60"], player=(player,), timeout=600)
        self.assertLess(time.monotonic() - begin, 50)

    def test_what_is_no_configuration_or_no_bag(self):
        from measure_latency import main
        for text in ("", "- 1\n", "image_topic:\nimu_topic: /imu0\n"):
            with tempfile.NamedTemporaryFile("w", suffix=".yaml") as config:
                config.write(text)
                config.flush()
                self.assert_refused(main, f"{config.name}: has no image_topic", __file__,
                                    "--config", config.name)
        folder = os.path.dirname(__file__)
        self.assert_refused(main, f"Is a directory: '{folder}'", folder, "--config", self.config)
        self.assert_refused(main, f"Is a directory: '{folder}'", __file__, "--config", folder)

    def test_other_transports_are_refused(self):
        import measure_latency
        with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit):
            measure_latency.parse_arguments(["a.bag", "--config", "a.yaml", "--image-transport",
                                             "theora"])


if __name__ == "__main__":
    unittest.main()
