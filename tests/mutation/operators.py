"""Mutants of a module: copies of its source with one small change each, by the syntax tree (Python) or by the text of a
line (C++)."""

import ast
import copy
import random
import re
from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    """line: of the source, from 1. what: the change, for people. source: the whole changed file."""

    line: int
    what: str
    source: str


def sampled(mutants: list[Mutant], most: int, seed: int) -> list[Mutant]:
    """At most so many, always the same ones, in the order of the lines."""
    chosen = mutants if len(mutants) <= most else random.Random(seed).sample(mutants, most)
    return sorted(chosen, key=lambda mutant: (mutant.line, mutant.what))


# ---- Python ----

_COMPARE = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
}  # fmt: skip
_ARITHMETIC = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.FloorDiv: ast.Mult,
    ast.Mod: ast.Mult, ast.Pow: ast.Mult,
    ast.BitOr: ast.BitAnd, ast.BitAnd: ast.BitOr,
}  # fmt: skip


def python_mutants(source: str) -> list[Mutant]:
    """Every comparison, operator, number, condition, returned value and statement changed in turn. Left alone: words,
    types, and the texts of errors."""
    tree = ast.parse(source)
    skipped = {id(inner) for node in ast.walk(tree) for part in _not_code(node) for inner in ast.walk(part)}
    mutants = []
    for number, node in enumerate(ast.walk(tree)):
        if id(node) in skipped or not hasattr(node, "lineno") and not isinstance(node, ast.comprehension):
            continue
        for change in range(9):
            other = copy.deepcopy(tree)
            target = next(n for k, n in enumerate(ast.walk(other)) if k == number)
            what = _changed(target, change)
            if what is None:
                break
            text = ast.unparse(ast.fix_missing_locations(other))
            mutants.append(Mutant(getattr(node, "lineno", 0) or node.target.lineno, what, text))
    return mutants


def _not_code(node: ast.AST) -> Iterator[ast.AST]:
    """Parts whose change no test need notice."""
    if isinstance(node, ast.Raise):
        yield from ast.iter_child_nodes(node)
    elif isinstance(node, ast.JoinedStr):
        yield from node.values
    elif isinstance(node, ast.AnnAssign):
        yield node.annotation
    elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
        yield from node.decorator_list
        yield from (arg.annotation for arg in ast.walk(node.args) if isinstance(arg, ast.arg) and arg.annotation)
        if node.returns is not None:
            yield node.returns
        if node.name in ("__repr__", "_repr_html_"):
            yield from node.body
    elif isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
        yield node.test
        yield from node.body
    elif isinstance(node, (ast.Import, ast.ImportFrom)):
        yield from node.names


def _changed(node: ast.AST, change: int) -> str | None:
    """Makes change number `change` of a node in place; None where there are no more."""
    match node:
        case ast.Compare() if change < len(node.ops):
            before = type(node.ops[change])
            node.ops[change] = _COMPARE[before]()
            return f"{before.__name__} to {type(node.ops[change]).__name__}"
        case ast.BinOp() | ast.AugAssign() if change == 0 and type(node.op) in _ARITHMETIC:
            before = type(node.op)
            node.op = _ARITHMETIC[before]()
            return f"{before.__name__} to {type(node.op).__name__}"
        case ast.BoolOp() if change == 0:
            node.op = ast.Or() if isinstance(node.op, ast.And) else ast.And()
            return "and for or"
        case ast.UnaryOp(op=ast.Not()) if change == 0:
            node.operand = ast.UnaryOp(ast.Not(), node.operand)
            return "not dropped"
        case ast.UnaryOp(op=ast.USub()) if change == 0:
            node.op = ast.UAdd()
            return "sign dropped"
        case ast.If() | ast.While() | ast.IfExp() if change == 0:
            node.test = ast.UnaryOp(ast.Not(), node.test)
            return "condition turned round"
        case ast.Constant(value=bool()) if change == 0:
            node.value = not node.value
            return f"{not node.value} to {node.value}"
        case ast.Constant(value=int()) if change == 0 and not isinstance(node.value, bool):
            node.value += 1
            return f"{node.value - 1} to {node.value}"
        case ast.Constant(value=float()) if change < 2:
            before = node.value
            node.value = before * (2.0, 0.5)[change] if before else (1.0, -1.0)[change]
            return f"{before} to {node.value}"
        case ast.Return(value=value) if change == 0 and value is not None and not _is_none(value):
            node.value = ast.Constant(None)
            return "None returned"
        case ast.Expr(value=ast.Call()) if change == 0:
            node.value = ast.Constant(None)
            return "call dropped"
    return None


def _is_none(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and node.value is None


# ---- C++ ----

_CODE = [
    (re.compile(p), replacement)
    for p, replacement in (
        (r"(?<=[\w)\]] )<(?= [\w(-])", "<="), (r"<=(?!>)", "<"), (r"(?<=[\w)\]] )>(?= [\w(-])", ">="),
        (r"(?<=\s)>=(?=\s)", ">"),
        (r"==", "!="), (r"!=", "=="), (r"&&", "||"), (r"\|\|", "&&"),
        (r"(?<=[\w)\]] )\+(?= )", "-"), (r"(?<=[\w)\]] )-(?= )", "+"), (r"(?<=[\w)\]] )\*(?= )", "/"),
        (r"(?<=[\w)\]] )/(?= )", "*"),
        (r"\+=", "-="), (r"-=", "+="), (r"(?<![\w.])0(?![\w.])", "1"), (r"(?<![\w.])1(?![\w.])", "2"),
        (r"(?<![\w.])2(?![\w.])", "3"), (r"(?<![\w.])3(?![\w.])", "2"),
        (r"(?<![\w.])(\d+\.\d+|\d+e-?\d+)(?![\w.])", r"2 * \1"), (r"(?<![\w.])(\d+e-?\d+)(?![\w.])", r"1e-3 * \1"),
        (r"std::min\b", "std::max"), (r"std::max\b", "std::min"),
        (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r"(?<=\()!(?=[\w(])", ""), (r"\bcontinue;", ";"),
        (r"\? (.+?) : ([^;]+?)(?=[;,)])", r"? \2 : \1"),
    )
]  # fmt: skip


def cpp_mutants(source: str) -> list[Mutant]:
    """Every operator, small number, word and branch of the functions' lines changed in turn. Left alone: comments,
    preprocessor, texts, declarations of templates and loops' heads that would not end."""
    lines = source.split("\n")
    mutants = []
    for number, line in enumerate(lines):
        code = line.split("//")[0]
        if (
            not code.strip()
            or code.lstrip().startswith(("#", "template", "using", "namespace"))
            or "throw " in code
            or '"' in code
        ):
            continue
        for pattern, replacement in _CODE:
            for found in pattern.finditer(code):
                if "for (" in code and found.start() > code.index(";") > 0 and pattern.pattern in (r"\+=", r"-="):
                    continue
                changed = code[: found.start()] + found.expand(replacement) + code[found.end() :]
                text = "\n".join([*lines[:number], changed, *lines[number + 1 :]])
                mutants.append(
                    Mutant(number + 1, f"{found.group()} to {found.expand(replacement)}: {changed.strip()}", text)
                )
    return mutants
