# SPDX-License-Identifier: BSD-3-Clause
"""Runs of run_offline: their input, their folders and their outcomes."""

import concurrent.futures
import contextlib
import dataclasses
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import threading
import time
from typing import Dict, Optional

from .sequences import Sequence

RESULTS = ("trajectory.tum", "timing.csv", "summary.json")
OUTCOME = "run.json"
LOG = "run.log"
PERIOD = 0.1  # between checks whether the run is still wanted [s]


@dataclasses.dataclass(frozen=True)
class Settings:
    """Settings that all runs share."""

    program: str  # run_offline
    config: str
    output: str
    duration: Optional[float] = None  # [s]
    overrides: Dict[str, str] = dataclasses.field(default_factory=dict)

    def fingerprint(self):
        """Returns values that change whenever the outcome of a run may change; program and
        configuration are compared by content."""
        return {"program_sha256": _sha256(self.program), "config_sha256": _sha256(self.config),
                "duration": self.duration}


class Run:
    """One repetition of a sequence with a variant of the configuration, from a start [s] on.

    The folder OUTPUT/runs/SEQUENCE/VARIANT/from_STARTs_REPETITION contains the files of
    run_offline, its messages (run.log) and its outcome (run.json). A run in progress writes to a
    folder next to it.
    """

    def __init__(self, settings, fingerprint, sequence: Sequence, variant: str,
                 overrides: Dict[str, str], start: float, repetition: int):
        self.sequence = sequence
        self.variant = variant
        self.start = start
        self.repetition = repetition
        labels = sequence.name, variant, f"from_{start}s_{repetition}"
        self.name = " ".join(labels)
        self.folder = os.path.join(settings.output, "runs", *labels)
        self._settings = settings
        self._overrides = {**settings.overrides, **overrides}
        self._identity = {**fingerprint, "start": start, "recording": _content(sequence),
                          "overrides": self._overrides}

    def is_finished(self):
        """Returns whether an earlier run with the same settings left complete results."""
        outcome = self.outcome()
        return (outcome is not None and outcome["identity"] == self._identity
                and outcome["failure"] is None and _missing_result(self.folder) is None)

    def outcome(self):
        """Returns the contents of run.json, or None."""
        try:
            with open(os.path.join(self.folder, OUTCOME), encoding="utf-8") as file:
                return json.load(file)
        except (FileNotFoundError, json.JSONDecodeError):
            return None

    def carry_out(self, stop):
        """Executes the run; returns its duration [s], with the outcome on disk. Leaves nothing if
        the event `stop` is set before."""
        attempt = self.folder + ".part"
        shutil.rmtree(attempt, ignore_errors=True)
        os.makedirs(attempt)
        started = time.monotonic()
        exit_code = self._run_program(attempt, stop)
        seconds = time.monotonic() - started
        if exit_code is None:
            shutil.rmtree(attempt)
            return seconds
        outcome = {"failure": self._failure(attempt, exit_code), "exit_code": exit_code,
                   "wall_time_s": seconds, "command": self._command(self.folder),
                   "identity": self._identity}
        with open(os.path.join(attempt, OUTCOME), "w", encoding="utf-8") as file:
            json.dump(outcome, file, indent=2)
        shutil.rmtree(self.folder, ignore_errors=True)
        os.rename(attempt, self.folder)
        return seconds

    def _run_program(self, folder, stop):
        """Returns the exit code, or None if the run was stopped."""
        with open(os.path.join(folder, LOG), "wb") as log:
            # A separate process session, so that Ctrl-C reaches it through this program only.
            process = subprocess.Popen(self._command(folder), stdin=subprocess.DEVNULL, stdout=log,
                                       stderr=subprocess.STDOUT, start_new_session=True)
        while not stop.is_set():
            with contextlib.suppress(subprocess.TimeoutExpired):
                return process.wait(PERIOD)
        _stop(process)
        return None

    def _command(self, folder):
        settings, input_option = self._settings, "--bag" if self.sequence.is_bag else "--asl"
        command = [settings.program, "--config", settings.config, input_option, self.sequence.path,
                   "--output", folder]
        if self.start:
            command += ["--start", repr(self.start)]
        if settings.duration is not None:
            command += ["--duration", repr(settings.duration)]
        for key, value in self._overrides.items():
            command += ["--set", f"{key}={value}"]
        return command

    def _failure(self, folder, exit_code):
        """Returns why there is no complete result, or None if there is one."""
        log = os.path.join(self.folder, LOG)  # its final place
        if exit_code < 0:
            return f"ended by {signal.Signals(-exit_code).name}; see {log}"
        if exit_code > 0:
            return (_last_error(os.path.join(folder, LOG))
                    or f"exit code {exit_code}; see {log}")
        missing = _missing_result(folder)
        return missing and f"no {missing} although it exited normally; see {log}"


def run_all(runs, jobs, report):
    """Executes runs, `jobs` at a time; calls report(run, duration [s]) as each ends. An exception,
    such as that of Ctrl-C, stops them all before it goes on."""
    stop = threading.Event()
    with concurrent.futures.ThreadPoolExecutor(jobs) as executor:
        pending = {executor.submit(run.carry_out, stop): run for run in runs}
        try:
            for future in concurrent.futures.as_completed(pending):
                report(pending[future], future.result())
        finally:
            stop.set()
            for future in pending:
                future.cancel()


def _missing_result(folder):
    return next((name for name in RESULTS if not os.path.isfile(os.path.join(folder, name))), None)


def _stop(process, patience=5.0):
    process.terminate()
    try:
        process.wait(patience)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _content(sequence):
    """Returns values that distinguish a recording from others of the same name without reading
    it."""
    statuses = [os.stat(path) for path in sequence.content_files]
    return [{"bytes": s.st_size, "modified_ns": s.st_mtime_ns} for s in statuses]


def _sha256(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def _last_error(log):
    """Returns run_offline's own error message, or None; several lines are joined."""
    with open(log, encoding="utf-8", errors="replace") as file:
        errors = re.findall(r"^run_offline: *(.*)$", file.read(), re.MULTILINE)
    return "; ".join(errors) or None
