#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every message that a page quotes in `backticks` exists in the sources.

Usage: check_quotes.py. A quoted text of at least three words counts as a message, unless it is a
command or code. Words in capitals, numbers and "..." stand for any value, so the parts between them
are looked up. Prints one line per missing part; exit code 1 if there are any.
"""

import pathlib
import re
import subprocess
import sys

SOURCES = ("*.cpp", "*.h", "*.py", "*.sh", "*.launch", "*.rviz")
COMMANDS = re.compile(
    r"[$~./-]|[a-z_]+(/|:=|=|\(|\[)"
    r"|(apt|bash|cd|cmake|docker|evo_\w+|export|git|mavros|pip|python3?|ros\w+|rqt\w*|run_offline"
    r"|scripts|simulate|source|sudo|timestamp)\b")
CODE = re.compile(r"[{}<>\\^]|::|->|\bT_|\bp_|; i\b")
PLACEHOLDER = re.compile(r"\.\.\.|\b[A-Z][A-Z_]*\b|\S*[\d/]\S*|[%,;:()]")
LAST_WORD_BEFORE_VALUE = re.compile(r" (is|of|for)$")  # often added by a function
FOREIGN = {"Failed to load nodelet", "Failed to contact master"}  # of ROS
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"(?:\s*(?:f?"))?')
MIN_WORDS = 3


def main():
    texts = messages_of_sources()
    missing = [(page, number, part)
               for page in sorted(pathlib.Path("docs").glob("*.md")) + [pathlib.Path("README.md")]
               for number, line in enumerate(page.read_text().splitlines(), 1)
               for part in quoted_parts(line) if part not in texts]
    for page, number, part in missing:
        print(f"{page}:{number}: no message has \"{part}\"")
    return 1 if missing else 0


def messages_of_sources():
    """Returns the string literals of all sources; adjacent ones are joined."""
    files = subprocess.run(["git", "ls-files", *SOURCES], capture_output=True, text=True,
                           check=True).stdout.split()
    text = "\n".join(pathlib.Path(name).read_text() for name in files
                     if not name.startswith("test/"))
    joined = re.sub(r'"\s*\n\s*f?"', "", text)
    return "\n".join(LITERAL.findall(joined)).replace("%%", "%")


def quoted_parts(line):
    """Yields the parts of messages quoted in a line that contain no placeholder."""
    for quote in re.findall(r"`([^`]+)`", line):
        if len(quote.split()) < MIN_WORDS or COMMANDS.match(quote) or CODE.search(quote):
            continue
        for part in PLACEHOLDER.split(quote):
            part = LAST_WORD_BEFORE_VALUE.sub("", part.strip(" ."))
            if len(part.split()) >= MIN_WORDS and part not in FOREIGN:
                yield part


if __name__ == "__main__":
    sys.exit(main())
