#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that each key of the configuration has an effect on run_offline, or a reason to have none.

Usage: keys_test.py SIMULATE RUN_OFFLINE [unittest option ...]
"""

import functools
import hashlib
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "test" / "testing"))

import pair_flight  # noqa: E402

REFERENCE = ROOT / "config" / "reference.yaml"
SIMULATE, RUN_OFFLINE = sys.argv[1:3] if len(sys.argv) > 2 else sys.exit(__doc__)

FLIGHT = ["--motion", "fast", "--duration", 4, "--frame-rate", 10, "--exposure", 0, "--depth"]
NOWHERE = "the nodes alone have frames and topics"
# Keys without an effect on the poses and the map of a flight, and why.
REASONS = {
    **dict.fromkeys(("map_frame", "world_frame", "body_frame", "camera_frame", "manhattan_frame",
                     "base_frame", "publish_tf", "show_track"), NOWHERE),
    "pose_graph_save_path": "run_offline has --map-in and --map-out, or saves nothing there",
    "load_previous_pose_graph": "there is no map to load",
    "solver": "both find the same minimum; results differ by rounding, or not at all",
    "bundle_adjustment": "the flight has no loop",
    "loop_closure": "the trajectory is that of the odometry",
    "imu_rate": "gaps are found and noise is divided by it in other flights only",
    "stereo_pairs": "one camera",
    "fisheye": "there is no fisheye_mask",
    "line_anchors": "no line returns within seconds",
    "acc_range": "the flight stays far below", "gyr_range": "the flight stays far below",
    "max_num_iterations": "fewer are needed",
    "stamp_tolerance": "depth has the stamps of the images",
    "adapt_imu_noise": "the noise is as configured",
    "manhattan_constraints": "the axes are found after more seconds",
}
# Other keys that one needs to have an effect.
NEEDS = {
    "rolling_shutter_tr": ["rolling_shutter=1"], "rolling_shutter": ["rolling_shutter_tr=0.01"],
    **dict.fromkeys(("focal_length_deviation", "principal_point_deviation",
                     "distortion_deviation"), ["estimate_intrinsics=1"]),
}
# Values that are as good as others where the rule of other_value() is not.
VALUES = {"num_of_cam": None, "image_topic": None, "imu_topic": None, "depth_topic": "",
          "model_type": None, "image_width": None, "image_height": None,
          "imu_noise_model": "vins", "fisheye_mask": None, "depth_max": 2.5, "td": 0.004,
          "estimate_extrinsic": 1, "g_norm": 9.8, "window_size": 8, "rolling_shutter_tr": 0.015,
          "line_merge_distance": 0.5, "line_outlier_distance": 0.5,
          "line_merge_image_distance": 0.5, "klt_levels": 1}
KEY = re.compile(r"^( *)(\w+):(?: +(\S+))? *(?:#(.*))?$")


def keys():
    """Returns the scalar keys of the reference with their values and comments."""
    group, result = "", {}
    for line in REFERENCE.read_text(encoding="utf-8").splitlines():
        found = KEY.match(line)
        if not found:
            continue
        indent, name, value, comment = found.groups()
        group = group if indent else name
        if value and not value.startswith("!!") and name not in ("rows", "cols", "dt", "data"):
            result[f"{group}.{name}" if indent else name] = value.strip('"'), comment or ""
    return result


def other_value(name, value, comment):
    """Returns another valid value of a key; None if it is not tried."""
    if name in VALUES:
        return VALUES[name]
    if "0 or 1" in comment:
        return 1 - int(value)
    choices = re.search(r"one of ([\w, ]+?), default", comment)
    if choices:
        return next(word for word in choices[1].split(", ") if word != value)
    try:
        number = float(value)
    except ValueError:
        return None
    changed = 1.5 * number if number else 1
    return round(changed) if "." not in value and number >= 1 else changed


class Keys(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.folder.name)
        cls.config = folder / "config.yaml"
        text = REFERENCE.read_text(encoding="utf-8")
        text = text.replace('depth_topic: ""', 'depth_topic: "/depth"', 1)
        text = text.replace("fisheye: 0", "fisheye: 1", 1)
        cls.config.write_text(pair_flight.halve_images(text), encoding="utf-8")
        cls.flight = folder / "flight"
        command = [SIMULATE, "--asl", cls.flight, "--config", cls.config, *FLIGHT]
        subprocess.run([str(word) for word in command], stderr=subprocess.DEVNULL, check=True)
        cls.features = folder / "features"
        cls.sources = ("--features", cls.features), ("--asl", cls.flight)
        cls().results(cls.sources[1], (), "--save-features", cls.features)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @functools.lru_cache(maxsize=None)
    def results(self, source, overrides, *options):
        """Returns a digest of the poses and the map, or the error."""
        output = pathlib.Path(self.folder.name) / "results"
        command = [RUN_OFFLINE, "--config", self.config, *source, "--output", output, *options]
        for override in overrides:
            command += ["--set", override]
        result = subprocess.run([str(word) for word in command], stderr=subprocess.PIPE,
                                encoding="utf-8", check=False)
        if result.returncode:
            return result.stderr.splitlines()[-1]
        names = ("trajectory.tum", "map.ply", "lines.ply", "covariance.csv")
        return hashlib.md5(b"".join((output / name).read_bytes() for name in names)).hexdigest()

    def has_effect(self, needs, override):
        """Estimates from recorded features first, in half the time; trackers' keys have no effect
        on these."""
        for source in self.sources:
            result = self.results(source, (*needs, override))
            self.assertNotIn("--set", result)  # a valid value
            if result != self.results(source, tuple(needs)):
                return True
        return False

    def test_each_has_an_effect_or_a_reason(self):
        for name, (value, comment) in keys().items():
            changed = other_value(name, value, comment)
            if changed is None or name in REASONS:
                continue
            with self.subTest(key=name, value=changed):
                self.assertTrue(self.has_effect(NEEDS.get(name, []), f"{name}={changed}"))

    def test_reasons_are_those_of_keys(self):
        self.assertLessEqual(set(REASONS) | set(NEEDS) | set(VALUES), set(keys()))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
