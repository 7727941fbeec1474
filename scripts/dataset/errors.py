# SPDX-License-Identifier: BSD-3-Clause
"""The error that ends the program."""


class DatasetError(Exception):
    """Something that the user has to put right; the text names it and says how, in one line."""
