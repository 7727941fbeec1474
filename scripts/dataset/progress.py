# SPDX-License-Identifier: BSD-3-Clause
"""Shows how far the runs are: a bar on a terminal, a line per run in a log."""

import sys

import tqdm


class Progress:
    """Writes to `stream`. `describe(run)` is the text of a run that has ended."""

    def __init__(self, total, describe, stream=None):
        self._stream = stream or sys.stderr
        self._describe = describe
        self._total = total
        self._ended = 0
        self._bar = tqdm.tqdm(total=total, unit="run", file=self._stream, dynamic_ncols=True,
                              disable=not self._stream.isatty(), leave=False)

    def show(self, running):
        """Refreshes the bar; `running` are the names of the runs under way, as far as known."""
        self._bar.set_postfix_str(", ".join(running))

    def ended(self, run, seconds):
        self._ended += 1
        width = len(str(self._total))
        tqdm.tqdm.write(f"[{self._ended:>{width}}/{self._total}] {run.name}:"
                        f" {self._describe(run)} ({seconds:.0f} s)", file=self._stream)
        self._stream.flush()
        self._bar.update()

    def close(self):
        """Takes the bar away."""
        self._bar.close()
