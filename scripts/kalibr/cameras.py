# SPDX-License-Identifier: BSD-3-Clause
"""Converts the intrinsics of a Kalibr camera to lines of a configuration."""

DISTORTION_SIZES = {"radtan": 4, "plumb_bob": 4, "equidistant": 4, "none": 0}
MODEL_TYPES = {("pinhole", "radtan"): "PINHOLE", ("pinhole", "plumb_bob"): "PINHOLE",
               ("pinhole", "none"): "PINHOLE", ("pinhole", "equidistant"): "EQUIDISTANT",
               ("omni", "radtan"): "MEI", ("omni", "plumb_bob"): "MEI", ("omni", "none"): "MEI"}
# Names of the projection and the distortion parameters.
NAMES = {"PINHOLE": ("fx fy cx cy", "k1 k2 p1 p2"), "EQUIDISTANT": ("fx fy cx cy", "k1 k2 k3 k4"),
         "MEI": ("gamma1 gamma2 u0 v0", "k1 k2 p1 p2")}


def camera_lines(camera):
    """Returns the intrinsics as lines. `camera` is a section of the camera chain."""
    _refuse_rolling_shutter(camera)
    kind = camera.text("camera_model"), camera.text("distortion_model")
    size = camera.numbers("resolution", 2)
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
