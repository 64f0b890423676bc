"""Reading the pages of reports, and records to make them from, for tests."""

import html
import re
from dataclasses import asdict
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

from octafield.options import FieldOptions
from octafield.progress.phases import PHASES
from octafield.records.record_file import record_of
from octafield.report import Report, Run, write_report


class Balanced(HTMLParser):
    """Collects elements; fails on a closing tag that does not match the open one."""

    VOID = {"meta", "img", "br", "link", "path", "use", "rect"}

    def __init__(self):
        super().__init__()
        self.open, self.seen = [], []

    def handle_starttag(self, tag, attributes):
        self.seen.append((tag, dict(attributes)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.seen.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if tag not in self.VOID:
            assert self.open.pop() == tag


def elements(page: str) -> list[tuple[str, dict]]:
    parser = Balanced()
    parser.feed(page)
    parser.close()
    assert parser.open == []
    return parser.seen


def require_sound(page: str, folder: Path) -> None:
    """Well-formed, nothing from elsewhere, ids unique, every link leads to an id or a file beside the page."""
    seen = elements(page)
    assert not re.findall(r"https?://|//[a-z]+\.", page)
    ids = [a["id"] for _, a in seen if "id" in a]
    assert len(ids) == len(set(ids))
    for tag, attributes in seen:
        assert tag not in ("link", "iframe", "object") and not (tag == "script" and "src" in attributes)
        if tag == "a":
            target = unquote(attributes["href"])
            assert target[1:] in ids if target.startswith("#") else (folder / target).is_file(), target
        elif "xlink:href" in attributes:
            assert attributes["xlink:href"][1:] in ids


def prose(page: str, references: bool = True) -> list[str]:
    """Text of the paragraphs; references: with "(Table 1, Figure 2)"."""
    found = re.findall(r'<p class="prose">(.*?)</p>', page, flags=re.DOTALL)
    if not references:
        found = [re.sub(r' \((, |<a href="#(table|figure)-[^<]*</a>)+\)', "", text) for text in found]
    return [html.unescape(re.sub(r"<.*?>", "", text)) for text in found]


def record(representation="sh4", boundary="aligned", energy=1.0, *, seed=0, state="done", **more):
    """As read from a result.json, of a mesh with 10 vertices. more: options of the run, or figures of the record."""
    names = FieldOptions.__dataclass_fields__
    options = FieldOptions(
        representation=representation, boundary=boundary, seed=seed, **{k: v for k, v in more.items() if k in names}
    )
    head = {"options": asdict(options), "state": state, "message": more.get("message", ""), "key": "k", "input": "part"}
    if state != "done":
        return record_of(head, "a test")
    figures = {
        **dict.fromkeys(("singular_edges", "complex_edges", "non_meshable_vertices", "non_meshable_feature_edges",
            "non_meshable_corners"), 0),
        "energy": energy, "energy_unit_speed": 0.15 * energy, "vertices": 10, "tets": 20, "boundary_triangles": 16,
        "edge_length": 0.5, "feature_edges": 12,
        "feature_corners": 8, "feature_source": "angle", "mesh_sha256": "0123456789abcdef", "singular_length": 0.0,
        "singular_edges_by_turns": {},
        "alignment_deg": {"median": 0.0, "max": 1.0, "held_max": 0.5}, "unserved_vertices": 0,
        "feature_alignment_deg": {"median": 0.0, "max": 0.0}, "integrability": {"jump_rms": 0.1},
        "iterations": 2, "energy_history": [2 * energy, 1.5 * energy, energy], "objective": 3 * energy,
        "objective_history": [4.5 * energy, 3 * energy], "converged": True, "stop_reason": "", "notes": [],
        "peak_mb": 100.0,
        "wall_seconds": dict.fromkeys(PHASES, 0.25), "cpu_seconds": dict.fromkeys(PHASES, 0.5),
        "surface_field": {"euler_characteristic": 2},
        "version": "1.2.3", "versions": {"octafield": "1.2.3"}, "input_kind": "surface", "regions": 1, "threads": 1,
        "singular_curves": 0, "singular_nodes": 0,
    }  # fmt: skip
    told = {**head, **figures, **{key: value for key, value in more.items() if key not in names}}
    return record_of(told, "a test")


def page_of(folder: Path, records: list[tuple[str, dict]], **options) -> str:
    """The page of runs given as (input, record), checked by require_sound."""
    write_report(Report("a report", [Run(row, name) for name, row in records], **options), folder)
    page = (folder / "report.html").read_text()
    require_sound(page, folder)
    return page
