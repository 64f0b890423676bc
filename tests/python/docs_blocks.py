"""The fenced blocks of Markdown pages, and how to run a page."""

import contextlib
import importlib
import io
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import command_server

ROOT = Path(__file__).parents[2]
_FENCE = re.compile(r'^```(\w+)(?: title="([^"]*)")?\n(.*?)^```$', flags=re.DOTALL | re.MULTILINE)
_SNIPPET = re.compile(r'^--8<-- "([^":]+):(\w+)"$', flags=re.MULTILINE)
OUTPUT = "output"  # the title of a block that shows what the one before prints


@dataclass(frozen=True)
class Block:
    language: str
    title: str
    text: str
    line: int  # of its first line, 1-based

    @property
    def is_command(self) -> bool:
        return self.language == "sh" and all(line.startswith("octafield ") for line in self.text.splitlines())

    @property
    def is_file(self) -> bool:
        return self.title.endswith((".yaml", ".py"))

    @property
    def content(self) -> str:
        """The text, a snippet in place of its name."""
        lines = self.text.splitlines()
        assert all(_SNIPPET.fullmatch(line) for line in lines if line.startswith("--8")), f"no snippet: {self.text}"
        return _SNIPPET.sub(lambda match: _snippet(ROOT / match[1], match[2]), self.text)


def _snippet(path: Path, section: str) -> str:
    text = path.read_text(encoding="utf-8")
    return text.partition(f"[start:{section}]\n")[2].partition(f"# --8<-- [end:{section}]")[0]


def blocks(page: Path) -> list[Block]:
    text = page.read_text(encoding="utf-8")
    return [Block(m[1], m[2] or "", m[3], text.count("\n", 0, m.start(3)) + 1) for m in _FENCE.finditer(text)]


def python_of(page: Path) -> str:
    return "\n".join(block.text for block in blocks(page) if block.language == "python" and not block.is_file)


def run_page(page: Path, from_nothing: bool = False) -> int:
    """Runs the Python and octafield commands of a page in the current folder, in order and in one namespace; files it
    shows are written there, one after another into one of the same name. from_nothing: commands import octafield anew.
    Returns how many blocks ran. AssertionError: a command fails or prints something else than the page says."""
    namespace: dict = {"__name__": "__main__"}
    printed, ran = "", 0
    for block in blocks(page):
        if block.is_file:
            with Path(Path(block.title).name).open("a", encoding="utf-8") as file:
                file.write(block.content)
            sys.modules.pop(Path(block.title).stem, None)  # another of this name, or what it was before
            importlib.invalidate_caches()
        elif block.language == "python":
            with contextlib.redirect_stdout(io.StringIO()) as stdout:
                exec(compile("\n" * (block.line - 1) + block.text, str(page), "exec"), namespace)
            printed, ran = stdout.getvalue(), ran + 1
        elif block.is_command:
            printed = "".join(
                _command(line, f"{page.name}:{block.line}", from_nothing) for line in block.text.splitlines()
            )
            ran += 1
        elif block.title == OUTPUT:
            assert printed == block.text, (
                f"{page.name}:{block.line}: the page says\n{block.text}but the block before prints\n{printed}"
            )
    return ran


def _command(line: str, where: str, from_nothing: bool) -> str:
    words = shlex.split(line, comments=True)
    if from_nothing:
        done = subprocess.run([sys.executable, "-m", *words], capture_output=True, text=True, timeout=300)
    else:
        done = command_server.run(words[1:], timeout=300)
    assert done.returncode == 0, f"{where}: {line}\n{done.stderr}"
    return done.stdout
