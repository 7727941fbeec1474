#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plays bags as `rosbag play` does, for launch files: BAGS is one text, and may name folders and
patterns.

Usage: play_bags.py BAGS [option of rosbag play ...]

BAGS is a file, a folder (all of its *.bag) or a pattern, or several of them between blanks, quoted
as in a shell where they have blanks themselves. All are played as one, in order of time.
"""

import glob
import os
import shlex
import sys


def expand(place):
    """The files that one place names."""
    place = os.path.expanduser(place)
    if os.path.isdir(place):
        files = glob.glob(os.path.join(glob.escape(place), "*.bag"))
    else:
        files = [place] if os.path.exists(place) else glob.glob(place)
    if not files:
        sys.exit(f"play_bags.py: no bag {place}: give an absolute path, as nodes run in ~/.ros")
    return sorted(files)


def find_bags(text):
    """The files that a text names; each once, in order of their places."""
    places = [text] if os.path.exists(os.path.expanduser(text)) else shlex.split(text)
    return list(dict.fromkeys(file for place in places for file in expand(place)))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    bags = find_bags(sys.argv[1])
    os.execvp("rosrun", ["rosrun", "rosbag", "play", *sys.argv[2:], *bags])


if __name__ == "__main__":
    main()
