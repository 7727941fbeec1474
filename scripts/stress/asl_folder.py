# SPDX-License-Identifier: BSD-3-Clause
"""Folders in ASL format (EuRoC)."""

import csv
import os

import numpy as np

from .measurements import Measurements

IMU, IMAGES = os.path.join("imu0", "data.csv"), os.path.join("cam0", "data.csv")


def make_faulty(source, target, apply, begin):
    """The images and all else stay where they are: `target` links to them."""
    nested = os.path.join(source, "mav0")
    source = nested if os.path.isdir(nested) else source
    (imu_head, imu), (image_head, images) = (_read(os.path.join(source, name))
                                             for name in (IMU, IMAGES))
    values = np.array([row[1:7] for row in imu], dtype=float)
    measurements = Measurements(np.array([int(row[0]) for row in imu]), values[:, :3].copy(),
                                values[:, 3:].copy(), np.array([int(row[0]) for row in images]))
    apply(measurements, begin)
    _link_the_rest(source, target)
    _write(os.path.join(target, IMU), imu_head,
           [[measurements.imu_ns[i], *measurements.gyro[i], *measurements.accel[i]]
            for i in np.flatnonzero(measurements.imu_kept)])
    _write(os.path.join(target, IMAGES), image_head,
           [[t_ns, *row[1:]] for t_ns, row in zip(measurements.image_ns, images)])


def _read(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = [[word.strip() for word in row] for row in csv.reader(file) if row]
    return [row for row in rows if row[0][0] == "#"], [row for row in rows if row[0][0] != "#"]


def _write(path, head, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(head + rows)


def _link_the_rest(source, target):
    for sensor in os.listdir(source):
        os.makedirs(os.path.join(target, sensor), exist_ok=True)
        for name in os.listdir(os.path.join(source, sensor)):
            link = os.path.join(target, sensor, name)
            if os.path.join(sensor, name) not in (IMU, IMAGES) and not os.path.lexists(link):
                os.symlink(os.path.realpath(os.path.join(source, sensor, name)), link)
