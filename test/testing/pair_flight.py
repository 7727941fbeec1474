# SPDX-License-Identifier: BSD-3-Clause
"""Simulates flights with a pair of cameras ("stereo"), with these, a camera that looks back and
depth images ("rig"), or with one camera, with depth images ("depth") or without ("mono").

Rendering takes most of the time of such a test, so images have half the size of EuRoC's, and come
ten times per second."""

import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


# Camera 0 of euroc_stereo.yaml with its place, turned by 180 degrees about the body's x axis.
LOOKING_BACK = """
image2_topic: "/cam2/image_raw"
body_T_cam2: !!opencv-matrix
   rows: 4
   cols: 4
   dt: d
   data: [0.0148831696, -0.9998890702, 0.0005818991, -0.016775,
          -0.9996706800, -0.0148920812, -0.0208987430, 0.068939,
          0.0209050904, -0.0002706679, -0.9997814281, -0.005139,
          0.0, 0.0, 0.0, 1.0]
"""


def add_camera_that_looks_back(text):
    """Returns the configuration of a pair with a third camera, whose lens is that of camera 1."""
    calibration = re.findall(r"^cam1_.*\n(?:   .*\n)*", text, re.MULTILINE)
    return (text.replace("num_of_cam: 2", "num_of_cam: 3") + LOOKING_BACK
            + "".join(calibration).replace("cam1_", "cam2_"))


def halve_images(text):
    """Returns the configuration for images of half the size."""
    halved = re.sub(r"\b(f[xy]|c[xy]|(?:cam1_)?image_(?:width|height)): ([\d.]+)",
                    lambda found: f"{found[1]}: {float(found[2]) / 2:g}", text)
    return re.sub(r"^min_dist:.*\n", "", halved, flags=re.MULTILINE) + "\nmin_dist: 15\n"


def write_config(folder, sensor):
    """Writes a configuration to FOLDER/SENSOR.yaml; returns its path."""
    config = pathlib.Path(folder) / f"{sensor}.yaml"
    name = "euroc.yaml" if sensor in ("depth", "mono") else "euroc_stereo.yaml"
    text = halve_images((ROOT / "config" / name).read_text(encoding="utf-8"))
    if sensor == "rig":
        text = add_camera_that_looks_back(text)
    if sensor in ("depth", "rig"):
        text += '\ndepth_topic: "/depth/image_raw"\n'
    config.write_text(text, encoding="utf-8")
    return config


def simulate(program, config, sensor, seconds, *outputs):
    """Runs the program `simulate`; OUTPUTS are its options for them."""
    sensors = ["--config" if sensor == "depth" else "--rig", config]
    if sensor != "stereo":
        sensors.append("--depth")
    command = [program, *sensors, "--frame-rate", 10, "--exposure", 0, "--duration", seconds,
               *outputs]
    subprocess.run([str(word) for word in command], stderr=subprocess.DEVNULL, check=True)
