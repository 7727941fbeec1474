# SPDX-License-Identifier: BSD-3-Clause
"""Converts the intrinsics of a Kalibr camera to lines of a configuration."""

import math

import numpy as np

from . import radial_models

MAX_RESIDUAL = 0.05  # of an equidistant model that replaces another one [px]
DISTORTION_SIZES = {"radtan": 4, "plumb_bob": 4, "equidistant": 4, "none": 0}
MODEL_TYPES = {("pinhole", "radtan"): "PINHOLE", ("pinhole", "plumb_bob"): "PINHOLE",
               ("pinhole", "none"): "PINHOLE", ("pinhole", "equidistant"): "EQUIDISTANT",
               ("omni", "radtan"): "MEI", ("omni", "plumb_bob"): "MEI", ("omni", "none"): "MEI"}
# Names of the projection and the distortion parameters.
NAMES = {"PINHOLE": ("fx fy cx cy", "k1 k2 p1 p2"), "EQUIDISTANT": ("fx fy cx cy", "k1 k2 k3 k4"),
         "MEI": ("gamma1 gamma2 u0 v0", "k1 k2 p1 p2")}
# Models that are replaced: their parameters in Kalibr's order, each with minimum and maximum, and
# the key of the list that contains them ("intrinsics" ends with the focal lengths and the principal
# point).
RADIAL_MODELS = {
    ("ds", "none"): (radial_models.ds, {"xi": (-1, math.inf), "alpha": (0, 1)}, "intrinsics"),
    ("eucm", "none"): (radial_models.eucm, {"alpha": (0, 1), "beta": (1e-6, math.inf)},
                       "intrinsics"),
    ("pinhole", "fov"): (radial_models.fov, {"w": (1e-6, 3.14)}, "distortion_coeffs"),
}


def camera_lines(camera):
    """Returns the intrinsics as lines. `camera` is a section of the camera chain."""
    _refuse_rolling_shutter(camera)
    kind = camera.text("camera_model"), camera.text("distortion_model")
    size = camera.numbers("resolution", 2)
    if kind in RADIAL_MODELS:
        return _equidistant_lines(camera, kind, size)
    if kind not in MODEL_TYPES:
        raise camera.error("camera_model", f"{'-'.join(kind)} is not supported; calibrate with"
                           " pinhole-radtan, pinhole-equi or omni-radtan")
    model, distortion = kind
    intrinsics = camera.numbers("intrinsics", 5 if model == "omni" else 4)
    coefficients = _distortion(camera, DISTORTION_SIZES[distortion])
    mirror = ["mirror_parameters:", f"   xi: {intrinsics[0]!r}  # [1]"] if model == "omni" else []
    return _lines(MODEL_TYPES[kind], size, mirror, intrinsics[-4:], coefficients)


def _distortion(camera, size):
    """Returns four coefficients. ROS writes five for plumb_bob, of which the last, k3, may be 0."""
    values = camera.get("distortion_coeffs")
    if size == 4 and isinstance(values, list) and len(values) == 5:
        *first, k3 = camera.numbers("distortion_coeffs", 5)
        if k3 != 0:
            raise camera.error("distortion_coeffs", f"the fifth, k3 = {k3!r}, is not supported;"
                               " calibrate with four, or with pinhole-equi")
        return first
    return camera.numbers("distortion_coeffs", size) or [0.0] * 4


def _refuse_rolling_shutter(camera):
    for key, value in camera.values.items():
        if "line_delay" in str(key) and value != 0:
            raise camera.error(key, "a rolling-shutter camera: remove this line, then set"
                               " rolling_shutter and rolling_shutter_tr in the configuration")


def _lines(model_type, size, mirror, projection, coefficients):
    width, height = size
    projection_names, distortion_names = NAMES[model_type]
    return [f"model_type: {model_type}",
            f"image_width: {width:g}   # [px]", f"image_height: {height:g}  # [px]", *mirror,
            "projection_parameters:  # [px]",
            *_named(projection_names, projection), "distortion_parameters:  # [1]",
            *_named(distortion_names, coefficients)]


def _named(names, values):
    return [f"   {name}: {value!r}" for name, value in zip(names.split(), values)]


def _equidistant_lines(camera, kind, size):
    """Returns the equidistant camera that best fits one of RADIAL_MODELS, with its largest
    residual."""
    lens, projection = _radial_lens(camera, kind)
    focal, center = np.array(projection[:2]), np.array(projection[2:])
    farthest = np.maximum(center, np.array(size) - 1 - center)
    fit = radial_models.fit_equidistant(lens, np.linalg.norm(farthest / focal))
    residual = math.inf if fit is None else fit.residual * focal.max()
    name = kind[0] if kind[1] == "none" else "-".join(kind)
    if residual > MAX_RESIDUAL:
        raise camera.error("camera_model", f"the equidistant model nearest to this {name} camera is"
                           f" off by up to {residual:.2g} px, of which {MAX_RESIDUAL:g} are"
                           " allowed; calibrate with pinhole-equi or omni-radtan")
    note = (f"# Equidistant model that replaces {name}: errors of at most {residual:.2g} px up to"
            f" {math.degrees(fit.angle):.1f} deg from the axis.")
    return [note, *_lines("EQUIDISTANT", size, [], [*(fit.scale * focal).tolist(), *projection[2:]],
                          fit.coefficients)]


def _radial_lens(camera, kind):
    """Returns the lens as a function of the angle, and fx, fy, cx, cy of the camera [px]."""
    function, limits, key = RADIAL_MODELS[kind]
    own_list = key != "intrinsics"
    intrinsics = camera.numbers("intrinsics", 4 if own_list else 4 + len(limits))
    values = camera.numbers(key, len(limits)) if own_list else intrinsics[:-4]
    for value, (name, (least, greatest)) in zip(values, limits.items()):
        if not least <= value <= greatest:
            raise camera.error(key, f"{name} must be from {least:g} to {greatest:g}, not {value!r}")
    if min(intrinsics[-4:-2]) <= 0:
        raise camera.error("intrinsics", "focal lengths must be positive")
    return lambda theta: function(theta, *values), intrinsics[-4:]
