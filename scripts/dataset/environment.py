# SPDX-License-Identifier: BSD-3-Clause
"""Locations of the program and the configuration, and a description of the machine."""

import os
import platform
import shutil
import subprocess
import tempfile

from .errors import DatasetError

_SCRIPTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
_ROOT = os.path.dirname(_SCRIPTS)  # of the checkout; if installed: the folder lib
_PROGRAM = os.path.join("lib", "plm_vins", "run_offline")


def find_program(given=None):
    """Returns the path of run_offline: the given one, that of this checkout, the one installed next
    to this script, of the sourced workspaces (as rosrun finds it), or on PATH. Raises
    DatasetError."""
    workspaces = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    candidates = [given] if given else [
        os.path.join(_ROOT, "build", "devel", _PROGRAM), os.path.join(_SCRIPTS, "run_offline"),
        *(os.path.join(workspace, _PROGRAM) for workspace in workspaces if workspace),
        shutil.which("run_offline") or ""]
    for path in candidates:
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return os.path.abspath(path)
    if given:
        raise DatasetError(f"--run-offline {given}: no such program")
    raise DatasetError("run_offline is not built; run scripts/build.sh, source the workspace's"
                       " setup.bash, or name it with --run-offline")


def find_config(given=None):
    """Returns the path of the configuration: the given one or config/euroc.yaml. Raises
    DatasetError."""
    default = os.path.join("config", "euroc.yaml")
    candidates = [given] if given else [
        os.path.join(_ROOT, default),
        os.path.join(os.path.dirname(_ROOT), "share", "plm_vins", default)]
    for path in candidates:
        if os.path.isfile(path):
            return os.path.abspath(path)
    raise DatasetError(f"--config {candidates[0]}: no such file")


def check_config(program, config, overrides):
    """Raises DatasetError with all problems that run_offline finds in the configuration. It passes
    an empty folder as recording, which run_offline reads last."""
    with tempfile.TemporaryDirectory() as empty:
        command = [program, "--config", config, "--asl", empty, "--output",
                   os.path.join(empty, "output")]
        for key, value in overrides.items():
            command += ["--set", f"{key}={value}"]
        run = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, encoding="utf-8", errors="replace",
                             check=False)
    problems = [line[len("run_offline: "):] for line in run.stderr.splitlines()
                if line.startswith((f"run_offline: {config}:", "run_offline: --set "))]
    if problems:
        raise DatasetError("\n".join(problems))


def usable_cores():
    return len(os.sched_getaffinity(0))


def machine():
    """Returns processor and number of cores in one line."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            models = [line.split(":", 1)[1].strip() for line in file if line[:10] == "model name"]
    except OSError:
        models = []
    return f"{models[0] if models else platform.machine()}, {usable_cores()} cores"
