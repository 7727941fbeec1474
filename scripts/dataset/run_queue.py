# SPDX-License-Identifier: BSD-3-Clause
"""Carries out runs, several at a time."""

import signal
import time

PERIOD = 0.1  # between two looks at the processes [s]


def carry_out(runs, jobs, progress):
    """Carries out all runs, at most `jobs` at once, and reports each to `progress`.

    Returns False where SIGINT or SIGTERM ended it early. However it ends, no process stays behind,
    and runs that had not ended are left without an outcome.
    """
    waiting, running = list(reversed(runs)), []
    with _Interruption() as interruption:
        try:
            while (waiting or running) and not interruption.requested:
                while waiting and len(running) < jobs:
                    running.append(waiting.pop().launch())
                progress.show([r.run.name for r in running])
                time.sleep(PERIOD)
                for ended in [r for r in running if r.has_ended()]:
                    running.remove(ended)
                    progress.ended(ended.run, ended.seconds)
        finally:
            for unfinished in running:
                unfinished.stop()
            progress.clear()
    return not (waiting or running)


class _Interruption:
    """Notes SIGINT and SIGTERM instead of ending the program between any two statements."""

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
