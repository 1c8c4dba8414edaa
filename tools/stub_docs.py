"""Carry the docstrings of the compiled module into its stub, where editors look for them.

    python tools/stub_docs.py          # write python/pyfret/_core.pyi
    python tools/stub_docs.py --check  # fail if it would change

What users read stands once, above the Rust item; the stub adds the types of the signatures.
"""

from __future__ import annotations

import ast
import inspect
import sys
from pathlib import Path
from typing import Any

from pyfret import _core

STUB = Path(__file__).parents[1] / "python" / "pyfret" / "_core.pyi"


def runtime_doc(owner: Any, name: str) -> str:
    """The docstring of a member as Python shows it."""
    return inspect.cleandoc(getattr(getattr(owner, name), "__doc__", None) or "")


def quoted(doc: str, indent: str) -> list[str]:
    """The lines of a docstring in a stub."""
    raw = "r" if "\\" in doc else ""
    first, *rest = doc.splitlines()
    if not rest:
        return [f'{indent}{raw}"""{first}"""']
    body = [f"{indent}{line}" if line else "" for line in rest]
    return [f'{indent}{raw}"""{first}', *body, f'{indent}"""']


def replaced(lines: list[str], node: ast.ClassDef | ast.FunctionDef, doc: str) -> None:
    """Put the docstring of a class or a function of the stub in its place."""
    indent = " " * (node.col_offset + 4)
    first = node.body[0]
    has_doc = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    is_empty = has_doc and first.value.value is ...  # type: ignore[attr-defined]
    start, end = first.lineno - 1, first.end_lineno or first.lineno
    if is_empty:
        lines[start] = lines[start][: first.col_offset].rstrip()
        kept = [lines[start]] if lines[start].strip() else []
        lines[start:end] = [*kept, *quoted(doc, indent)]
    elif has_doc:
        lines[start:end] = quoted(doc, indent)
    else:
        lines[start:start] = [*quoted(doc, indent), ""]


def with_docs(text: str) -> str:
    """The text of the stub with the docstrings of the compiled module."""
    lines = text.splitlines()
    found: list[tuple[ast.ClassDef | ast.FunctionDef, str]] = []
    for node in ast.parse(text).body:
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            continue
        found.append((node, runtime_doc(_core, node.name)))
        for member in node.body if isinstance(node, ast.ClassDef) else []:
            if isinstance(member, ast.FunctionDef) and not member.name.startswith("__"):
                found.append((member, runtime_doc(getattr(_core, node.name), member.name)))
    for node, doc in sorted(found, key=lambda pair: -pair[0].lineno):
        if doc:
            replaced(lines, node, doc)
    return "\n".join(lines) + "\n"


def main() -> int:
    """Write the stub, or say whether it is as it should be."""
    text = STUB.read_text(encoding="utf-8")
    new = with_docs(text)
    if "--check" in sys.argv[1:]:
        if new != text:
            print(f"{STUB}: run tools/stub_docs.py")
        return int(new != text)
    STUB.write_text(new, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
