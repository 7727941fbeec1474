# SPDX-License-Identifier: BSD-3-Clause
"""Executes runs, several at a time."""

import concurrent.futures
import os
import signal
import uuid

from .errors import DatasetError

PERIOD = 0.1  # between checks of signals and display updates [s]
PATIENCE = 10.0  # to wait for runs that are being stopped [s]


def carry_out(runs, executor, output, progress):
    """Executes all runs in the executor's threads, on any machine, and reports each to `progress`.

    Returns False if SIGINT or SIGTERM ended it early. In any case no process is left running, and
    unfinished runs have no outcome. Raises DatasetError if the executor fails.
    """
    with _Interruption() as interruption, _Session(output) as session:
        pending = {executor.submit(run.carry_out, session.path): run for run in runs}
        try:
            while pending and not interruption.requested:
                progress.show([run.name for future, run in pending.items() if future.running()])
                done, _ = concurrent.futures.wait(pending, PERIOD,
                                                  concurrent.futures.FIRST_COMPLETED)
                for future in done:
                    run = pending.pop(future)
                    progress.ended(run, _seconds(future, run, output))
        finally:
            session.end()
            for future in pending:
                future.cancel()
            concurrent.futures.wait(pending, PATIENCE)
            progress.close()
    return not pending


def _seconds(future, run, output):
    """Returns the duration of the run; saves an outcome for a run that could not be executed."""
    try:
        seconds = future.result()
    except concurrent.futures.CancelledError:
        raise DatasetError("the connection to the scheduler is lost; run the same command again to"
                           " continue") from None
    except ModuleNotFoundError as error:
        raise DatasetError(f"a worker lacks {error.name}; start the workers with this checkout's"
                           " scripts/ in PYTHONPATH") from None
    except Exception as error:  # any error of the executor or the other machine
        run.save_failure(f"not run: {type(error).__name__}: {error}")
        return 0.0
    if seconds is None:
        raise DatasetError(f"{output}: a worker does not see this folder; all machines need it,"
                           " recordings, configuration and program under the same paths")
    return seconds


class _Session:
    """A file in the output folder that exists as long as the runs are wanted: workers, on this
    machine or another, stop when it disappears."""

    def __init__(self, output):
        self.path = os.path.join(output, f".session-{uuid.uuid4().hex}")

    def __enter__(self):
        with open(self.path, "w", encoding="utf-8"):
            return self

    def end(self):
        if os.path.exists(self.path):
            os.remove(self.path)

    def __exit__(self, *_):
        self.end()


class _Interruption:
    """Records SIGINT and SIGTERM instead of ending the program at an arbitrary statement."""

    SIGNALS = (signal.SIGINT, signal.SIGTERM)

    def __enter__(self):
        self.requested = False
        self._handlers = [signal.signal(number, self._note) for number in self.SIGNALS]
        return self

    def __exit__(self, *_):
        for number, handler in zip(self.SIGNALS, self._handlers):
            signal.signal(number, handler)

    def _note(self, *_):
        self.requested = True
