# SPDX-License-Identifier: BSD-3-Clause
"""Displays the progress of the runs: a bar on a terminal, a line per run in a log."""

import sys

import tqdm


class Progress:
    """Writes to `stream`. `describe(run)` returns the text about a finished run."""

    def __init__(self, total, describe, stream=None):
        self._stream = stream or sys.stderr
        self._describe = describe
        self._total = total
        self._ended = 0
        self._bar = tqdm.tqdm(total=total, unit="run", file=self._stream, dynamic_ncols=True,
                              disable=not self._stream.isatty(), leave=False)

    def show(self, running):
        """Refreshes the bar; `running` are the names of the current runs, as far as known."""
        self._bar.set_postfix_str(", ".join(running))

    def ended(self, run, seconds):
        self._ended += 1
        width = len(str(self._total))
        tqdm.tqdm.write(f"[{self._ended:>{width}}/{self._total}] {run.name}:"
                        f" {self._describe(run)} ({seconds:.0f} s)", file=self._stream)
        self._stream.flush()
        self._bar.update()

    def close(self):
        """Removes the bar."""
        self._bar.close()
