# SPDX-License-Identifier: BSD-3-Clause
"""A script's main() that refuses its arguments with one line."""

import contextlib
import io
import unittest


class RefusalTest(unittest.TestCase):
    def assert_refused(self, main, message, *arguments):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(main(arguments), 1)
        self.assertIn(message, errors.getvalue())
        self.assertEqual(errors.getvalue().count("\n"), 1)
