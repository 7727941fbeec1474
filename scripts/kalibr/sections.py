# SPDX-License-Identifier: BSD-3-Clause
"""Checked values of the maps in Kalibr's files."""

import math
import os

import numpy as np
import yaml

MAX_ROTATION_ERROR = 5e-3  # accepted by the configuration reader


class KalibrError(Exception):
    """One problem of an input file; its text names file and key."""


class Section:
    """A map of a Kalibr file. Returns checked values; errors name file and key."""

    def __init__(self, file, path, values):
        self.file, self.path, self.values = file, path, values
        if not isinstance(values, dict):
            raise self.error("", "must be a mapping of keys")

    def error(self, key, problem):
        name = ".".join(part for part in (self.path, key) if part)
        return KalibrError(f"{self.file}: {name + ': ' if name else ''}{problem}")

    def get(self, key, hint="add it"):
        if key not in self.values:
            raise self.error(key, f"is missing; {hint}")
        return self.values[key]

    def section(self, key):
        known = ", ".join(str(name) for name in self.values)
        path = ".".join(part for part in (self.path, key) if part)
        return Section(self.file, path, self.get(key, f"there is {known}"))

    def text(self, key):
        value = self.get(key)
        if not isinstance(value, str) or not value or '"' in value:
            raise self.error(key, f"must be a name, not {value!r}")
        return value

    def number(self, key):
        return self._as_number(key, self.get(key))

    def numbers(self, key, size):
        values = self.get(key)
        if not isinstance(values, list) or len(values) != size:
            raise self.error(key, f"must be a list of {size} numbers")
        return [self._as_number(key, value) for value in values]

    def matrix(self, key, size, hint="add it"):
        """Returns a square matrix."""
        rows = self.get(key, hint)
        if not isinstance(rows, list) or len(rows) != size:
            raise self.error(key, f"must have {size} rows")
        if any(not isinstance(row, list) or len(row) != size for row in rows):
            raise self.error(key, f"must have {size} numbers in each row")
        return np.array([[self._as_number(key, value) for value in row] for row in rows])

    def transform(self, key, hint="add it"):
        """Returns a 4x4 rigid transform."""
        matrix = self.matrix(key, 4, hint)
        self._check_rotation(key, matrix[:3, :3], "its upper left 3x3 block is not a rotation")
        if not np.array_equal(matrix[3], [0, 0, 0, 1]):
            raise self.error(key, "its last row must be 0 0 0 1")
        return matrix

    def rotation(self, key):
        """Returns a 3x3 rotation."""
        matrix = self.matrix(key, 3)
        self._check_rotation(key, matrix, "is not a rotation")
        return matrix

    def _check_rotation(self, key, matrix, problem):
        error = np.abs(matrix @ matrix.T - np.eye(3)).max()
        if error > MAX_ROTATION_ERROR or np.linalg.det(matrix) < 0:
            raise self.error(key, problem)

    def _as_number(self, key, value):
        try:  # YAML 1.1 reads 1e-3 as a string
            number = math.nan if isinstance(value, bool) else float(value)
        except (TypeError, ValueError):
            number = math.nan
        if not math.isfinite(number):
            raise self.error(key, f"must be a number, not {value!r}")
        return number


def read_section(file, link=None):
    """Reads the whole file as a Section, or the file beside it that it names under the key `link`,
    as the estimator_config.yaml of OpenVINS does."""
    section = _read(file)
    if link not in section.values:
        return section
    return _read(os.path.join(os.path.dirname(file), section.text(link)))


def _read(file):
    try:
        with open(file, encoding="utf-8") as stream:
            text = stream.read()
        # OpenCV's header, which other programs require in Kalibr's files, is not valid YAML.
        header, _, rest = text.partition("\n")
        return Section(file, "", yaml.safe_load(rest if header.startswith("%YAML:") else text))
    except OSError as error:
        raise KalibrError(f"{file}: {error.strerror}") from error
    except (UnicodeDecodeError, yaml.YAMLError) as error:
        raise KalibrError(f"{file}: is not YAML: {' '.join(str(error).split())}") from error
