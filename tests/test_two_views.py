"""Numbers that stand on two pages of one result are the same, to the digits that are printed.

The pages are walked: every heading of a table and every name of a line about a cycle must be known
here, so that a new one is compared as well.
"""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Iterator
from html import unescape
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, W, sphere_on_flat
from pyfret.report import content
from pyfret.run.tables import cycles_table, ends_table

pytestmark = pytest.mark.solves

FRET = ROOT / "target" / "release" / "fret"
#: Units of pages in SI.
UNITS = {"um": 1e-6, "urad": 1e-6, "MPa": 1e6, "uJ": 1e-6, "mJ/m": 1e-3, "N": 1.0, "N m": 1.0}
UNITS |= {"N/m": 1.0, "": 1.0, "%": 0.01}
#: Names in the store by differing names in the pages.
NAMES = {
    "a": "contact_radius",
    "radius": "contact_radius",
    "dissip.": "dissipated",
    "error of shear": "path_error",
    "sliding ratio": "sliding_ratio",
    "sliding ratio (slip/shift)": "sliding_ratio",
}
#: What is no number of a branch or of a cycle.
OTHERS = {"branch", "#", "cycle", "state", "increments"}
NUMBER = r"\(?-?[\d.]+(?:e-?\d+)?(?: \+- [\d.]+)?\)?(?:e-?\d+)?"


def read(text: str) -> tuple[float, float]:
    """A printed number and half a unit of its last digit, such as 0.371 or (2.07 +- 0.01)e7."""
    matches = re.fullmatch(r"\(?(-?[\d.]+)(?: \+- [\d.]+\)?)?(?:e(-?\d+))?", text.strip())
    assert matches, text
    digits, power = matches[1], 10.0 ** int(matches[2] or 0)
    decimals = len(digits.partition(".")[2])
    # Zeros at the end of a whole number may be rounded ones: four digits are printed at least.
    last = 10.0**-decimals if decimals else 10.0 ** max(len(digits.lstrip("-")) - 4, 0)
    return float(digits) * power, 0.5 * last * power


def heading(text: str, of: dict[str, Any]) -> tuple[str, float]:
    """The name in the store and the SI unit of a heading."""
    text = unescape(re.sub("<[^>]+>", "_", text)).replace("__", "_").strip("_ ")
    text = text.replace("µ", "u").replace("δ", "delta").replace("φ", "phi").replace("_ ", " ")
    over = re.search(r"/([ap]_H)$|\[([ap]_H)\]", text)
    unit = re.search(r"\[([^\]]*)\]", text)
    name = re.sub(r"\s*\[[^\]]*\]|/[ap]_H$", "", text).strip()
    name = NAMES.get(name, name).replace(" ", "_")
    scale = float(of[over[1] or over[2]]) if over else UNITS[unit[1] if unit else ""]
    return name, scale


def rows_of_html(page: str) -> list[list[str]]:
    """Cells of the one table of a page."""
    rows = re.findall(r"<tr>(.*?)</tr>", page)
    return [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows]


def rows_of_text(page: str) -> list[list[str]]:
    """Cells of the table of a text: titles of several lines, a line of dashes, a line per row."""
    lines = page.splitlines()
    rule = next(n for n, line in enumerate(lines) if line and set(line) == {"-"})
    begin = rule
    while begin > 0 and "  " in lines[begin - 1].strip():
        begin -= 1
    end = next((n for n in range(rule, len(lines)) if not lines[n].strip()), len(lines))
    titles, body = lines[begin:rule], lines[rule + 1 : end]
    body = [line for line in body if "  " in line]
    width = max(map(len, [*titles, *body]))
    padded = [line.ljust(width) for line in (*titles, *body)]
    blank = [all(line[n] == " " for line in padded) for n in range(width)]
    ends = [n for n in range(1, width) if blank[n] and blank[n - 1]]
    columns = [(a, b) for a, b in pairwise([0, *ends, width]) if not all(blank[a:b])]
    cells = [[line[a:b].strip() for a, b in columns] for line in padded]
    count = len(titles)
    heads = [" ".join(filter(None, column)) for column in zip(*cells[:count], strict=True)]
    return [[head.replace("- ", "") for head in heads], *cells[count:]]


def of_branches(rows: list[list[str]], truth: dict[str, Any]) -> Iterator[tuple[str, int, str]]:
    """Name in the store, branch and printed number, of every cell of a table of branches."""
    for column, title in enumerate(rows[0]):
        name, scale = heading(title, truth)
        if name in OTHERS:
            continue
        for n, row in enumerate(rows[1:]):
            value, half = read(row[column].removesuffix("%"))
            assert name in truth["branches"][n], f"{name}: compare this heading as well"
            right = truth["branches"][n][name] / scale
            assert value == pytest.approx(right, abs=1.01 * half + 1e-6), (title, n, row[column])
            yield name, n, row[column]


def of_cycle(text: str, truth: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Name in the store and printed number, of every number of the lines about one cycle."""
    cycle = truth["cycles"][0]
    body = text.partition(":")[2].replace("\n", ",")
    for part in filter(None, (item.strip() for item in body.split(","))):
        numbers = re.findall(NUMBER, part)
        if not numbers:
            continue
        assert len(numbers) == 1, part
        name, _, unit = (item.strip() for item in part.partition(numbers[0]))
        if "dissipated" in unit:
            name, unit = "dissipated", unit.split()[0]
        name = name.partition(" (")[0].replace(" ", "_")
        value, half = read(numbers[0])
        assert name in cycle, f"{name}: compare this number as well"
        assert value == pytest.approx(cycle[name] / UNITS[unit], abs=1.01 * half), part
        yield name, numbers[0]


@pytest.fixture(scope="module")
def scene() -> fret.Scene:
    path = fret.LoadPath.start().normal(W, increments=2).cycles(1, T_x=0.2 * W, increments=10)
    return sphere_on_flat(n=24).replace(path=path)


@pytest.fixture(scope="module")
def result(scene: fret.Scene) -> fret.Result:
    return fret.solve(scene, progress=False, save="branches")


@pytest.fixture(scope="module")
def pages(scene: fret.Scene, tmp_path_factory: Any) -> tuple[str, dict[str, Any]]:
    """Return the output of the command for people and for programs."""
    folder: Path = tmp_path_factory.mktemp("views")
    (folder / "scene.toml").write_text(scene.to_toml(), encoding="utf-8")

    def run(*options: str) -> str:
        return subprocess.run(
            [FRET, "run", folder / "scene.toml", *options],
            capture_output=True,
            text=True,
            check=True,
        ).stdout

    return run("--out", str(folder / "run")), json.loads(
        run("--json", "--out", str(folder / "other"))
    )


def test_numbers_of_branches(result: fret.Result, pages: tuple[str, dict[str, Any]]) -> None:
    text, truth = pages
    tables = [
        rows_of_text(result.summary()),
        rows_of_html(ends_table(result)),
        rows_of_text(text),
    ]
    seen = [{name for name, _, _ in of_branches(rows, truth)} for rows in tables]
    for names in seen:
        assert {"W", "T_x", "contact_radius", "p_max", "stick_ratio", "dissipated"} <= names
    # The store itself.
    ends = result.branches()
    for name in truth["branches"][0].keys() & set(map(str, ends.data_vars)) - {"status"}:
        for n, branch in enumerate(truth["branches"]):
            if branch[name] is not None:
                assert float(ends[name][n]) == pytest.approx(branch[name], rel=1e-12), name


def test_numbers_of_cycles(result: fret.Result, pages: tuple[str, dict[str, Any]]) -> None:
    text, truth = pages
    of_summary = [line for line in result.summary().splitlines() if line.startswith("cycle")]
    lines = text.splitlines()
    first = next(n for n, line in enumerate(lines) if line.startswith("cycle"))
    block = [lines[first], *(line for line in lines[first + 1 :] if line.startswith("  "))]
    seen = [dict(of_cycle("\n".join(part), truth)) for part in (of_summary, block)]
    assert seen[0].keys() == seen[1].keys()
    assert {"dissipated", "energy_ratio", "sliding_ratio", "stiffness"} <= seen[0].keys()
    table = rows_of_html(cycles_table(result, "x"))
    for title, cell in zip(*table, strict=True):
        name, scale = heading(title, truth)
        if name in OTHERS:
            continue
        value, half = read(unescape(cell).replace("±", "+-"))
        assert value == pytest.approx(truth["cycles"][0][name] / scale, abs=1.01 * half), title
    loops = result.loops().isel(cycle=0)
    shared = truth["cycles"][0].keys() & set(map(str, loops.data_vars)) - {"status"}
    assert len(shared) >= 6
    for name in shared:
        right = truth["cycles"][0][name]
        computed = float(loops[name])
        # JSON has no NaN.
        assert (
            np.isnan(computed) if right is None else computed == pytest.approx(right, rel=1e-9)
        ), name


def test_numbers_of_a_run_of_wear(scene: fret.Scene, result: fret.Result) -> None:
    law = fret.wear.Archard(k=1e-14)
    worn = fret.wear.solve(scene, cycles=1e3, body2=law, progress=False)
    shown = content.figures(result, worn)["wear"]
    last = worn.dataset.isel(jump=-1)
    deep = re.search(rf"body 2: ({NUMBER}) um deep, ({NUMBER}) m\^3", worn.summary())
    assert deep
    for text, right in ((deep[1], 1e6 * last.depth2), (deep[2], last.volume2)):
        value, half = read(text)
        assert value == pytest.approx(float(right), abs=1.01 * half)
    assert shown["depth"][1][-1] == pytest.approx(1e6 * float(last.depth2), rel=2e-3)
    # The page shows the loop of the run of wear.
    loop = shown["loops"][-1]
    assert max(loop["y"]) == pytest.approx(float(worn.dataset.loop_T_x[-1].max()), rel=1e-3)
    assert max(loop["x"]) == pytest.approx(
        1e6 * float(worn.dataset.loop_delta_x[-1].max()), rel=1e-3
    )
    assert np.isfinite(loop["y"]).all()
