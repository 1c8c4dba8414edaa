"""Count names and sentences that a stranger cannot read, against a committed table.

``python tools/words.py`` counts the kinds of fault below in each crate, each Python package and the
tests. It compares the counts with ``tools/words.json``: a count that has grown is printed and the
program ends with 1. ``--write`` writes the counts into the table. ``--list UNIT`` prints the faults
of one unit with file and line, for example ``--list crates/fatigue``.
"""

from __future__ import annotations

import argparse
import ast
import json
import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TABLE = Path(__file__).with_suffix(".json")

PREPOSITIONS = (
    "of|at|by|on|in|to|with|within|without|along|across|beyond|beside|between|under|over|through"
    "|as|like|below|above|after|before|around"
)
PRONOUNS = (
    "of|one|each|found|given|own|other|both|rest|less|more|most|here|next|way|place|said|told"
    "|known|what|such|those|left|all|meant|named|wanted|asked"
)
HEAD = r"(?:Of|By|With|As|From|In|At|On|To|So|That|What|Where|Whose|Which|Those|The same)\b"
SPEAKING = "demonstrative without a noun, or a thing that speaks"
SPEECH = re.compile(r"\b(?:that|those) of\b|\b(?:told|tells?|says?)\b")
#: Phrases without a subject that a reader can point at.
RIDDLES = re.compile(
    r"\bone of its own\b|\bof one's own\b|\bas far as\b|\bbut for\b"
    r"|\b(?:run|page|program|error|message|result|table|it) (?:knows|hears|sees|asks)\b"
    r"|\bwhat .{3,40} (?:leaves|leave|errs by|buys)\b"
)
#: A line of Rust: each kind of fault and its expression.
RUST = {
    "function named by a preposition": re.compile(rf"\bfn (?:{PREPOSITIONS})\b"),
    "local named by a pronoun or participle": re.compile(rf"\blet (?:mut )?(?:{PRONOUNS})\b"),
    "doc head without a subject": re.compile(rf"//[/!] {HEAD}"),
    SPEAKING: SPEECH,
    "function named told": re.compile(r"\bfn told\b"),
    "riddle": RIDDLES,
}

Fault = tuple[str, int, str]


def faults_of_rust(text: str) -> Iterator[Fault]:
    """Yield kind, line number and text of each fault of a Rust file."""
    for number, line in enumerate(text.splitlines(), 1):
        for kind, pattern in RUST.items():
            for match in pattern.finditer(line):
                # A head is the first line of a documentation block.
                if kind.startswith("doc head") and not is_first_line(text, number):
                    continue
                yield kind, number, match[0]


def is_pronoun(name: ast.Name) -> bool:
    """Check that a name is assigned here and says nothing."""
    return isinstance(name.ctx, ast.Store) and bool(re.fullmatch(PRONOUNS, name.id))


def is_first_line(text: str, number: int) -> bool:
    """Check that a documentation line of Rust begins its block."""
    lines = text.splitlines()
    return number == 1 or not lines[number - 2].lstrip().startswith(("///", "//!"))


def faults_of_python(text: str) -> Iterator[Fault]:
    """Yield kind, line number and text of each fault of a Python file."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            name = node.name.lstrip("_")
            if re.fullmatch(PREPOSITIONS, name):
                yield "function named by a preposition", node.lineno, node.name
            if name == "told":
                yield "function named told", node.lineno, node.name
        elif isinstance(node, ast.Name) and is_pronoun(node):
            yield "local named by a pronoun or participle", node.lineno, node.id
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            doc = ast.get_docstring(node) or ""
            if match := re.match(HEAD, doc):
                yield "doc head without a subject", getattr(node, "lineno", 1), match[0]
    yield from faults_of_prose(text)


def faults_of_prose(text: str) -> Iterator[Fault]:
    """Yield kind, line number and text of each phrase without a subject."""
    for number, line in enumerate(text.splitlines(), 1):
        for kind, pattern in (SPEAKING, SPEECH), ("riddle", RIDDLES):
            for match in pattern.finditer(line):
                yield kind, number, match[0]


def units() -> dict[str, list[Path]]:
    """Return the source files of each crate, of each Python package and of the tests."""
    found: dict[str, list[Path]] = {}
    for crate in sorted((ROOT / "crates").iterdir()):
        found[f"crates/{crate.name}"] = sorted((crate / "src").rglob("*.rs"))
    for package in sorted((ROOT / "python").iterdir()):
        for path in sorted(package.rglob("*.py")):
            inside = path.relative_to(package).parts
            name = f"python/{package.name}" + (f"/{inside[0]}" if len(inside) > 1 else "")
            found.setdefault(name, []).append(path)
    found["tests"] = sorted((ROOT / "tests").rglob("*.py"))
    found["docs"] = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return {name: paths for name, paths in found.items() if paths}


def faults(path: Path) -> Iterator[Fault]:
    """Yield the faults of a source file."""
    text = path.read_text(encoding="utf-8")
    readers = {".rs": faults_of_rust, ".py": faults_of_python, ".md": faults_of_prose}
    yield from readers[path.suffix](text)


def count(paths: list[Path]) -> dict[str, int]:
    """Count the faults of each kind in some files."""
    kinds = Counter(kind for path in paths for kind, _, _ in faults(path))
    return {kind: kinds[kind] for kind in RUST}


def main(arguments: list[str]) -> int:
    """Compare the counts with the table; return 1 where one has grown."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write the counts into the table")
    parser.add_argument("--list", metavar="UNIT", help="print the faults of one unit")
    options = parser.parse_args(arguments)
    if options.list:
        for path in units()[options.list]:
            for kind, number, text in faults(path):
                print(f"{path.relative_to(ROOT)}:{number}: {kind}: {text}")
        return 0
    counts = {name: count(paths) for name, paths in units().items()}
    if options.write:
        TABLE.write_text(json.dumps(counts, indent=1) + "\n", encoding="utf-8")
        return 0
    table = json.loads(TABLE.read_text(encoding="utf-8"))
    grown = [
        f"{name}: {kind}: {number}, at most {table.get(name, {}).get(kind, 0)} allowed"
        for name, kinds in counts.items()
        for kind, number in kinds.items()
        if number > table.get(name, {}).get(kind, 0)
    ]
    print("\n".join(grown))
    if counts != table and not grown:
        print("Counts have fallen: write them down with `python tools/words.py --write`.")
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
