#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests scripts/show_run.py on a run with a known map; opens its page in Chromium if installed."""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np

from dataset_case import flight
from fake_run_offline import write_tum
from folder_case import call

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")
sys.path.insert(0, SCRIPTS)
from evaluation.trajectory import TrajectoryError  # noqa: E402
from pages import run_figures  # noqa: E402
from pages.html import as_json, page  # noqa: E402
from pages.run_folder import RunFolder  # noqa: E402
from show_run import main  # noqa: E402

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))),
                None)
# Warning of WebGL in software: reading pixels back, as plotly does, is slow but correct.
HARMLESS = "Canvas2D: Multiple readback operations"

POINTS = "ply\nformat ascii 1.0\nelement vertex 400 \nproperty float x\nproperty float y\n" \
         "property float z\nend_header\n"
LINES = """ply
format ascii 1.0
element vertex 6
property float x
property float y
property float z
element edge 3
property int vertex1
property int vertex2
property uchar red
property uchar green
property uchar blue
end_header
5 11 9
9 11 9
5 5 8.5
5 5 9.5
7 8 9
8 9 9
0 1 220 40 40
2 3 50 90 230
4 5 140 140 140
"""


def make_run(folder, td=0.0):
    """Writes a run of FLIGHT without errors, in a world that is rotated by 90 degrees and
    translated, with timestamps of images that are `td` too early [s]."""
    stamps, positions = flight()
    stamps = stamps - td
    turned = np.stack([-positions[:, 1], positions[:, 0], positions[:, 2]], axis=1) + [7, 8, 9]
    write_tum(os.path.join(folder, "trajectory.tum"), stamps, turned)
    texts = {"summary.json": json.dumps({"input": "gone.bag", "poses": len(stamps), "images": 410,
                                         "residual_rings": [
                                             {"inner_px": 0.0, "outer_px": 60.0, "count": 9,
                                              "radial_px": 0.1, "deviation_px": 0.2}],
                                         "calibration": {"td_s": td}}),
             "map.ply": POINTS + "".join(f"{7 + x} {8 + y} 9.5\n" for x in np.linspace(-2, 2, 20)
                                         for y in np.linspace(-3, 3, 20)),
             "lines.ply": LINES,
             "loops.csv": "later_ns,earlier_ns,result,x_m,y_m,z_m,yaw_deg\n" + "".join(
                 f"{round(later * 1e9)},{round(earlier * 1e9)},{result},0,0,0,0\n"
                 for later, earlier, result in ((stamps[300], stamps[10], "accepted"),
                                                (stamps[200], stamps[20], "pose"),
                                                (stamps[250], stamps[10] - 1e6, "accepted"))),
             "timing.csv": "stamp_ns,total,points_observed\n" + "".join(
                 f"{round(stamp * 1e9)},{10 + i % 3},{100 + i % 50}\n"
                 for i, stamp in enumerate(stamps))}
    for name, text in texts.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    os.mkdir(os.path.join(folder, "tracks"))
    for seconds in (2, 10):
        name = f"{round((stamps[0] + seconds) * 1e9)}.jpg"
        matplotlib.image.imsave(os.path.join(folder, "tracks", name),
                                np.full((60, 80, 3), 20 * seconds, np.uint8))


class ShowRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.run_folder = os.path.join(self.folder, "run")
        os.mkdir(self.run_folder)
        make_run(self.run_folder)

    def call(self, *options):
        return call(main, self.run_folder, *options)

    @staticmethod
    def write(path, text):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def truth(self):
        path = os.path.join(self.folder, "truth.tum")
        write_tum(path, *flight(rate=100.0))
        return path

    def write_page(self, *options):
        if importlib.util.find_spec("plotly") is None:
            self.skipTest("plotly is not installed")
        result = self.call(*options)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(result.stdout.strip(), encoding="utf-8") as file:
            return result.stdout.strip(), file.read()


class Folder(ShowRun):
    def test_contents(self):
        run = RunFolder.read(self.run_folder)
        self.assertEqual(len(run.points), 400)
        self.assertEqual({axis: len(ends) for axis, ends in run.lines.items()},
                         {"along x": 1, "along y": 0, "along z": 1, "free": 1})
        np.testing.assert_array_equal(run.lines["along z"], [[[5, 5, 8.5], [5, 5, 9.5]]])
        for stamps, seconds in ((run.loops.later, 15.0), (run.loops.earlier, 0.5)):
            np.testing.assert_allclose(stamps - run.trajectory.stamps[0], [seconds], atol=1e-6)
        self.assertEqual(run.loops_left_out, 1)
        self.assertEqual(list(run.images), ["+2.00 s from the first pose",
                                            "+10.00 s from the first pose"])

    def test_what_need_not_be_there(self):
        for name in ("map.ply", "lines.ply", "loops.csv"):
            os.remove(os.path.join(self.run_folder, name))
        shutil.rmtree(os.path.join(self.run_folder, "tracks"))
        run = RunFolder.read(self.run_folder)
        self.assertEqual((len(run.points), len(run.loops), run.images), (0, 0, {}))
        self.assertEqual(sum(map(len, run.lines.values())), 0)
        self.write_page()

    def test_images_of_others_are_left_out(self):
        tracks = os.path.join(self.run_folder, "tracks")
        for name in ("thumb.jpg", "1.5.jpg", ".jpg"):
            self.write(os.path.join(tracks, name), "")
        self.assertEqual(list(RunFolder.read(self.run_folder).images),
                         ["+2.00 s from the first pose", "+10.00 s from the first pose"])

    def test_summary_without_the_recording(self):
        path = os.path.join(self.run_folder, "summary.json")
        self.write(path, "{}")
        self.assertTrue("No ground truth." in self.write_page()[1])
        for damaged in ("[1]", "3", '{"input": '):
            self.write(path, damaged)
            result = self.call()
            self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)

    def test_no_run(self):
        os.remove(os.path.join(self.run_folder, "timing.csv"))
        with self.assertRaisesRegex(TrajectoryError, "not the folder of a finished run"):
            RunFolder.read(self.run_folder)
        result = self.call()
        self.assertEqual(result.returncode, 1)
        self.assertIn("timing.csv", result.stderr)

    def test_damaged_files_are_named(self):
        unfinished = POINTS.replace("400 ", 12 * " ") + "1 2 3\n"
        for name, text, reason in (
                ("timing.csv", "stamp_ns,total\n1,2\n3\n", ":3: 1 columns, expected 2"),
                ("timing.csv", "stamp_ns,total\n", ": no rows"),
                ("map.ply", unfinished, ": damaged"), ("map.ply", "", ": damaged"),
                ("map.ply", POINTS + "1 2 3\n1 2", ": damaged"),
                ("lines.ply", LINES.replace("4 5 140", "4 6 140"), ": damaged"),
                ("lines.ply", LINES[:-4], ": damaged"),
                ("loops.csv", "later_ns,earlier_ns\n1,2\n", ": damaged")):
            path = os.path.join(self.run_folder, name)
            with open(path, encoding="utf-8") as file:
                good = file.read()
            self.write(path, text)
            with self.assertRaisesRegex(TrajectoryError, name + reason):
                RunFolder.read(self.run_folder)
            self.write(path, good)
        self.write(os.path.join(self.run_folder, "map.ply"), unfinished)
        result = self.call()
        self.assertEqual((result.returncode, result.stderr.count("\n")), (1, 1), result.stderr)


class Figures(unittest.TestCase):
    def test_far_points_do_not_make_the_scene_small(self):
        path = np.array([[0.0, 0, 0], [10, 10, 1]])
        points = np.concatenate([np.random.default_rng(1).uniform(0, 10, (100, 3)),
                                 [[1e5, 0, 0]]])
        figure = run_figures.scene_figure({"estimate": path}, points)
        traces = {trace["name"]: trace for trace in figure["data"]}
        self.assertEqual(list(traces), ["points", "estimate"])
        self.assertLess(max(traces["points"]["x"]), 20)
        self.assertGreater(len(traces["points"]["x"]), 50)

    def test_the_first_look_is_at_the_trajectory(self):
        path = np.random.default_rng(1).uniform(-0.3, 0.3, (100, 3)) + [0, 0, 1]
        points = np.random.default_rng(2).uniform([0, 0, 0], [20, 6, 3], (400, 3))
        scene = run_figures.scene_figure({"estimate": path}, points)["layout"]["scene"]
        ranges = np.array([scene[f"{axis}axis"]["range"] for axis in "xyz"])
        sizes = ranges[:, 1] - ranges[:, 0]
        np.testing.assert_allclose([scene["aspectratio"][axis] for axis in "xyz"],
                                   sizes / sizes.max())
        center = ranges.mean(axis=1) + sizes.max() * np.array(
            [scene["camera"]["center"][axis] for axis in "xyz"])
        np.testing.assert_allclose(center, (path.min(axis=0) + path.max(axis=0)) / 2)
        self.assertGreater(scene["camera"]["eye"]["z"], scene["camera"]["center"]["z"])
        inside = (points >= ranges[:, 0]) & (points <= ranges[:, 1])
        self.assertGreater(inside.mean(), 0.95)
        json.dumps(scene)

    def test_residuals_are_drawn_by_distance(self):
        rings = [{"inner_px": 50.0 * i, "outer_px": 50.0 * (i + 1), "count": 10 * i,
                  "radial_px": 0.01 * i, "deviation_px": 0.2} for i in range(3)]
        radial, deviation = run_figures.rings_figure(rings)["data"]
        self.assertEqual((radial["x"], radial["y"]), ([75.0, 125.0], [0.01, 0.02]))
        self.assertEqual(deviation["y"], [0.2, 0.2])

    def test_segments_are_apart(self):
        lines = {"free": np.array([[[0.0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0]]])}
        figure = run_figures.scene_figure({"estimate": np.array([[0.0, 0, 0], [1, 1, 1]])},
                                          lines=lines)
        self.assertEqual(figure["data"][0]["x"], [0.0, 1.0, None, 0.0, 1.0, None])


class Page(ShowRun):
    def test_is_self_contained(self):
        _, text = self.write_page("--groundtruth", self.truth())
        from plotly.offline import get_plotlyjs
        own = text.replace(get_plotlyjs(), "")
        self.assertEqual(re.findall(r"\b(?:src|href)\s*=\s*'[^']*|url\([^)]*", own), [])
        self.assertEqual(own.count("data:image/jpeg;base64,"), 2)
        self.assertIn("Plotly.newPlot('rings'", own)

    def test_map_is_in_the_world_of_the_truth(self):
        text = self.write_page("--groundtruth", self.truth())[1]
        self.assert_map_is_in_the_world_of_the_truth(text)
        self.assertFalse("stamps of the estimate shifted" in text)

    def test_map_of_a_camera_with_a_time_offset(self):
        shutil.rmtree(self.run_folder)
        os.mkdir(self.run_folder)
        make_run(self.run_folder, td=0.03)
        text = self.write_page("--groundtruth", self.truth())[1]
        self.assert_map_is_in_the_world_of_the_truth(text)
        self.assertTrue("stamps of the estimate shifted by +30.00 ms" in text)
        self.assertTrue("+2.00 s from the first pose" in text)

    def assert_map_is_in_the_world_of_the_truth(self, text):
        start = text.index("Plotly.newPlot('scene', ") + len("Plotly.newPlot('scene', ")
        traces = {trace["name"]: trace
                  for trace in json.JSONDecoder().raw_decode(text, start)[0]}

        def positions(name):
            return np.transpose([traces[name][axis] for axis in "xyz"])

        np.testing.assert_allclose(positions("estimate"), flight()[1], atol=2e-4)
        self.assertEqual(len(positions("ground truth")), 2001)
        np.testing.assert_allclose(positions("loops")[:2].astype(float), flight()[1][[300, 10]],
                                   atol=2e-4)
        self.assertEqual(len(positions("loops")), 3, "one, and the gap behind it")
        self.assertTrue("Loops to an earlier map, excluded: 1" in text)
        self.assertTrue("coverage 100.0 %" in text)

    def test_without_ground_truth(self):
        _, text = self.write_page("--output", os.path.join(self.folder, "page.html"))
        self.assertTrue("No ground truth." in text)
        self.assertFalse("Plotly.newPlot('error'" in text)

    def test_ground_truth_of_another_time(self):
        path = os.path.join(self.folder, "truth.tum")
        stamps, positions = flight()
        write_tum(path, stamps + 1000, positions)
        self.assertTrue("no overlap in time" in self.write_page("--groundtruth", path)[1])

    def test_a_part_of_a_run(self):
        self.write(os.path.join(self.run_folder, "trajectory_1.tum"), "")
        text = self.write_page("--groundtruth", self.truth())[1]
        self.assertTrue("Not compared with the ground truth: timestamps of the recording jumped"
                        " back, earlier poses are in trajectory_1.tum" in text)

    def test_text_cannot_end_a_script(self):
        self.assertNotIn("</script>", as_json("</script>"))
        if importlib.util.find_spec("plotly"):
            self.assertIn("a&lt;b", page("a<b", []))

    @unittest.skipIf(CHROMIUM is None, "no Chromium is installed")
    def test_in_a_browser(self):
        path, _ = self.write_page("--groundtruth", self.truth())
        picture = os.path.join(self.folder, "page.png")
        result = subprocess.run(
            [CHROMIUM, "--headless", "--no-sandbox", "--disable-dev-shm-usage",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1000,2600",
             "--virtual-time-budget=20000", "--enable-logging=stderr", f"--screenshot={picture}",
             f"--user-data-dir={os.path.join(self.folder, 'profile')}", f"file://{path}"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8", check=False,
            timeout=120)
        messages = [line for line in result.stdout.splitlines() if ":CONSOLE" in line]
        self.assertEqual([m for m in messages if HARMLESS not in m], [])
        pixels = np.round(255 * matplotlib.image.imread(picture)[..., :3]).astype(int)
        scene = pixels[200:850]
        for color in (run_figures.ESTIMATE_COLOR, run_figures.LINE_COLORS["along z"],
                      run_figures.POINT_COLOR, run_figures.LOOP_COLOR):
            self.assertGreater(self.count(scene, color), 30, color)
        self.assertGreater(self.count(pixels[850:], "#1f77b4"), 300, "curves over time")

    @staticmethod
    def count(pixels, color):
        wanted = [int(color[i:i + 2], 16) for i in (1, 3, 5)]
        return int((np.abs(pixels - wanted).max(axis=-1) < 25).sum())


if __name__ == "__main__":
    unittest.main()
