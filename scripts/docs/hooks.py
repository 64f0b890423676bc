"""Pages of the documentation that are made from the repository: README files of the folders, and one page per public
header."""

import posixpath
import re
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[2]
MODULES = ("core", "frames", "surface", "volume")
READMES = {f"{module}/README.md": f"api/cpp/{module}.md" for module in MODULES} | {
    "bindings/README.md": "api/bindings.md",
    "studies/README.md": "study_scripts.md",
}
LINK = re.compile(r"(\]\()(\.\.?/[^)#\s]+)((?:#[^)\s]*)?\))")


def headers(module: str) -> list[Path]:
    """Public headers of a module and of its sub-modules, relative to the repository, sorted by name."""
    folders = [ROOT / module / "include", *(ROOT / module).glob("*/include")]
    found = (path.relative_to(ROOT) for folder in folders for path in folder.rglob("*.hpp"))
    return sorted(found, key=lambda path: path.name)


def header_page(header: Path) -> str:
    return f"api/cpp/{header.parts[0]}/{header.stem}.md"


def first_sentence(header: Path) -> str:
    """Of the comment a header begins with."""
    lines = []
    for line in (ROOT / header).read_text(encoding="utf-8").splitlines():
        if not line.startswith("// "):
            break
        lines.append(line[3:])
    text = " ".join(lines)
    if not text:
        raise PluginError(f"{header} does not begin with a comment that says what it holds")
    return re.split(r"(?<=[.:])\s+(?=[A-Z])", text, maxsplit=1)[0]


def site_links(markdown: str, repository_path: str, page: str) -> str:
    """Relative links between files of the repository, as links between pages of the site."""

    def replaced(match: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(repository_path), match[2]))
        if target.startswith("docs/"):
            where = target.removeprefix("docs/")
        elif target in READMES:
            where = READMES[target]
        elif target.endswith(".hpp"):
            where = header_page(Path(target))
        else:
            raise PluginError(f"{repository_path}: no page of the site shows {target}; name it without a link")
        return match[1] + posixpath.relpath(where, posixpath.dirname(page) or ".") + match[3]

    return LINK.sub(replaced, markdown)


def header_table(module: str, page: str) -> str:
    start = posixpath.dirname(page) or "."
    rows = [
        f"| [`{h.name}`]({posixpath.relpath(header_page(h), start)}) | {first_sentence(h)} |" for h in headers(module)
    ]
    return "\n".join(["| header | what it holds |", "|---|---|", *rows])


def on_files(files: Files, config: MkDocsConfig) -> Files:
    def add(page: str, content: str) -> None:
        files.append(File.generated(config, page, content=content))

    for readme, page in READMES.items():
        text = site_links((ROOT / readme).read_text(encoding="utf-8"), readme, page)
        module = readme.split("/")[0]
        add(page, f"{text}\n## Headers\n\n{header_table(module, page)}\n" if module in MODULES else text)
    for module in MODULES:
        for header in headers(module):
            include = Path(*header.parts[header.parts.index("include") + 1 :])
            code = (ROOT / header).read_text(encoding="utf-8")
            text = (
                f'# {header.name}\n\n`#include "{include}"`, module [{module}](../{module}.md).\n\n```cpp\n{code}```\n'
            )
            add(header_page(header), text)
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    source = page.file.src_uri
    if page.file.generated_by:
        return markdown
    for module in MODULES:
        markdown = markdown.replace(f"<!-- headers of {module} -->", header_table(module, source))
    return site_links(markdown, f"docs/{source}", source)
