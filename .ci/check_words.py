#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the English of comments and pages by the rules in CONTRIBUTING.md ("English").

Usage: check_words.py [FILE ...]. Checks the comments and the lines of pages that were changed since
the branch left main, or in the last 20 commits; whole files if any are named. Ignores text in
`backticks` and "quotes". Prints one line per problem; exit code 1 if there are any.
"""

import collections
import pathlib
import re
import subprocess
import sys

SUFFIXES = {".h": "//", ".cpp": "//", ".py": "#", ".sh": "#", ".yaml": "#", ".cmake": "#",
            ".txt": "#", ".md": ""}

# A comment on lines of its own that opens like this has no subject.
OPENING = re.compile(
    r"(Of|The same|The reverse|What|Nothing|Who|Whose|Whoever|Which|Where|Those|That of|Than)\b"
    r"|As (?!long|soon|in\b|an?\b|the\b|of\b|\w+ing\b)\w"
    r"|(Since|With|By|From|In|To|For) (which|what|whom?|those)\b")
PRONOUNS = {"it", "its", "this", "that", "these", "those", "them", "they", "same", "such", "so"}
FILLERS = set("a all and are as at both by for from in is of on one or other others the then there"
              " to too was were what where which with".split())

# Words that make a reader guess, and the terms to use instead.
GLOSSARY = {
    r"at rest": "standstill",
    r"anew": "again, reinitialize",
    r"gives? up|gave up": "tracking lost, drop",
    r"sightings?": "observation",
    r"(is|are|be|been|was|were) refused": "reject",
    r"(leaves?|leaving|left) (out|it out|them out)|(does|do) without": "drop, ignore",
    r"IMU( alone)? (carries|carried|leads|led)": "propagate, dead reckoning",
    r"(tells?|says?|said|know|knows) nothing": "degenerate, unobservable, unknown",
    r"nothing (where|if|unless|until|without|for)|(or|else) nothing|nothing(?=:)": "nullopt",
    r"(one|two|three|four|five|six|ten|\d+) or (more|less|fewer)": "at least, at most",
    r"no (more|less|fewer) than": "at most, at least",
    r"of before|(of|from) the one before": "previous",
    r"(are|is|be|look|looks|nearly|just) alike": "are equal, similar",
    r"(takes?|took|taking) the place of": "replace",
    r"(lines?|tracks?|points?)( that)? (comes?|came|are|is) back": "re-observed, recognized",
    r"how (well|badly|open)": "covariance, standard deviation",
    r"in units of (its|their) deviation": "in standard deviations",
    r"whoever|who (has|asks|looks|gets|reads|waits|knows|wants)": "name the caller or reader",
    r"(marginal|initial|reinitial|linear)is(e|es|ed|er|ing|ation)": "...ize",
}
GLOSSARY = {re.compile(rf"\b({words})\b", re.IGNORECASE): term for words, term in GLOSSARY.items()}

Comment = collections.namedtuple("Comment", "first last column alone text")


def main(names):
    changed = {name: None for name in names} or changed_lines()
    problems = []
    for name, lines in sorted(changed.items()):
        path = pathlib.Path(name)
        if path.suffix in SUFFIXES and name != "CONTRIBUTING.md" and path.is_file():
            problems += check(name, path.read_text(encoding="utf-8"), lines)
    print(*problems, f"{len(problems)} words to reconsider (CONTRIBUTING.md, English)", sep="\n")
    return 1 if problems else 0


def changed_lines():
    """Returns the numbers of the added lines, by file."""
    base = git("merge-base", "origin/main", "HEAD").strip()
    if not base or base == git("rev-parse", "HEAD").strip():
        base = git("rev-list", "--max-count=21", "HEAD").split()[-1]
    lines = collections.defaultdict(set)
    diff = git("diff", "--unified=0", "--no-color", "--no-prefix", "--relative", base)
    for line in diff.splitlines():
        if line.startswith("+++ "):
            name = line[4:]
        hunk = re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line)
        if hunk:
            lines[name].update(range(int(hunk[1]), int(hunk[1]) + int(hunk[2] or 1)))
    return lines


def git(*arguments):
    return subprocess.run(("git", *arguments), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          encoding="utf-8", check=False).stdout


def check(name, text, lines=None):
    """Yields the problems of comments that overlap `lines`, or of all comments without `lines`."""
    for comment in comments(text, SUFFIXES[pathlib.Path(name).suffix]):
        if lines is not None and not lines.intersection(range(comment.first, comment.last + 1)):
            continue
        place = f"{name}:{comment.first}:"
        words = re.findall(r"[a-z]+", comment.text.lower())
        if comment.alone and OPENING.match(comment.text):
            yield f"{place} opens without a subject: {comment.text[:60]}"
        elif words and PRONOUNS.intersection(words) and PRONOUNS.union(FILLERS).issuperset(words):
            yield f"{place} only pronouns: {comment.text}"
        for pattern, term in GLOSSARY.items():
            for found in pattern.finditer(re.sub(r"`[^`]*`|\"[^\"]*\"", "", comment.text)):
                yield f"{place} '{found[0]}': {term}"


def comments(text, mark):
    """Yields the comments, with adjacent lines joined, or the lines of a page, which has no
    mark."""
    block = None
    for number, line in enumerate(text.splitlines(), start=1):
        found = re.match(rf"(.*\S  +|\s*){mark}(?!/)\s?(.*)$" if mark else "()(.+)$", line)
        alone = bool(mark and found) and not found[1].strip()
        if block and alone and len(found[1]) == block.column:
            block = block._replace(last=number, text=f"{block.text} {found[2].strip()}")
            continue
        if block:
            yield block
        block = found and Comment(number, number, len(found[1]), alone, found[2].strip())
    if block:
        yield block


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
