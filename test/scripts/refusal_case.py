# SPDX-License-Identifier: BSD-3-Clause
"""Test case for scripts whose main() rejects its arguments with a single line."""

import contextlib
import io

from folder_case import FolderTest


class RefusalTest(FolderTest):
    def assert_refused(self, main, message, *arguments):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(main(arguments), 1)
        self.assertIn(message, errors.getvalue())
        self.assertEqual(errors.getvalue().count("\n"), 1)
