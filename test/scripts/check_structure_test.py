#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of .ci/check_structure.py: problems that it reports, code that it accepts."""

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

REPOSITORY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(REPOSITORY, ".ci"))
import check_structure  # noqa: E402

HEADER = check_structure.SPDX + "\n#pragma once\n"


class CheckStructure(unittest.TestCase):
    def check(self, name, text):
        """Returns exit code and output for a source tree with only this file."""
        return self.check_tree({name: text})

    def check_tree(self, texts):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in texts.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            with contextlib.redirect_stdout(io.StringIO()) as output:
                code = check_structure.main(pathlib.Path(folder))
        return code, output.getvalue()

    def assert_clean(self, name, text):
        self.assertEqual(self.check(name, text)[0], 0, self.check(name, text)[1])

    def assert_problem(self, name, text, message):
        code, output = self.check(name, text)
        self.assertEqual(code, 1)
        self.assertIn(message, output)
        self.assertIn(name, output)

    def test_clean_files(self):
        self.assert_clean("common/a.h", HEADER + '#include "common/b.h"\n#include <vector>\n')
        self.assert_clean("common/ros/a.h", HEADER + "#include <ros/ros.h>\n")
        self.assert_clean("test/common/a_test.cpp",
                          HEADER + '#include "simulator/b.h"\n#include <ros/time.h>\n')
        self.assert_clean("scripts/a.sh", 'ls "$root/work/file" build/home/x ~/work/x\n')

    def test_columns_of_python(self):
        self.assert_clean("scripts/a.py", "#" * 100 + "\n")
        self.assert_problem("scripts/a.py", "#" * 101 + "\n", "101 columns")

    def test_python_of_noetic(self):
        self.assert_problem("scripts/a.py", "match x:\n    case 1:\n        pass\n",
                            "(Python 3.8)")

    def test_names_that_ubuntu_20_04_lacks(self):
        for name, text in {
                "common/a.h": HEADER + "Eigen::Vector<double, 5> a;\n",
                "common/b.h": HEADER + "#include <execution>\nauto a = std::execution::par;\n",
                "cmake/a.cmake": "find_program(A a REQUIRED)\n",
                "test/CMakeLists.txt": "cmake_path(GET a FILENAME b)\n",
                "scripts/a.py": f"a = b.{'removeprefix'}('c')\n"}.items():
            self.assert_problem(name, text, "newer than Ubuntu 20.04")
        self.assert_clean("common/a.h", HEADER + "Eigen::Vector3d a;\n")
        self.assert_clean("cmake/a.cmake", "find_program(A a)\nfile(WRITE b c)\n")
        self.assert_clean("scripts/a.py", "a = list(b)[0]\n")

    def test_types_of_one_name(self):
        def header(space, definition):
            return HEADER + f"namespace {space} {{\n{definition}\n}}\n"
        tracker = header("plm_vins", "struct Options {\n};")
        taken = "tracking/a.h: Options is defined in common/a.h, too"
        for definition in ("struct Options {", "class Options final : public Base<int> {",
                           "enum class Options : int {"):
            code, output = self.check_tree({"common/a.h": header("plm_vins", definition),
                                            "tracking/a.h": tracker})
            self.assertEqual(code, 1)
            self.assertIn(taken, output)
        for other in (header("plm_vins::simulator", "struct Options {\n};"),
                      header("plm_vins", "struct Options;"),
                      header("plm_vins", "class A {\n  struct Options {};\n};")):
            self.assertEqual(self.check_tree({"common/a.h": other, "tracking/a.h": tracker})[0], 0)
        twice = header("plm_vins", "#if A\nstruct B {\n};\n#else\nstruct B {\n};\n#endif")
        self.assert_clean("common/a.h", twice)

    def test_ros_outside_of_its_folders(self):
        for include in ("<ros/ros.h>", "<sensor_msgs/Imu.h>", '"cv_bridge/cv_bridge.h"'):
            self.assert_problem("common/a.h", HEADER + f"#include {include}\n", "ROS outside")

    def test_layers(self):
        for name, include in [("common/a.h", "feature_tracker/b.h"),
                              ("feature_tracker/a.h", "linefeature_tracker/b.h"),
                              ("linefeature_tracker/ros/a.h", "vins_estimator/b.h"),
                              ("vins_estimator/a.h", "feature_tracker/b.h"),
                              ("vins_estimator/a.h", "simulator/b.h"),
                              ("vins_estimator/a.h", "vins_estimator/output/b.h"),
                              ("vins_estimator/state/a.h", "vins_estimator/geometry/b.h"),
                              ("vins_estimator/map/a.h", "vins_estimator/factors/b.h"),
                              ("vins_estimator/recall/a.h", "vins_estimator/merging/b.h"),
                              ("vins_estimator/recall/a.h", "vins_estimator/estimator.h"),
                              ("vins_estimator/output/a.h", "vins_estimator/estimator.h"),
                              ("vins_estimator/state/a.h", "vins_estimator/map/b.h"),
                              ("common/imu/a.h", "common/config/b.h"),
                              ("feature_tracker/following/a.h", "feature_tracker/detection/b.h"),
                              ("pose_graph/graph/a.h", "pose_graph/map/b.h"),
                              ("offline/pipeline/a.h", "offline/results/b.h"),
                              ("offline/a.h", "vins_estimator/problem/b.h"),
                              ("simulator/a.h", "vins_estimator/imu/b.h"),
                              ("common/a.h", "test/testing/b.h")]:
            self.assert_problem(name, HEADER + f'#include "{include}"\n', "must not know")
        for name, include in [("offline/a.h", "feature_tracker/b.h"),
                              ("vins_estimator/output/a.h", "vins_estimator/state/b.h"),
                              ("vins_estimator/recall/a.h", "vins_estimator/map/b.h"),
                              ("simulator/a.h", "vins_estimator/state/b.h")]:
            self.assert_clean(name, HEADER + f'#include "{include}"\n')

    def test_layers_that_include_each_other(self):
        files = {"common/a.h": HEADER + '#include "tracking/b.h"\n',
                 "tracking/b.h": HEADER + '#include "common/c.h"\n'}
        with unittest.mock.patch.dict(check_structure.LAYERS, {"common": {"tracking"}}):
            code, output = self.check_tree(files)
            self.assertEqual(code, 1)
            self.assertIn("common and tracking include each other", output)
            del files["tracking/b.h"]
            self.assertEqual(self.check_tree(files)[0], 0)

    def test_a_folder_and_its_parent_that_include_each_other(self):
        files = {"tracking/a.h": HEADER + '#include "tracking/stereo/b.h"\n',
                 "tracking/stereo/b.h": HEADER + '#include "tracking/c.h"\n'}
        with unittest.mock.patch.dict(check_structure.LAYERS,
                                      {"tracking/stereo": {"tracking/c.h"}, "tracking/c.h": set()}):
            code, output = self.check_tree(files)
            self.assertEqual(code, 1)
            self.assertIn("tracking and tracking/stereo include each other", output)

    def test_ceres_by_a_detour(self):
        files = {"vins_estimator/ros/a.cpp": HEADER + '#include "vins_estimator/b.h"\n',
                 "vins_estimator/b.h": HEADER + '#include "vins_estimator/problem/c.h"\n',
                 "vins_estimator/problem/c.h": HEADER + "#include <ceres/problem.h>\n"}
        code, output = self.check_tree(files)
        self.assertEqual(code, 1)
        self.assertIn("vins_estimator/ros/a.cpp: includes Ceres by way of", output)
        files["vins_estimator/b.h"] = HEADER + '#include "vins_estimator/map/c.h"\n'
        self.assertEqual(self.check_tree(files)[0], 0)

    def test_header_rules(self):
        self.assert_problem("common/a.h", "#pragma once\n", "first line")
        self.assert_problem("common/a.h", HEADER + "using namespace std;\n", "using namespace")
        self.assert_clean("common/a.cpp", HEADER + "using namespace std::literals;\n")

    def test_sizes(self):
        self.assert_clean("common/a.cpp", HEADER + "\n" * 398)
        self.assert_problem("common/a.cpp", HEADER + "\n" * 399, "401 lines")

    @unittest.skipUnless(check_structure.find_ctags(), "universal-ctags is not installed")
    def test_function_lengths(self):
        self.assert_clean("common/a.cpp", HEADER + "void F() {\n" + "  G();\n" * 58 + "}\n")
        self.assert_problem("common/a.cpp", HEADER + "void F() {\n" + "  G();\n" * 59 + "}\n",
                            "F() has 61 lines")

    def test_absolute_paths(self):
        for text in ('"/' + 'home/me/data"', "cd /" + "work/main", "path: /" + "Users/me"):
            self.assert_problem("config/a.yaml", text + "\n", "absolute path")
        self.assert_clean("test/a.h", HEADER + "// /home/somebody/output\n")

    def test_links(self):
        page = "# One & two\n[a](#one--two) [b](other.md) ![c](https://example.org/x.png)\n"
        self.assert_problem("docs/a.md", page, "no such file other.md")
        self.assert_clean("docs/a.md", page.replace("other.md", "../docs/a.md#one--two"))
        self.assert_problem("docs/a.md", page.replace("#one", "#two"), "no such heading #two--two")


if __name__ == "__main__":
    unittest.main()
