# SPDX-License-Identifier: BSD-3-Clause
"""Folders in ASL format (EuRoC)."""

import csv
import os

import numpy as np

from .measurements import Measurements

IMU, IMAGES = os.path.join("imu0", "data.csv"), os.path.join("cam0", "data.csv")


def make_faulty(source, target, apply, begin):
    """Makes `target`, a new folder, which links to the images and all other files of the source."""
    if os.path.lexists(target) and not (os.path.isdir(target) and not os.listdir(target)):
        raise ValueError(f"{target}: already exists; remove it or give another target")
    nested = os.path.join(source, "mav0")
    source = nested if os.path.isdir(nested) else source
    (imu_head, imu), (image_head, images) = (_read(os.path.join(source, name))
                                             for name in (IMU, IMAGES))
    if not imu or not images:
        raise ValueError(f"{source}: no IMU sample or no image in it")
    values = np.array([row[1:7] for row in imu], dtype=float)
    measurements = Measurements(np.array([int(row[0]) for row in imu]), values[:, :3].copy(),
                                values[:, 3:].copy(), np.array([int(row[0]) for row in images]))
    apply(measurements, begin)
    _link_the_rest(source, target)
    _write(os.path.join(target, IMU), imu_head,
           [[measurements.imu_ns[i], *measurements.gyro[i], *measurements.accel[i]]
            for i in np.flatnonzero(measurements.imu_kept)])
    _write(os.path.join(target, IMAGES), image_head,
           [[t_ns, *images[shown][1:]]
            for t_ns, shown in zip(measurements.image_ns, measurements.shown)])


def _read(path):
    with open(path, encoding="utf-8-sig", newline="") as file:
        rows = [[word.strip() for word in row] for row in csv.reader(file)]
        rows = [row for row in rows if row and row[0]]
    return [row for row in rows if row[0][0] == "#"], [row for row in rows if row[0][0] != "#"]


def _write(path, head, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(head + rows)


def _link_the_rest(source, target):
    """Links the other files of the sensors and those next to them, such as EuRoC's body.yaml."""
    for name in os.listdir(source):
        if os.path.isdir(os.path.join(source, name)):
            for inner in os.listdir(os.path.join(source, name)):
                _link(source, target, os.path.join(name, inner))
        else:
            _link(source, target, name)


def _link(source, target, name):
    link = os.path.join(target, name)
    os.makedirs(os.path.dirname(link), exist_ok=True)
    if name not in (IMU, IMAGES):
        os.symlink(os.path.realpath(os.path.join(source, name)), link)
