"""The texts that the program prints: messages of errors and warnings, in Python and in Rust.

A name or a number within a text is one word, ``NAME``.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

#: A string literal of Rust, after comments, raw strings and characters, which may hold its mark.
LITERAL = re.compile(
    r"""//[^\n]*|r(?P<marks>\#*)"[\s\S]*?"(?P=marks)|'(?:[^'\\\n]|\\[^\n']+|\\')'"""
    r'''|"(?P<text>(?:[^"\\]|\\[\s\S])*)"'''
)
#: Blanks of a text, at least: shorter ones are keys and labels.
LEAST = 6


def of_python(text: str) -> Iterator[tuple[int, str]]:
    """Messages of the errors that a module raises, and of its warnings, with their lines."""
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, ast.Call):
            continue
        name = getattr(node.func, "id", getattr(node.func, "attr", ""))
        if name.endswith("Error") or name in {"warn", "SystemExit"}:
            yield from ((node.lineno, printed) for each in node.args if (printed := said(each)))


def said(node: ast.expr) -> str:
    """The text of an expression."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(said(part) for part in node.values)
    if isinstance(node, ast.BinOp):
        return said(node.left) + said(node.right)
    return "NAME" if isinstance(node, ast.FormattedValue) else ""


def of_rust(text: str) -> Iterator[tuple[int, str]]:
    """Sentences among the string literals of a module, with their lines; its tests are left out."""
    tests = text.find("#[cfg(test)]\nmod tests {")
    for found in LITERAL.finditer(text, 0, tests if tests >= 0 else len(text)):
        if (literal := found["text"]) is None or literal.count(" ") < LEAST:
            continue
        printed = re.sub(r"\\\n\s*", "", literal)
        if "\n" in printed:  # a program or a file
            continue
        printed = printed.replace("\\n", "\n").replace('\\"', '"')
        line = text.count("\n", 0, found.start()) + 1
        for paragraph in re.split(r"\n\s*\n", re.sub(r"\{[^{}]*\}", "NAME", printed)):
            yield line, " ".join(paragraph.split())
