#!/usr/bin/env python3
"""Breaks lines of prose above 140 characters in Markdown pages: reflow.py PAGE... rewrites paragraphs that have one.
Tables, code, headings, HTML and link definitions stay as they are."""

import re
import sys
import textwrap
from pathlib import Path

WIDTH = 140
_KEPT = re.compile(r"\s*(\||#|<|:::|\[[^\]]+\]: |!!!|-{3,}$)|(    )(?!\s*([-*+]|\d+\.) )")
_ITEM = re.compile(r"(\s*)((?:[-*+]|\d+\.) +)")
_WHOLE = re.compile(r"`[^`]+`|\{[^{}]*\}")  # spaces in these are no places to break
_SPACE = "\0"


def paragraphs(lines: list[str]) -> list[tuple[int, int]]:
    """First line and the one past the last of each paragraph or list item of prose, 0-based."""
    found: list[tuple[int, int]] = []
    in_code, begin = False, None
    for k, line in enumerate([*lines, ""]):
        fence = line.lstrip().startswith("```")
        inside_item = begin is not None and _ITEM.match(lines[begin]) and line.startswith("  ")
        prose = not (in_code or fence or not line.strip() or (_KEPT.match(line) and not inside_item))
        if begin is not None and (not prose or _ITEM.match(line)):
            found.append((begin, k))
            begin = None
        if prose and begin is None:
            begin = k
        in_code = in_code != fence
    return found


def too_long(line: str) -> bool:
    return len(line) > WIDTH and " " in _WHOLE.sub("", line.strip())


def long_prose(text: str) -> list[int]:
    """Lines, from 1, of prose above the width that could be broken."""
    lines = text.split("\n")
    return [k + 1 for begin, end in paragraphs(lines) for k in range(begin, end) if too_long(lines[k])]


def reflowed(text: str) -> str:
    lines = text.split("\n")
    for begin, end in reversed(paragraphs(lines)):
        if not any(too_long(line) for line in lines[begin:end]):
            continue
        item = _ITEM.match(lines[begin])
        first = item[0] if item else re.match(r"\s*", lines[begin])[0]
        words = " ".join(line.strip() for line in lines[begin:end]).removeprefix(first.strip()).strip()
        words = _WHOLE.sub(lambda span: span[0].replace(" ", _SPACE), words)
        words = re.sub(
            r" (?=(?:[-*+>#=]+|\d+\.)(?: |$))", _SPACE, words
        )  # would begin a list, a quotation or a heading
        wrapped = textwrap.wrap(words, WIDTH, initial_indent=first, subsequent_indent=" " * len(first),
                                break_long_words=False, break_on_hyphens=False)  # fmt: skip
        lines[begin:end] = [line.replace(_SPACE, " ") for line in wrapped]
    return "\n".join(lines)


if __name__ == "__main__":
    for name in sys.argv[1:]:
        page = Path(name)
        page.write_text(reflowed(page.read_text(encoding="utf-8")), encoding="utf-8")
