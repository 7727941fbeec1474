#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of .ci/check_words.py: problems that it reports, text that it accepts, changed lines."""

import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(REPOSITORY, ".ci"))
import check_words  # noqa: E402


class CheckWords(unittest.TestCase):
    def problems(self, text, name="a.h", lines=None):
        return list(check_words.check(name, text, lines))

    def assert_clean(self, text, name="a.h"):
        self.assertEqual(self.problems(text, name), [])

    def assert_problem(self, message, text, name="a.h"):
        problems = self.problems(text, name)
        self.assertEqual(len(problems), 1, problems)
        self.assertIn(message, problems[0])

    def test_openings(self):
        self.assert_problem("a.h:2: opens", "int a;\n// What of the line is known.\n")
        self.assert_problem("opens", "  // Since which image the body is stationary.\n")
        self.assert_problem("opens", "# Of all frames.\n", "a.py")
        self.assert_clean("// Returns the part\n// Of which nobody spoke.\n")
        self.assert_clean("// As long as it is null.\n\n// Whether.\nint a;  // Of the frame\n")

    def test_pronouns(self):
        self.assert_problem("only pronouns", "int a;  // the same of those\n")
        self.assert_clean("int a;  // the same for lines\n// in both\n\n// namespace\n")

    def test_glossary(self):
        self.assert_problem("'at rest': standstill", "// The body is at\n// rest.\n")
        self.assert_problem("'is refused': reject", "int a;  // it is refused\n")
        self.assert_problem("'ten or more': at least", "Takes ten or more images.\n", "a.md")
        self.assert_clean('// The key `at rest` and "left out".\nconst char* a = "refused";\n')

    def test_trailing_comments_go_on_in_the_next_line(self):
        text = "int a;  // it is\n        // refused\n// Of b.\n"
        refused, opening = self.problems(text)
        self.assertIn("a.h:1: 'is refused'", refused)
        self.assertIn("a.h:3: opens", opening)
        self.assertEqual(self.problems(text, lines={2}), [refused])
        self.assertEqual(self.problems(text, lines={3}), [opening])

    def test_only_changed_comments_of_a_repository(self):
        def git(*arguments):
            subprocess.run(("git", "-c", "user.name=a", "-c", "user.email=a@b", *arguments),
                           check=True, stdout=subprocess.DEVNULL)
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                git("init", "--quiet")
                for text in ("// Of a.\n\n// Returns b.\n", "// Of a.\n\n// Of b.\n"):
                    pathlib.Path("a.h").write_text(text, encoding="utf-8")
                    git("add", ".")
                    git("commit", "--quiet", "-m", "a")
                with contextlib.redirect_stdout(io.StringIO()) as output:
                    code = check_words.main([])
            finally:
                os.chdir(before)
        self.assertEqual(code, 1)
        self.assertEqual(output.getvalue().splitlines()[:-1],
                         ["a.h:3: opens without a subject: Of b."])


if __name__ == "__main__":
    unittest.main()
