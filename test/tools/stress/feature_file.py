# SPDX-License-Identifier: BSD-3-Clause
"""The files of run_offline --save-features (offline/pipeline/feature_file.cpp defines their
layout)."""

import struct

import numpy as np

from .measurements import Measurements

SIGNATURE = b"plm_features v3\n"  # followed by the trackers' values, as text
IMU, POINTS, POINTS_AND_LINES = 1, 2, 3
IMU_LAYOUT = struct.Struct("<q6d")
TRACKING = struct.Struct("<q2?d")  # timestamp, restart, publish, milliseconds
POINT_STATISTICS_SIZE = 6 * 4
LINE_STATISTICS_SIZE = 5 * 4 + 1 + 3 * 4 + 8
SIZE = struct.Struct("<I")
POINT = np.dtype([("id", "<i8"), ("camera", "<i4"), ("xy", "<f8", 2), ("uv", "<f8", 2),
                  ("velocity", "<f8", 2), ("has_depth", "?")])  # none has a depth
LINE_SIZE = 8 + 4 + 6 * 8


class Features:
    """A feature file in memory, item by item as stored on disk."""

    def __init__(self, path):
        self._path = path
        with open(path, "rb") as file:
            self._bytes = file.read()
        if not self._bytes.startswith(SIGNATURE):
            raise self._error("is not a feature file of this version")
        self._begin = self._end_of_list(len(SIGNATURE), 1)  # of the first item
        self._imu, self._images = [], []  # offsets in the file
        self._items = []  # (kind, index, begin)
        self._split()
        if not self._imu or not self._images:
            raise ValueError(f"{path}: no IMU sample or no image in it")

    def measurements(self):
        samples = np.array([IMU_LAYOUT.unpack_from(self._bytes, at) for at in self._imu],
                           dtype=object)
        stamps = [TRACKING.unpack_from(self._bytes, at)[0] for at in self._images]
        values = samples[:, 1:].astype(float)
        return Measurements(samples[:, 0].astype(np.int64), values[:, :3].copy(),
                            values[:, 3:].copy(), np.array(stamps, dtype=np.int64))

    def write(self, path, measurements):
        was_ns = self.measurements().image_ns
        with open(path, "wb") as file:
            file.write(self._bytes[:self._begin])
            for kind, index, begin in self._items:
                if kind == IMU:
                    file.write(_imu_item(measurements, index))
                else:
                    file.write(self._image_item(measurements, was_ns, index, begin))

    def _split(self):
        at = self._begin
        while at < len(self._bytes):
            kind, begin = self._bytes[at], at
            if kind not in (IMU, POINTS, POINTS_AND_LINES):
                raise self._error("is damaged")
            places = self._imu if kind == IMU else self._images
            places.append(at + 1)
            at = at + 1 + IMU_LAYOUT.size if kind == IMU else self._end_of_image(at)
            self._items.append((kind, len(places) - 1, begin))
        if at > len(self._bytes):
            raise self._error("is truncated")

    def _end_of_points(self, begin):
        return self._end_of_list(_points_size_at(begin), POINT.itemsize)

    def _lines_size_at(self, begin):
        return self._end_of_points(begin) + TRACKING.size + LINE_STATISTICS_SIZE

    def _end_of_image(self, begin):
        if self._bytes[begin] == POINTS:
            return self._end_of_points(begin)
        return self._end_of_list(self._lines_size_at(begin), LINE_SIZE)

    def _end_of_list(self, size_at, item_size):
        items_at = size_at + SIZE.size
        if items_at > len(self._bytes):
            raise self._error("is truncated")
        return items_at + SIZE.unpack_from(self._bytes, size_at)[0] * item_size

    def _error(self, what):
        return ValueError(f"{self._path}: {what}; record it again with --save-features")

    def _image_item(self, measurements, was_ns, index, begin):
        t_ns, shown = int(measurements.image_ns[index]), measurements.shown[index]
        points = self._points_of(shown)
        points["velocity"] *= (_stretch(was_ns, measurements.image_ns, index)
                               if shown == index else 0)
        if not measurements.points_kept[index]:
            points = points[:0]
        item = bytearray(self._bytes[begin:_points_size_at(begin)])
        struct.pack_into("<q", item, 1, t_ns)
        item += SIZE.pack(len(points)) + points.tobytes()
        if self._bytes[begin] == POINTS:
            return bytes(item)
        lines = self._lines_of(shown) if measurements.lines_kept[index] else b""
        head = bytearray(self._bytes[self._end_of_points(begin):self._lines_size_at(begin)])
        struct.pack_into("<q", head, 0, t_ns)
        return bytes(item + head + SIZE.pack(len(lines) // LINE_SIZE) + lines)

    def _points_of(self, image):
        begin = self._images[image] - 1
        items_at = _points_size_at(begin) + SIZE.size
        return np.frombuffer(self._bytes[items_at:self._end_of_points(begin)], dtype=POINT).copy()

    def _lines_of(self, image):
        begin = self._images[image] - 1
        if self._bytes[begin] == POINTS:
            return b""
        return self._bytes[self._lines_size_at(begin) + SIZE.size:self._end_of_image(begin)]


def _points_size_at(begin):
    """Returns the offset of the number of points of the image that begins there."""
    return begin + 1 + TRACKING.size + POINT_STATISTICS_SIZE


def _imu_item(measurements, index):
    if not measurements.imu_kept[index]:
        return b""
    return bytes([IMU]) + IMU_LAYOUT.pack(int(measurements.imu_ns[index]),
                                          *measurements.gyro[index], *measurements.accel[index])


def _stretch(was_ns, is_ns, index):
    """Returns the factor of velocities, which are differences over the interval of the
    timestamps."""
    if index == 0:
        return 1.0
    return (was_ns[index] - was_ns[index - 1]) / (is_ns[index] - is_ns[index - 1])


def make_faulty(source, target, apply, begin):
    features = Features(source)
    measurements = features.measurements()
    apply(measurements, begin)
    features.write(target, measurements)
