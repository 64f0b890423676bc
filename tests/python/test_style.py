"""Sources and pages keep the style: ruff's format and rules for Python, short lines in prose, published numbers of
commits that can be checked out."""

import re
import subprocess
import sys

import pytest
from docs_blocks import ROOT

sys.path.insert(0, str(ROOT / "scripts" / "docs"))
from reflow import long_prose, reflowed  # noqa: E402

PYTHON = ("bindings", "studies", "tests", "scripts")
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])


@pytest.mark.parametrize("command", [("format", "--check"), ("check", "--no-cache")], ids=["format", "rules"])
def test_python_passes_ruff(command):
    done = subprocess.run([sys.executable, "-m", "ruff", *command, *PYTHON], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_prose_of_pages_has_short_lines(page):
    assert long_prose(page.read_text(encoding="utf-8")) == []


def test_reflowing_changes_no_word_and_begins_no_list():
    words = "word - " * 30 + "`a code span` and 1. [a link](to/it.md){ width=200 } " * 5
    text = f"- {words}\n  and so on\n\n| {words} |\n"
    done = reflowed(text)
    assert done.split() == text.split() and long_prose(done) == []
    item = done.split("\n\n")[0].split("\n")
    assert [line for line in item[1:] if not line.startswith("  ") or line[2] in "-1"] == []


def test_long_prose_is_found_and_tables_code_and_headings_are_left_alone():
    long = "word " * 40
    assert long_prose(f"short\n{long}\n") == [2]
    assert long_prose(f"- item\n  {long}\n") == [2]
    assert long_prose(f"# {long}\n\n| {long} |\n\n```text\n{long}\n```\n\n    {long}\n\n[a]: {long}\n") == []
    assert long_prose(f"[{'a' * 200}](b)\n") == []  # nowhere to break


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_no_published_number_is_of_a_commit_nobody_can_check_out(page):
    assert re.findall(r"\b[0-9a-f]{7,40}(?:-dirty|\+)", page.read_text(encoding="utf-8")) == []


def test_no_file_holds_marks_of_a_merge():
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=False).stdout
    texts = [path for name in files.split("\0") if name and (path := ROOT / name).is_file()]
    marks = re.compile(rb"^(?:<{7} |>{7} )", re.M)
    assert [str(path) for path in texts if marks.search(path.read_bytes())] == []
