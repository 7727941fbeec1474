#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the messages of run_offline if it cannot estimate a trajectory.

Usage: run_offline_test.py RUN_OFFLINE [unittest option ...]
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CONFIG = ROOT / "config" / "euroc.yaml"
RUN_OFFLINE = sys.argv[1] if len(sys.argv) > 1 else sys.exit(__doc__)


class RunOffline(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.asl = self.folder / "asl"
        self.write("cam0/data.csv", "100000000,missing.png\n")
        self.write("imu0/data.csv", "100000000,0,0,0,0,0,9.81\n200000000,0,0,0,0,0,9.81\n")

    def write(self, name, text):
        path = self.asl / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def assert_refuses(self, message, *options, config=CONFIG, source=None, output="results"):
        """Expects exit code 1 and a line of output that contains `message`."""
        command = [RUN_OFFLINE, "--config", config, *(source or ("--asl", self.asl)),
                   "--output", self.folder / output, *options]
        result = subprocess.run([str(word) for word in command], stderr=subprocess.PIPE,
                                encoding="utf-8", check=False)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn(message, result.stderr)

    def summary(self):
        return json.loads((self.folder / "results" / "summary.json").read_text(encoding="utf-8"))

    def test_bad_options(self):
        self.assert_refuses("expected seconds, zero to 1e9, instead of nan", "--start", "nan")
        self.assert_refuses("expected seconds, zero to 1e9, instead of -2", "--duration", "-2")
        self.assert_refuses("expected key=value instead of freq", "--set", "freq")
        self.assert_refuses("--threads: expected 1, 2, 3 or 4 instead of 5", "--threads", "5")
        self.assert_refuses("unrecognised option '--durations'", "--durations", "2")

    def test_options_that_are_missing_or_given_twice(self):
        self.assert_refuses("exactly one of --bag, --asl and --features is required", "--bag",
                            "flight.bag")
        self.assert_refuses("exactly one of --bag, --asl and --features is required",
                            source=("--threads", "1"))
        self.assert_refuses("option '--output' cannot be specified more than once", "--output", "x")
        self.assert_refuses("the required argument for option '--start' is missing", "--start")

    def test_paths_that_are_empty(self):
        for option in ["--map-in", "--map-out", "--save-features", "--features", "--bag"]:
            self.assert_refuses(f"{option}: expected a path, but it is empty", option, "")
        self.assert_refuses("--config: expected a path, but it is empty", config="")
        self.assert_refuses("--asl: expected a path, but it is empty", source=("--asl", ""))

    def test_bad_config(self):
        self.assert_refuses("nothing.yaml", config=self.folder / "nothing.yaml")
        self.assert_refuses("frequ: unknown key; did you mean freq?", "--set", "frequ=3")

    def test_several_values_set_at_once(self):
        for options in [["--set", "freq=5", "max_cnt=0"],
                        ["--set", "freq=5", "--set", "max_cnt=0"],
                        ["--set", "freq=5", "max_cnt=0", "--start", "0"]]:
            self.assert_refuses("max_cnt", *options)
        self.assert_refuses("expected key=value instead of max_cnt", "--set", "freq=5", "max_cnt")

    def test_keys_without_effect(self):
        config = self.folder / "vins.yaml"
        config.write_text(CONFIG.read_text(encoding="utf-8") + "\nmin_loop_num: 1\nvoc_file: x\n",
                          encoding="utf-8")
        self.assert_refuses(f"warning: {config}: keys without effect: min_loop_num, voc_file\n",
                            config=config)

    def test_loops_without_images(self):
        self.assert_refuses("loop closure needs images", "--map-out", "map.plm",
                            source=("--features", "none.features"))

    def test_track_images_without_images(self):
        self.assert_refuses("--save-track-images needs images", "--save-track-images", "0.5",
                            source=("--features", "none.features"))

    def test_features_that_were_recorded_with_other_values(self):
        features = self.folder / "flight.features"
        values = {"freq": 10.0, "max_cnt": 150, "use_lines": False, "min_dist": 30.0}
        text = json.dumps(values).encode()
        features.write_bytes(b"plm_features v3\n" + struct.pack("<I", len(text)) + text)
        recorded = ["--set", "freq=10", "max_cnt=150", "use_lines=0", "min_dist=30"]
        other = ["--set", "freq=5", "max_cnt=30", "use_lines=1", "min_dist=30"]
        warning = f"warning: {features} was recorded with other values of freq, max_cnt, use_lines"
        self.assert_refuses(warning, *other, source=("--features", features))
        self.assertEqual(self.summary()["features_recorded_with"],
                         {"freq": 10.0, "max_cnt": 150, "use_lines": False})
        self.assert_refuses("no trajectory", *recorded, source=("--features", features))
        self.assertNotIn("features_recorded_with", self.summary())
        again = self.folder / "again.features"  # keeps the values used for the features
        self.assert_refuses(warning, *other, "--save-features", again,
                            source=("--features", features))
        self.assert_refuses(warning.replace(str(features), str(again)), *other,
                            source=("--features", again))

    def test_features_that_would_overwrite_themselves(self):
        features = self.folder / "flight.features"
        features.write_text("kept", encoding="utf-8")
        link = self.folder / "link.features"
        link.symlink_to(features)
        self.assert_refuses("--save-features would overwrite the input",
                            "--save-features", link, source=("--features", features))
        self.assert_refuses("--save-features would overwrite the input",
                            "--save-features", link, source=("--bag", features))
        self.assert_refuses("--map-out would overwrite the input", "--map-out", link,
                            source=("--bag", features))
        self.assert_refuses("--save-features would overwrite the input", "--save-features", link,
                            "--map-in", features)
        self.assert_refuses("--map-out would overwrite the input", "--map-out", link,
                            config=features)
        self.assert_refuses("is not a map of plm_vins", "--map-in", features, "--map-out", features)
        self.assert_refuses(f"both name {link}", "--save-features", features, "--map-out", link)
        self.assert_refuses("both name x.plm", "--save-features", "./x.plm", "--map-out", "x.plm")
        self.assertEqual(features.read_text(encoding="utf-8"), "kept")

    def test_outputs_that_would_overwrite_a_table_of_the_recording(self):
        for table in ["imu0/data.csv", "cam0/data.csv"]:
            for option in ["--save-features", "--map-out"]:
                self.assert_refuses(f"{option} would overwrite the input", option,
                                    self.folder / "asl" / table)

    def test_files_whose_place_a_result_would_take(self):
        results = self.folder / "results"
        results.mkdir()
        link = self.folder / "link"
        link.symlink_to(results)
        for name in ["map.ply", "summary.json", "trajectory.tum", "loops.csv"]:
            for folder in [results, link]:
                for option in ["--map-in", "--map-out", "--save-features"]:
                    self.assert_refuses(f"which the run replaces by its own {name}; choose another",
                                        option, folder / name)
        config = results / "summary.json"
        config.write_text(CONFIG.read_text(encoding="utf-8"), encoding="utf-8")
        self.assert_refuses("by its own summary.json", config=config)
        self.assertEqual(list(results.iterdir()), [config])

    def test_a_configuration_whose_place_the_calibration_would_take(self):
        results = self.folder / "results"
        results.mkdir()
        config = results / "calibrated.yaml"
        text = CONFIG.read_text(encoding="utf-8")
        config.write_text(text, encoding="utf-8")
        self.assert_refuses(f"--config names {config}, which the run replaces by its own "
                            "calibrated.yaml", "--set", "estimate_intrinsics=1", config=config)
        self.assertEqual(config.read_text(encoding="utf-8"), text)

    def test_earlier_results_stay_where_nothing_can_be_run(self):
        results = self.folder / "results"
        results.mkdir()
        (results / "trajectory.tum").write_text("of before", encoding="utf-8")
        self.assert_refuses("no such file", "--map-in", self.folder / "missing.plm")
        self.assert_refuses("cannot write", "--map-out", self.folder / "missing" / "map.plm")
        self.assert_refuses("cannot write", "--save-features", self.folder / "missing" / "x")
        self.assertEqual((results / "trajectory.tum").read_text(encoding="utf-8"), "of before")

    def test_a_previous_map_that_is_not_there(self):
        folder = self.folder / "of" / "another" / "machine"
        options = ["--set", "loop_closure=1", "--set", "load_previous_pose_graph=1",
                   "--set", f"pose_graph_save_path={folder}"]
        self.assert_refuses(f"warning: load_previous_pose_graph: there is no map {folder}",
                            *options)
        self.assert_refuses("images: images_unreadable: 1", *options)
        folder.mkdir(parents=True)
        (folder / "pose_graph.plm").write_text("damaged", encoding="utf-8")
        self.assert_refuses("is not a map of plm_vins", *options)

    def test_files_that_nothing_is_written_to_where_the_output_cannot_be(self):
        features = self.folder / "good.features"
        features.write_text("kept", encoding="utf-8")
        self.assert_refuses("cannot make the output folder", "--save-features", features,
                            output="asl/imu0/data.csv")
        self.assertEqual(features.read_text(encoding="utf-8"), "kept")
        self.assert_refuses("cannot make the output folder", output="x" * 300)
        self.assert_refuses("--save-features would overwrite the input", "--save-features",
                            CONFIG)

    def test_a_map_in_a_result_folder_that_is_not_there_yet(self):
        self.assert_refuses("images: images_unreadable: 1",
                            "--map-out", self.folder / "new" / "map.plm",
                            output="new")
        self.assertFalse((self.folder / "new" / "map.plm").exists())

    def test_a_map_is_not_replaced_by_an_empty_one(self):
        self.write("good.plm", "a map of before")
        self.assert_refuses("good.plm is not written", "--map-out", self.folder / "asl/good.plm")
        self.assertEqual((self.folder / "asl/good.plm").read_text(encoding="utf-8"),
                         "a map of before")

    def test_the_configuration_stays_in_its_result_folder(self):
        results = self.folder / "results"
        results.mkdir()
        config = results / "calibrated.yaml"
        config.write_text(CONFIG.read_text(encoding="utf-8"), encoding="utf-8")
        for name in ["evaluation.json", "run.html", "loops.csv"]:
            (results / name).write_text("of before", encoding="utf-8")
        self.assert_refuses("images: images_unreadable: 1",
                            "--set", "estimate_intrinsics=0", config=config)
        self.assertTrue(config.is_file())
        self.assertFalse((results / "evaluation.json").exists())

    def test_input_that_is_incomplete(self):
        self.write("imu0/data.csv", "")
        self.assert_refuses("no IMU sample")
        (self.asl / "imu0" / "data.csv").unlink()
        self.assert_refuses("imu0/data.csv is missing")

    def test_no_usable_image(self):
        self.assert_refuses("images_unreadable: 1 (first: ")
        self.assert_refuses(f"from {self.asl / 'cam0' / 'data.csv'}\n")
        self.assert_refuses("no trajectory from 1 images: images_unreadable: 1")
        self.assert_refuses("none between --start and --duration", "--start", "40")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
