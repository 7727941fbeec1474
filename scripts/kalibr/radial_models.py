# SPDX-License-Identifier: BSD-3-Clause
"""Lens models that the estimator does not support, and the equidistant model that replaces them.

They are symmetric about the optical axis: a ray at angle theta to the axis projects to the radius
r(theta) in the image plane, in focal lengths. Formulas: [Usenko2018] for `ds` and `eucm` (the
latter by [Khomutenko2016]), [Devernay2001] for `fov`.
"""

from dataclasses import dataclass

import numpy as np

MAX_ANGLE = np.radians(89.9)  # the estimator rejects rays at 90 degrees and beyond
_ANGLES = np.linspace(0, MAX_ANGLE, 4001)
_NODES = 200
_POWERS = (1, 3, 5, 7, 9)  # of theta in the equidistant model


def ds(theta, xi, alpha):
    """Returns the radius of a double-sphere camera; NaN outside its field of view."""
    shifted = xi + np.cos(theta)
    return _seen(np.sin(theta), alpha * np.hypot(np.sin(theta), shifted) + (1 - alpha) * shifted)


def eucm(theta, alpha, beta):
    """Returns the radius of an extended unified camera; NaN outside its field of view."""
    distance = np.sqrt(beta * np.sin(theta) ** 2 + np.cos(theta) ** 2)
    return _seen(np.sin(theta), alpha * distance + (1 - alpha) * np.cos(theta))


def fov(theta, w):
    """Returns the radius of a pinhole camera with the distortion of the field-of-view model."""
    return np.arctan(2 * np.tan(theta) * np.tan(w / 2)) / w


def _seen(numerator, denominator):
    return numerator / np.where(denominator > 0, denominator, np.nan)


@dataclass(frozen=True)
class EquidistantFit:
    """An equidistant model: r = scale * (theta + k1 theta^3 + ... + k4 theta^9)."""

    scale: float
    coefficients: list  # k1 to k4
    angle: float  # up to which it was fitted [rad]
    residual: float  # maximum, in focal lengths of the lens


def fit_equidistant(lens, largest_radius):
    """Fits the equidistant model to a lens, a function as above, for all rays in front of the
    camera up to a radius. Returns None if the lens sees nothing but its axis.

    Nodes that are dense toward both ends make the least squares fit nearly a minimax fit.
    """
    radii = lens(_ANGLES)
    grows = np.append(True, np.diff(radii) > 0)  # False from NaN on
    usable = np.logical_and.accumulate(grows) & (radii <= largest_radius)
    angles = _ANGLES[usable]
    if len(angles) < 2:
        return None
    nodes = angles[-1] * np.cos(np.pi * (np.arange(_NODES) + 0.5) / (2 * _NODES))
    unit = float(angles[-1]) ** np.array(_POWERS)
    factors = np.linalg.lstsq(_powers(nodes) / unit, lens(nodes), rcond=None)[0] / unit
    residual = float(np.abs(_powers(angles) @ factors - radii[usable]).max())
    return EquidistantFit(float(factors[0]), (factors[1:] / factors[0]).tolist(),
                          float(angles[-1]), residual)


def _powers(theta):
    return np.asarray(theta)[:, None] ** np.array(_POWERS)
