#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests claims.py with a program that writes a known trajectory."""

import contextlib
import io
import pathlib
import re
import shutil
import sys
import unittest

from folder_case import FolderTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "test" / "tools"))
import claims  # noqa: E402

TABLE = """
errors:
  kind: errors
  pages: [page.md]
  cell: "{0:.0f} / {1:.0f}, {2:+.1f} %"
  recordings: [{name: flight, starts: [0, 1]}]
  rows: [{title: default}, {title: points alone, set: {use_lines: 0}}]
"""
PAGE = "# Page\n\n<!-- claims errors -->\nold\n<!-- end of claims -->\nrest\n"
# Writes a trajectory on a circle of 1 m, 2 % too large; with points alone 4 %.
PROGRAM = """#!/usr/bin/python3
import math, os, sys
folder = sys.argv[sys.argv.index("--output") + 1]
os.makedirs(folder)
radius = 1.04 if "use_lines=0" in sys.argv else 1.02
with open(folder + "/trajectory.tum", "w") as file:
    for i in range(50):
        x, y = radius * math.cos(0.1 * i), radius * math.sin(0.1 * i)
        file.write(f"{0.1 * i:.1f} {x} {y} 0 0 0 0 1\\n")
open(folder + "/summary.json", "w").write("{}")
"""


class Claims(FolderTest):
    def setUp(self):
        super().setUp()
        self.folder = pathlib.Path(self.folder)
        (self.folder / "claims.yaml").write_text(TABLE, encoding="utf-8")
        self.page = self.folder / "page.md"
        self.page.write_text(PAGE, encoding="utf-8")
        program = self.folder / "program"
        program.write_text(PROGRAM, encoding="utf-8")
        program.chmod(0o755)

    def write_tables(self, *arguments):
        with contextlib.redirect_stdout(io.StringIO()) as output:
            claims.main([str(self.folder), "--pages", str(self.folder), "--claims",
                         str(self.folder / "claims.yaml"), "--output", str(self.folder / "runs"),
                         "--run-offline", str(self.folder / "program"), *arguments])
        return output.getvalue()

    def add_recording(self):
        (self.folder / "flight.bag").write_bytes(b"")
        claims.subprocess.run([str(self.folder / "program"), "--output", str(self.folder / "t")],
                              check=True)
        rows = (self.folder / "t" / "trajectory.tum").read_text(encoding="utf-8").splitlines()
        truth = [row.split() for row in rows]
        (self.folder / "flight.tum").write_text("".join(
            f"{t} {float(x) / 1.02} {float(y) / 1.02} 0 0 0 0 1\n" for t, x, y, *_ in truth),
            encoding="utf-8")

    def test_writes_the_means_between_the_markers(self):
        self.add_recording()
        self.assertIn("errors: written", self.write_tables())
        page = self.page.read_text(encoding="utf-8")
        self.assertRegex(page, r"\| default +\| \d+ / 0, \+2\.0 % \|")
        self.assertRegex(page, r"\| points alone +\| \d+ / 0, \+4\.0 % \|")
        self.assertRegex(page, r"\*Commit .*, 4 runs\.\*")
        self.assertNotIn("old", page)
        self.assertTrue(page.endswith("<!-- end of claims -->\nrest\n"))

    def test_a_table_without_its_recordings_stays(self):
        self.assertIn("errors: stays, without flight", self.write_tables())
        self.assertEqual(self.page.read_text(encoding="utf-8"), PAGE)

    def test_missing_markers_are_named(self):
        self.add_recording()
        self.page.write_text("# Page\n", encoding="utf-8")
        with self.assertRaisesRegex(claims.ClaimsError, "markers of the table errors"):
            self.write_tables()

    def test_unknown_tables_are_named(self):
        with self.assertRaisesRegex(claims.ClaimsError, "nothing: no such table"):
            self.write_tables("--only", "nothing")


class Pages(FolderTest):
    def test_have_exactly_the_tables_that_are_claimed(self):
        tables = claims.yaml.safe_load((ROOT / "test" / "tools" / "claims.yaml").read_text(
            encoding="utf-8"))
        claimed = {(page, name) for name, table in tables.items() for page in table["pages"]}
        pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
        marked = {(str(page.relative_to(ROOT)), name) for page in pages for name in re.findall(
            r"<!-- claims (\w+) -->", page.read_text(encoding="utf-8"))}
        self.assertEqual(claimed, marked)

    def test_have_the_figures_of_other_programs_as_claimed(self):
        folder = pathlib.Path(self.folder)
        shutil.copy(ROOT / "README.md", folder)
        shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("images"))
        with contextlib.redirect_stdout(io.StringIO()):
            claims.main(["--pages", str(folder)])
        for page in ["README.md", "docs/comparison.md"]:
            self.assertEqual((folder / page).read_text(encoding="utf-8"),
                             (ROOT / page).read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
