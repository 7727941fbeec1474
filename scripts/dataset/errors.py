# SPDX-License-Identifier: BSD-3-Clause
"""The error that ends the program."""


class DatasetError(Exception):
    """An error that the user can correct; its text names the cause and the remedy in one line."""
