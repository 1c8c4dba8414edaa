"""Scenes and load paths as tables of HTML."""

from __future__ import annotations

import re
from html import unescape
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import LoadPath, Scene
from pyfret._util.numbers import in_words, length
from pyfret._util.text import html
from pyfret._util.window import wrap
from pyfret.scene.words import friction_in_words, shape_in_words

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pyfret._core import Body, Branch, Grid

__all__ = ["number", "path_html", "scene_html", "summarize_scene", "table"]

#: A tag of HTML.
TAG = re.compile("<[^>]+>")

#: Loads and motions of a branch: what they are called, and their units; those whose unit is empty
#: are lengths.
GIVEN = {
    "W": ("W", "N"),
    "T_x": ("T<sub>x</sub>", "N"),
    "T_y": ("T<sub>y</sub>", "N"),
    "M_x": ("M<sub>x</sub>", "N m"),
    "M_y": ("M<sub>y</sub>", "N m"),
    "M_z": ("M<sub>z</sub>", "N m"),
    "delta_z": ("&delta;<sub>z</sub>", ""),
    "delta_x": ("&delta;<sub>x</sub>", ""),
    "delta_y": ("&delta;<sub>y</sub>", ""),
    "phi_x": ("&phi;<sub>x</sub>", "rad"),
    "phi_y": ("&phi;<sub>y</sub>", "rad"),
    "phi_z": ("&phi;<sub>z</sub>", "rad"),
    "sigma_B": ("&sigma;<sub>B</sub>", "MPa"),
    "sigma_B1": ("&sigma;<sub>B1</sub>", "MPa"),
    "rolled": ("rolled", ""),
}
#: Factors of the printed units, by SI unit.
FACTORS = {"MPa": 1e6}


def table(heading: Sequence[str], rows: Iterable[Sequence[str]], *, words: bool = False) -> str:
    """Return a table of cells that are HTML already; it scrolls if it is too wide.

    `words` are broken and begin on the left.
    """
    alignment = ' style="text-align: left"' if words else ""
    # A head without words is no head to those who listen.
    head = "".join(
        f"<th{alignment}>{cell}</th>" if cell else f"<td{alignment}></td>" for cell in heading
    )
    lines = ("".join(f"<td{alignment}>{cell}</td>" for cell in row) for row in rows)
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    kind = ' class="words"' if words else ""
    return (
        f'<div class="wide" tabindex="0"><table{kind}><thead><tr>{head}</tr></thead>'
        f"<tbody>{body}</tbody></table></div>"
    )


def number(value: float) -> str:
    """A number in four digits, for people."""
    return in_words(value)


def material(of: Any) -> str:
    """Describe a material in words."""
    if not np.isfinite(of.E):
        return "rigid"
    return f"E = {number(of.E / 1e9)} GPa, &nu; = {number(of.nu)}"


def body_rows(name: str, body: Body) -> list[list[str]]:
    """Describe a body: its shape, its coatings from the outermost on, its substrate."""
    rows = [[name, "surface", shape_in_words(body.shape)]]
    for n, coating in enumerate(body.coatings):
        thick = length(coating.thickness)
        made_of = f"{thick}, {material(coating.material)}{residual_in_words(coating.residual)}"
        rows.append(["", f"coating {n + 1}", made_of])
    made_of = f"{material(body.substrate)}{residual_in_words(body.residual)}"
    return [*rows, ["", "substrate", made_of]]


def residual_in_words(residual: float | Sequence[Sequence[float]] | None) -> str:
    """Describe the residual stress of a layer; nothing where there is none."""
    if residual is None:
        return ""
    if isinstance(residual, float | int):
        return f", residual stress {number(residual / 1e6)} MPa" if residual else ""
    rows = np.asarray(residual, dtype=float)
    if not rows.size or not rows[:, 1:].any():
        return ""
    low, high = number(rows[:, 1:].min() / 1e6), number(rows[:, 1:].max() / 1e6)
    return f", residual stress {low} to {high} MPa, to a depth of {length(float(rows[-1, 0]))}"


def scene_rows(scene: Scene) -> list[list[str]]:
    """Describe a scene: part, number and value of each row, in HTML."""
    grid, hertz = scene.grid, scene.hertz
    cells = f"{grid.nx} cells of {length(grid.dx)}"
    if not grid.plane_strain:
        cells = f"{grid.nx} &times; {grid.ny} cells of {length(grid.dx)} &times; {length(grid.dy)}"
    rows = [
        *body_rows("upper body", scene.body1),
        *body_rows("lower body", scene.body2),
        ["friction", "", friction_in_words(scene)],
        ["grid", "", cells + plane_strain(grid)],
    ]
    if hertz is not None:
        size = f"a<sub>H</sub> = {number(1e6 * hertz.a)} µm, p<sub>H</sub> = "
        rows.append(["uncoated", "Hertz contact", f"{size}{number(1e-6 * hertz.p0)} MPa"])
    return rows


def summarize_scene(scene: Scene) -> str:
    """Describe a scene and its load path as text, a line for each part and branch."""
    lines = [scene.title] if scene.title else []
    part = ""
    for name, row, value in scene_rows(scene):
        part = name or part
        lines.append(f"{', '.join(filter(None, (part, row)))}: {value}")
    for n, branch in enumerate(scene.path.branches):
        count = "chosen" if branch.increments is None else str(branch.increments)
        lines.append(f"branch {n}: to {given(branch, scene.grid)}; increments: {count}")
    return wrap(unescape(TAG.sub("", "\n".join(lines).replace("<sub>", "_"))))


def scene_html(scene: Scene) -> str:
    """Return a scene as a table, and its load path as another."""
    rows = scene_rows(scene)
    title = f"<p><b>{html(scene.title)}</b></p>" if scene.title else ""
    return title + table(["", "", ""], rows, words=True) + path_html(scene.path, scene.grid)


def plane_strain(grid: Grid) -> str:
    """Describe the strip of a line contact."""
    if not grid.plane_strain:
        return ""
    return ", plane strain" + ("" if grid.dy == 1.0 else f", forces on {length(grid.dy)}")


def given(branch: Branch, grid: Grid | None = None) -> str:
    """Describe the loads and motions at the end of a branch."""
    parts = []
    for name, (symbol, unit) in GIVEN.items():
        value = getattr(branch, name)
        if not value and (name != "W" or value is None):
            continue
        if unit in ("N", "N m") and grid is not None:
            unit = grid.unit_of(unit)
        shown = length(value) if not unit else f"{number(value / FACTORS.get(unit, 1.0))} {unit}"
        parts.append(f"{symbol} = {shown}")
    return ", ".join(parts) or "nothing"


def path_html(path: LoadPath, grid: Grid | None = None) -> str:
    """Return a load path as a table: a row for each branch."""
    if not path.branches:
        return "<p>No load path: give it to <code>solve(scene, path)</code>.</p>"
    rows = [
        [
            str(n),
            number(branch.t),
            given(branch, grid),
            "chosen" if branch.increments is None else str(branch.increments),
        ]
        for n, branch in enumerate(path.branches)
    ]
    return table(["branch", "t", "leads to", "increments"], rows, words=True)
