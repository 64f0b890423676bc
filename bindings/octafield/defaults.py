"""Default values of options, read from the extension so that they are written down once, in the C++ option structs."""

import ast
import functools
from typing import Any

from . import _core


@functools.cache
def _signature(function: str) -> dict[str, object]:
    """Keyword defaults of `octafield.<function>`, from the signatures in its docstring (all overloads merged)."""
    defaults: dict[str, object] = {}
    for line in (getattr(_core, function).__doc__ or "").splitlines():
        start, end = line.find(f"{function}("), line.rfind(" -> ")
        if start < 0 or end < 0:
            continue
        try:
            parsed = ast.parse(f"def {line[start:end]}: ...").body[0]
        except SyntaxError:
            continue
        assert isinstance(parsed, ast.FunctionDef)
        arguments = parsed.args
        for argument, value in zip(arguments.kwonlyargs, arguments.kw_defaults):
            if isinstance(value, (ast.Constant, ast.UnaryOp)):
                defaults[argument.arg] = ast.literal_eval(value)
    return defaults


def default_of(function: str, option: str) -> Any:
    """Default of keyword `option` of `octafield.<function>`."""
    return _signature(function)[option]
