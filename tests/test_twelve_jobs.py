"""Twelve jobs of twelve trades: short code, and the answers that their pages print."""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

from conftest import ROOT

HOWTO = ROOT / "docs" / "howto"
PAGES = sorted(HOWTO.glob("part_*.md"))
HEADINGS = ["Answers", "Check by hand", "What the program does not know"]
#: Most lines of a job.
LINES = 25
NUMBER = r"(?<![\w.])\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w.]*\d)"


def job(page: Path) -> str:
    """The code of a page."""
    (code,) = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    return str(code)


def answers(page: Path) -> str:
    """The answers of a page, without its code."""
    text = page.read_text(encoding="utf-8")
    text = text[text.index("## Answers") : text.index("## Check by hand")]
    return re.sub(r"`[^`]*`", "", text)


def numbers(text: str) -> list[tuple[float, float]]:
    """Numbers of two digits or more, each with the unit of its last digit that is not zero."""
    # An error and its value may have one power of ten.
    text = re.sub(r"\(([\d.]+) \+- ([\d.]+)\)e(-?\d+)", r"\1e\3 +- \2e\3", text)
    values = []
    for word in re.findall(NUMBER, text):
        mantissa, _, power = word.partition("e")
        whole, _, decimals = mantissa.partition(".")
        digits = (whole + decimals).lstrip("0")
        zeros = 0 if decimals else len(digits) - len(digits.rstrip("0"))
        if len(digits) - zeros >= 2:
            values.append((float(word), 10.0 ** (int(power or 0) - len(decimals) + zeros)))
    return values


def test_there_are_twelve_jobs_in_the_index() -> None:
    assert len(PAGES) == 12
    index = (HOWTO / "my_part.md").read_text(encoding="utf-8")
    assert all(f"]({page.name})" in index for page in PAGES)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_job_is_short_and_its_page_is_whole(page: Path) -> None:
    assert len(job(page).splitlines()) <= LINES
    headings = re.findall(r"^## (.*)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert headings == HEADINGS
    assert numbers(answers(page))


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_answers_are_those_of_the_page(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every number of two digits among the answers is printed, to its last digit."""
    with warnings.catch_warnings():
        exec(compile(job(page), page.name, "exec"), {"__name__": "__main__"})
    plt.close("all")
    printed = [value for value, _ in numbers(capsys.readouterr().out)]
    missing = [
        value
        for value, unit in numbers(answers(page))
        if not any(abs(value - number) < 0.51 * unit for number in printed)
    ]
    assert not missing
