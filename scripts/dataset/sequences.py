# SPDX-License-Identifier: BSD-3-Clause
"""Finds recordings and their ground truth in folders as they are downloaded."""

import fnmatch
import os
from dataclasses import dataclass
from typing import Optional

from evaluation.trajectory import TRUTHS_IN_FOLDER

from .errors import DatasetError

ASL_TRUTHS = tuple(os.path.join("mav0", name) for name in TRUTHS_IN_FOLDER)
ASL_IMAGES = os.path.join("mav0", "cam0", "data.csv")
ASL_IMU = os.path.join("mav0", "imu0", "data.csv")


@dataclass(frozen=True)
class Sequence:
    """A recording: a ROS bag, or an ASL folder (the one that contains mav0/)."""

    name: str
    path: str
    truth: Optional[str]  # TUM file or EuRoC csv

    @property
    def is_bag(self):
        return self.path.endswith(".bag")

    @property
    def content_files(self):
        """The files whose change means that the recording has changed."""
        if self.is_bag:
            return [self.path]
        images, imu = (os.path.join(self.path, name) for name in (ASL_IMAGES, ASL_IMU))
        return [images, imu] if os.path.isfile(imu) else [images]  # run_offline reports it


def find_sequences(places):
    """Returns all sequences below `places` (folders, or single bags), sorted by name.

    An ASL folder takes precedence over a bag of the same name. Raises DatasetError if there are
    none, or if two recordings have the same name.
    """
    found = {}
    for path in (path for place in places for path in _recordings_at(place)):
        name = _name(path)
        known = found.get(name)
        if known is not None and _is_bag(known) == _is_bag(path):
            raise DatasetError(f"two recordings are called {name}: {known} and {path};"
                               " rename one or give one folder at a time")
        if known is None or _is_bag(known):
            found[name] = path
    if not found:
        raise DatasetError(_nothing_found(places))
    return [Sequence(name, path, find_truth(path)) for name, path in sorted(found.items())]


def find_truth(path):
    """Returns the ground truth of a recording, or None: inside its ASL folder, or next to the
    recording with the same name."""
    path = _folder_of_mav0(os.path.normpath(path))
    stem = path[:-len(".bag")] if _is_bag(path) else path
    candidates = [*(os.path.join(stem, name) for name in ASL_TRUTHS), stem + ".tum", stem + ".csv"]
    if _is_bag(path):
        candidates += [os.path.join(os.path.dirname(path), name) for name in ASL_TRUTHS]
    return next((file for file in candidates if os.path.isfile(file)), None)


def select_sequences(sequences, patterns):
    """Returns the sequences whose name matches one of `patterns`: a name, its beginning, or with
    wildcards.

    Raises DatasetError for a pattern without a match.
    """
    chosen = set()
    for pattern in patterns:
        matches = [s for s in sequences if fnmatch.fnmatchcase(s.name, pattern + "*")]
        exact = [s for s in matches if s.name == pattern]
        if not matches:
            raise DatasetError(f"--sequences {pattern}: no such sequence; there are "
                               + ", ".join(s.name for s in sequences))
        chosen.update(exact or matches)
    return [s for s in sequences if s in chosen]


def _recordings_at(place):
    place = os.path.abspath(place)
    if os.path.isfile(place) and _is_bag(place):
        return [place]
    if not os.path.isdir(place):
        raise DatasetError(f"{place}: no such folder or bag")
    return list(_recordings_below(_folder_of_mav0(place)))


def _folder_of_mav0(path):
    """Returns the ASL folder if the path is its mav0/, else the path itself."""
    return os.path.dirname(path) if os.path.basename(path) == "mav0" else path


def _recordings_below(folder):
    visited = set()
    for parent, folders, files in os.walk(folder, followlinks=True):
        real = os.path.realpath(parent)
        if real in visited:
            folders.clear()
            continue
        visited.add(real)
        folders.sort()
        if os.path.isfile(os.path.join(parent, ASL_IMAGES)):
            folders.remove("mav0")
            yield parent
        yield from (os.path.join(parent, name) for name in sorted(files) if _is_bag(name))


def _nothing_found(places):
    message = f"{', '.join(places)}: no *.bag and no ASL folder (mav0/cam0/data.csv)"
    archives = [os.path.join(parent, name) for place in places
                for parent, _, names in os.walk(place) for name in names if name.endswith(".zip")]
    return message + (f"; extract {archives[0]} first" if archives else "")


def _is_bag(path):
    return path.endswith(".bag")


def _name(path):
    name = os.path.basename(path)
    return name[:-len(".bag")] if _is_bag(path) else name
