"""Print sentences that are too long.

``python tools/prose.py`` reads the pages of the Use book, the docstrings of the Python package and
the messages of errors and warnings. It prints the faults with file and line, and ends with 1 if
there are any. ``python tools/prose.py FILES`` reads other documents and modules. The rules are
those of CONTRIBUTING.md: one fact a sentence, at most 25 words. ``tools/words.py`` counts riddles.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import messages

ROOT = Path(__file__).resolve().parent.parent
#: Pages of the Use book. Numbers of evidence stand in docs/plastic.md, too: it is no help page.
USE = (
    "README.md",
    "docs/index.md",
    "docs/install.md",
    "docs/tutorial.md",
    "docs/howto/*.md",
    "docs/stress.md",
    "docs/fatigue.md",
    "docs/cracks.md",
    "docs/heat.md",
    "docs/wear.md",
    "docs/studies.md",
    "docs/report.md",
    "docs/conventions.md",
    "docs/scene_file.md",
    "docs/result_store.md",
    "docs/reference/*.md",
)
#: Modules whose docstrings and messages are read, and the stub of the compiled one.
CODE = ("python/pyfret/**/*.py", "python/pyfret/_core.pyi", "crates/*/src/**/*.rs")
#: Words of a sentence, at most.
MOST = 25
#: Ends of a sentence that are none.
ABBREVIATIONS = re.compile(
    r"\b(?:e\.g|i\.e|cf|vs|Fig|Eq|No|St|Dr|pp|al|Int|J|Proc|Inst|Mech|Eng|Sci)\.$"
)


def blocks(text: str) -> Iterator[tuple[int, str]]:
    """Paragraphs, items and cells of a document with their first line."""
    fenced, start, held = False, 0, []
    for number, line in enumerate([*text.splitlines(), ""], 1):
        stripped = line.strip()
        if stripped.startswith("```"):
            fenced = not fenced
            stripped = ""
        elif fenced or stripped.startswith(("#", "<", "!", "$$", "(", ":")):
            stripped = ""
        elif line.startswith("    ") and not held:
            continue
        if stripped.startswith("|"):
            for cell in re.split(r"(?<!\\)\|", stripped):
                if cell.strip():
                    yield number, cell.strip()
            stripped = ""
        item = re.match(r"(?:[-*]|\d+\.)\s+", stripped)
        if held and (not stripped or item):
            yield start, " ".join(held)
            held = []
        if stripped:
            if not held:
                start = number
            held.append(stripped[item.end() :] if item else stripped)


def plain(text: str) -> str:
    """The text as it is read: links by their words, code and formulas as one word."""
    text = re.sub(r"`[^`]*`", "CODE", text)
    text = re.sub(r"\$[^$]*\$", "FORMULA", text)
    text = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"[*_]{1,2}(\S.*?)[*_]{1,2}", r"\1", text)


def sentences(text: str) -> Iterator[str]:
    """The sentences of a paragraph."""
    held = ""
    for part in re.split(r"(?<=[.!?])\s+", plain(text)):
        held = f"{held} {part}".strip()
        # A citation has its initials and journals; a sentence goes on after an abbreviation.
        if ABBREVIATIONS.search(held) or re.search(r"\b[A-Z]\.$", held):
            continue
        yield held
        held = ""
    if held:
        yield held


def words(sentence: str) -> int:
    """Words of a sentence, citations in brackets aside."""
    outside = re.sub(r"\([^()]*\)", "", sentence)
    return len(re.findall(r"[A-Za-z][\w'/-]*", outside))


def docstrings(text: str) -> Iterator[tuple[int, str]]:
    """Paragraphs of the docstrings of a module with the line of what they belong to."""
    named = ast.Module, ast.ClassDef, ast.FunctionDef
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, named) and (doc := ast.get_docstring(node)):
            for _, block in blocks(paragraphs(doc)):
                yield getattr(node, "lineno", 1), block


def paragraphs(doc: str) -> str:
    """A docstring as a document: no examples, heads of sections and names of parameters."""
    lines = re.split(r"\n(?:Examples|See Also)\n-+\n", doc)[0].splitlines()
    kept, code, table = [], False, False
    for line, below in zip(lines, [*lines[1:], ""], strict=True):
        # What is indented after two colons is code, and tables are ruled by equal signs.
        code = code and (not line or line.startswith(" "))
        table = bool(line) and (table or line.startswith("==="))
        if code or table:
            kept.append("")
            continue
        code = line.endswith("::")
        head = re.fullmatch(r"-{3,}", below) or re.fullmatch(r"-{3,}", line)
        # A parameter or a type that is given back: what it is stands indented below.
        entry = re.match(r"[\w*][\w*, ]* : ", line) or re.match(r"\S+$", line)
        entry = entry or (re.match(r"[^-* ]", line) and below.startswith("    "))
        kept.append("" if head or entry else line.strip().replace("``", "`"))
    return "\n".join(kept)


def texts(document: Path) -> Iterator[tuple[int, str]]:
    """Paragraphs of a document, or docstrings and messages of a module, with their lines."""
    text = document.read_text(encoding="utf-8")
    if document.suffix == ".rs":
        yield from messages.of_rust(text)
    elif document.suffix in {".py", ".pyi"}:
        yield from docstrings(text)
        yield from messages.of_python(text)
    else:
        yield from blocks(text)


def faults(document: Path) -> Iterator[str]:
    """What breaks the rules in a document or in a module."""
    name = document.relative_to(ROOT) if document.is_relative_to(ROOT) else document
    for line, block in texts(document):
        for sentence in sentences(block):
            if (count := words(sentence)) > MOST:
                yield f"{name}:{line}: {count} words: {sentence}"


def is_test(document: Path) -> bool:
    """Whether a module of Rust is one of tests."""
    beside = document.with_name("mod.rs")
    declared = f"#[cfg(test)]\nmod {document.stem};"
    return document.suffix == ".rs" and beside.exists() and declared in beside.read_text()


def main(arguments: list[str]) -> int:
    """Print what breaks the rules."""
    given = [Path(argument).resolve() for argument in arguments]
    documents = given or [path for glob in (*USE, *CODE) for path in sorted(ROOT.glob(glob))]
    found = [fault for each in documents if not is_test(each) for fault in faults(each)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
