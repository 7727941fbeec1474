# SPDX-License-Identifier: BSD-3-Clause
"""Simulates flights with a second camera, or with depth images."""

import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def write_config(folder, sensor):
    """Writes a configuration for "stereo" or "depth" to FOLDER/SENSOR.yaml; returns its path."""
    config = pathlib.Path(folder) / f"{sensor}.yaml"
    name = "euroc_stereo.yaml" if sensor == "stereo" else "euroc.yaml"
    text = (ROOT / "config" / name).read_text(encoding="utf-8")
    if sensor == "depth":
        text += '\ndepth_topic: "/depth/image_raw"\n'
    config.write_text(text, encoding="utf-8")
    return config


def simulate(program, config, sensor, seconds, *outputs):
    """Runs the program `simulate`; OUTPUTS are its options for them."""
    sensors = ["--rig", config] if sensor == "stereo" else ["--config", config, "--depth"]
    command = [program, *sensors, "--exposure", 0, "--duration", seconds, *outputs]
    subprocess.run([str(word) for word in command], stderr=subprocess.DEVNULL, check=True)
