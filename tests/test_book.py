"""The book leads to its pages: links, contents, ten questions."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT

DOCS = ROOT / "docs"
#: What is written while the book is built: each gallery page is named by its script.
GALLERY = {script.stem for script in (ROOT / "examples" / "gallery").glob("*.py")} | {"index"}
PAGES = [page for page in sorted(DOCS.rglob("*.md")) if "gallery" not in page.parts]


def page(source: Path, target: str) -> Path:
    """The file that a link of a page leads to, with or without its ending."""
    position = (source.parent / target).resolve()
    return position if position.suffix else position.with_suffix(".md")


def is_there(source: Path, target: str) -> bool:
    position = page(source, target)
    if position.parent == DOCS / "gallery":
        return position.stem in GALLERY
    figure = re.fullmatch(r"sphx_glr_(\w+)_\d{3}", position.stem)
    if position.parent == DOCS / "gallery" / "images":
        return figure is not None and figure[1] in GALLERY
    return position.exists()


@pytest.mark.parametrize("source", PAGES, ids=lambda page: str(page.relative_to(DOCS)))
def test_every_link_leads_somewhere(source: Path) -> None:
    text = source.read_text(encoding="utf-8")
    targets = re.findall(r"\]\((?!https?:|#)([^)#\s]+)", text)
    targets += re.findall(r"```\{(?:figure|image)\} (\S+)", text)
    missing = [target for target in targets if not is_there(source, target)]
    assert not missing


def contents(source: Path) -> list[Path]:
    """The pages that the contents of a page name."""
    collected = []
    blocks = re.findall(r"```\{toctree\}\n(.*?)```", source.read_text(encoding="utf-8"), re.DOTALL)
    for name in (line for block in blocks for line in block.splitlines()):
        if not name or name.startswith(":") or "gallery" in name:
            continue
        if "*" in name:
            collected += sorted(source.parent.glob(name + ".md"))
        else:
            collected.append(page(source, name))
    return collected


def test_every_page_is_in_the_contents() -> None:
    reached: set[Path] = set()
    new = [DOCS / "index.md"]
    while new:
        source = new.pop()
        if source not in reached:
            reached.add(source)
            new += contents(source)
    assert {source.resolve() for source in PAGES} == reached


def test_questions_are_answered_within_two_clicks() -> None:
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    table = text[text.index("## Questions") :]
    rows = re.findall(r"\| ([^|]+[?.]) \| \[[^]]+\]\(([^)]+)\) \|", table)
    assert len(rows) >= 12
    for question, target in rows:
        assert page(DOCS / "index.md", target).is_file(), question


def test_every_page_has_one_title() -> None:
    for source in PAGES:
        text = re.sub(r"```.*?```", "", source.read_text(encoding="utf-8"), flags=re.DOTALL)
        assert len(re.findall(r"^# ", text, flags=re.MULTILINE)) == 1, source


#: Words that a practitioner looks for, and the page of the Use book that has the answer.
WORDS = {
    "bushing": "howto/limits",
    "taper": "howto/limits",
    "hip stem": "howto/limits",
    "connector": "howto/limits",
    "rises over cycles": "howto/limits",
    "rounded corners": "howto/flat_pads",
    "which one is better": "howto/which_of_two_coatings",
    "tilted": "howto/measured_loop",
    "backlash": "howto/measured_loop",
    "trailing edge": "howto/rig_life",
    "cycles to initiation": "howto/rig_life",
    "polymer": "wear",
    "q_scatter": "result_store",
    "delamination": "howto/crack_and_arrest",
    "tilted loop": "howto/measured_loop",
    "wear-through": "wear",
    "hip socket": "howto/limits",
    "grease": "howto/limits",
    "shot peening": "fatigue",
    "spline coupling": "howto/my_part",
    "dovetail": "howto/my_part",
    "bolted joint": "howto/my_part",
    "shrink fit": "howto/my_part",
    "wire rope": "howto/my_part",
    "false brinelling": "howto/my_part",
    "fuel rod": "howto/my_part",
    "corrosion": "howto/my_part",
}


@pytest.mark.parametrize(("word", "name"), WORDS.items())
def test_words_of_the_trade_are_in_their_pages(word: str, name: str) -> None:
    text = " ".join((DOCS / f"{name}.md").read_text(encoding="utf-8").split())
    assert word in text.lower()


@pytest.mark.solves
def test_sentences_of_the_use_book_are_short_and_plain() -> None:
    ran = subprocess.run(
        [sys.executable, ROOT / "tools" / "prose.py"], capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stdout
