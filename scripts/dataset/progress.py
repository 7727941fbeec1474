# SPDX-License-Identifier: BSD-3-Clause
"""Shows how far the runs are: a bar on a terminal, a line per run in a log."""

import shutil
import sys
import time

BAR_WIDTH = 24


class Progress:
    """Writes to `stream`. `describe(run)` is the text of a run that has ended."""

    def __init__(self, total, describe, stream=None):
        self._stream = stream or sys.stderr
        self._is_terminal = self._stream.isatty()
        self._total = total
        self._describe = describe
        self._ended = 0
        self._started = time.monotonic()
        self._expected_end = None

    def show(self, running):
        """Redraws the bar; `running` are the names of the runs under way."""
        if not self._is_terminal:
            return
        filled = BAR_WIDTH * self._ended // max(self._total, 1)
        bar = "#" * filled + "." * (BAR_WIDTH - filled)
        text = f"[{bar}] {self._ended}/{self._total}{self._time_left()}  {', '.join(running)}"
        width = shutil.get_terminal_size().columns - 1
        self._stream.write("\r\033[K" + text[:width])
        self._stream.flush()

    def ended(self, run, seconds):
        self._ended += 1
        now = time.monotonic()
        per_run = (now - self._started) / self._ended
        self._expected_end = now + per_run * (self._total - self._ended)
        self.clear()
        width = len(str(self._total))
        self._stream.write(f"[{self._ended:>{width}}/{self._total}] {run.name}:"
                           f" {self._describe(run)} ({seconds:.0f} s)\n")
        self._stream.flush()

    def clear(self):
        """Takes the bar away."""
        if self._is_terminal:
            self._stream.write("\r\033[K")
            self._stream.flush()

    def _time_left(self):
        if self._expected_end is None:
            return ""
        minutes, seconds = divmod(max(0, round(self._expected_end - time.monotonic())), 60)
        return f", {minutes}:{seconds:02} left"
