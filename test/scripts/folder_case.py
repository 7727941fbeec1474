# SPDX-License-Identifier: BSD-3-Clause
"""Test case with a temporary folder, and calls of scripts."""

import contextlib
import io
import os
import tempfile
import unittest
from types import SimpleNamespace


def call(main, *arguments):
    """Calls a script in this process, since loading its libraries takes most of a call."""
    stdout, stderr = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(stdout), contextlib.redirect_stderr(stderr):
        try:
            code = main([str(word) for word in arguments])
        except SystemExit as end:  # of the parser of arguments
            code = end.code
    return SimpleNamespace(returncode=code, stdout=stdout.getvalue(), stderr=stderr.getvalue())


class FolderTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = os.path.realpath(folder.name)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, content):
        """Writes text or bytes to a file, and makes its folder; returns its path."""
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
        return path

    def assert_refused(self, main, message, *arguments):
        """Expects exit code 1 and a single line with the message."""
        result = call(main, *arguments)
        self.assertEqual(result.returncode, 1)
        self.assertIn(message, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
