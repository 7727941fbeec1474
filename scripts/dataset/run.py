# SPDX-License-Identifier: BSD-3-Clause
"""One run of run_offline: what it is given, its folder, and how it ended."""

import dataclasses
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import time
from typing import Dict, Optional

from .sequences import Sequence

RESULTS = ("trajectory.tum", "timing.csv", "summary.json")
OUTCOME = "run.json"  # written last: a folder without it is of an interrupted run
LOG = "run.log"


@dataclasses.dataclass(frozen=True)
class Settings:
    """What all runs have in common."""

    program: str  # run_offline
    config: str
    output: str
    duration: Optional[float] = None  # [s]
    overrides: Dict[str, str] = dataclasses.field(default_factory=dict)

    def fingerprint(self):
        """Changes whenever a run may end differently; of program and config the content counts."""
        return {"program_sha256": _sha256(self.program), "config_sha256": _sha256(self.config),
                "duration": self.duration}


class Run:
    """A sequence with a variant of the configuration from a start on [s], for the n-th time.

    The folder OUTPUT/runs/SEQUENCE/VARIANT/REPETITION, or .../VARIANT/from_STARTs/REPETITION where
    the run does not start with the recording, has what run_offline writes, its messages (run.log)
    and, once it has ended, run.json.
    """

    def __init__(self, settings, fingerprint, sequence: Sequence, variant: str,
                 overrides: Dict[str, str], start: float, repetition: int):
        self.sequence = sequence
        self.variant = variant
        self.start = start
        self.repetition = repetition
        self._labels = [sequence.name, variant, *([f"from_{start}s"] if start else []),
                        str(repetition)]
        self.folder = os.path.join(settings.output, "runs", *self._labels)
        self._settings = settings
        self._overrides = {**settings.overrides, **overrides}
        self._identity = {**fingerprint, "start": start, "recording": _content(sequence),
                          "overrides": self._overrides}

    @property
    def name(self):
        return " ".join(self._labels)

    def is_finished(self):
        """Whether an earlier run with the same settings left complete results."""
        outcome = self.outcome()
        return (outcome is not None and outcome["identity"] == self._identity
                and outcome["failure"] is None and self._missing_result() is None)

    def outcome(self):
        """What run.json says, or None."""
        try:
            with open(os.path.join(self.folder, OUTCOME), encoding="utf-8") as file:
                return json.load(file)
        except (FileNotFoundError, json.JSONDecodeError):
            return None

    def command(self):
        settings, input_option = self._settings, "--bag" if self.sequence.is_bag else "--asl"
        command = [settings.program, "--config", settings.config, input_option, self.sequence.path,
                   "--output", self.folder]
        if self.start:
            command += ["--start", repr(self.start)]
        if settings.duration is not None:
            command += ["--duration", repr(settings.duration)]
        for key, value in self._overrides.items():
            command += ["--set", f"{key}={value}"]
        return command

    def launch(self):
        """Starts the run in an empty folder; returns the running process."""
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        with open(os.path.join(self.folder, LOG), "wb") as log:
            # In a session of its own: Ctrl-C reaches it through this program only.
            process = subprocess.Popen(self.command(), stdin=subprocess.DEVNULL, stdout=log,
                                       stderr=subprocess.STDOUT, start_new_session=True)
        return RunningRun(self, process)

    def save_outcome(self, exit_code, seconds):
        failure = self._failure(exit_code)
        outcome = {"sequence": self.sequence.name, "variant": self.variant,
                   "start": self.start, "repetition": self.repetition, "failure": failure,
                   "exit_code": exit_code, "wall_time_s": seconds,
                   "load_average": os.getloadavg()[0], "command": self.command(),
                   "identity": self._identity}
        path = os.path.join(self.folder, OUTCOME)
        with open(path + ".part", "w", encoding="utf-8") as file:
            json.dump(outcome, file, indent=2)
        os.replace(path + ".part", path)

    def _failure(self, exit_code):
        """Why there is no complete result, or None where there is one."""
        if exit_code < 0:
            return f"ended by {_signal_name(-exit_code)}; see {self._log()}"
        if exit_code > 0:
            return _last_error(self._log()) or f"exit code {exit_code}; see {self._log()}"
        missing = self._missing_result()
        return missing and f"no {missing} although it ended well; see {self._log()}"

    def _log(self):
        return os.path.join(self.folder, LOG)

    def _missing_result(self):
        return next((name for name in RESULTS
                     if not os.path.isfile(os.path.join(self.folder, name))), None)


class RunningRun:
    """A run whose process has been started."""

    def __init__(self, run, process):
        self.run = run
        self._process = process
        self._started = time.monotonic()

    @property
    def seconds(self):
        return time.monotonic() - self._started

    def has_ended(self):
        """Whether it has; if so, its outcome is on disk."""
        exit_code = self._process.poll()
        if exit_code is None:
            return False
        self.run.save_outcome(exit_code, self.seconds)
        return True

    def stop(self, patience=5.0):
        """Ends the process and leaves no outcome, so that the run is repeated."""
        self._process.terminate()
        try:
            self._process.wait(patience)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


def _content(sequence):
    """What distinguishes a recording from one of the same name, without reading all of it."""
    status = os.stat(sequence.content_file)
    return {"bytes": status.st_size, "modified_ns": status.st_mtime_ns}


def _sha256(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def _signal_name(number):
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _last_error(log):
    """run_offline's own message of its end, or None; several lines become one."""
    with open(log, encoding="utf-8", errors="replace") as file:
        errors = re.findall(r"^run_offline: *(.*)$", file.read(), re.MULTILINE)
    return "; ".join(errors) or None
