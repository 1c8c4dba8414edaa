"""Scenes and load paths as tables of HTML."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import LoadPath, Scene

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pyfret._core import Body, Branch

__all__ = ["number", "path_html", "scene_html", "show_in_notebooks", "table"]

#: Loads and motions of a branch, with their units.
GIVEN = (
    ("W", "N"),
    ("T_x", "N"),
    ("T_y", "N"),
    ("M_x", "N m"),
    ("M_y", "N m"),
    ("M_z", "N m"),
    ("delta_z", "m"),
    ("delta_x", "m"),
    ("delta_y", "m"),
    ("phi_x", "rad"),
    ("phi_y", "rad"),
    ("phi_z", "rad"),
    ("sigma_B", "Pa"),
    ("sigma_B1", "Pa"),
    ("rolled", "m"),
)


def table(heading: Sequence[str], rows: Iterable[Sequence[str]], *, words: bool = False) -> str:
    """A table of cells that are HTML already; it scrolls where it is too wide, words are broken."""
    head = "".join(f"<th>{cell}</th>" for cell in heading)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    kind = ' class="words"' if words else ""
    return (
        f'<div class="wide"><table{kind}><thead><tr>{head}</tr></thead>'
        f"<tbody>{body}</tbody></table></div>"
    )


def number(value: float) -> str:
    """A number in four digits."""
    return f"{value:.4g}"


def material(of: Any) -> str:
    """A material in words."""
    if not np.isfinite(of.E):
        return "rigid"
    return f"E = {number(of.E / 1e9)} GPa, &nu; = {number(of.nu)}"


def body_rows(name: str, body: Body) -> list[list[str]]:
    """What a body is: its shape, its coatings from the outermost on, its substrate."""
    rows = [[name, "surface", escape(repr(body.shape))]]
    for n, coating in enumerate(body.coatings):
        thick = f"{number(1e6 * coating.thickness)} µm"
        rows.append(["", f"coating {n + 1}", f"{thick}, {material(coating.material)}"])
    return [*rows, ["", "substrate", material(body.substrate)]]


def scene_html(scene: Scene) -> str:
    """A scene as a table, and its load path as another."""
    grid, hertz = scene.grid, scene.hertz
    cells = f"{grid.nx} &times; {grid.ny} cells of {number(1e6 * grid.dx)} µm"
    if not grid.plane_strain:
        cells += f" &times; {number(1e6 * grid.dy)} µm"
    rows = [
        *body_rows("upper body", scene.body1),
        *body_rows("lower body", scene.body2),
        ["friction", "", escape(repr(scene.friction))],
        ["grid", "", cells + (", plane strain" if grid.plane_strain else "")],
    ]
    if hertz is not None:
        size = f"a<sub>H</sub> = {number(1e6 * hertz.a)} µm, p<sub>H</sub> = "
        rows.append(["uncoated", "Hertz contact", f"{size}{number(1e-6 * hertz.p0)} MPa"])
    title = f"<p><b>{escape(scene.title)}</b></p>" if scene.title else ""
    return title + table(["", "", ""], rows, words=True) + path_html(scene.path)


def given(branch: Branch) -> str:
    """Loads and motions that a branch leads to."""
    parts = [
        f"{name} = {number(value)} {unit}"
        for name, unit in GIVEN
        if (value := getattr(branch, name)) or (name == "W" and value is not None)
    ]
    return ", ".join(parts) or "nothing"


def path_html(path: LoadPath) -> str:
    """A load path as a table: a row for each branch."""
    rows = [
        [
            str(n),
            number(branch.t),
            given(branch),
            "chosen" if branch.increments is None else str(branch.increments),
        ]
        for n, branch in enumerate(path.branches)
    ]
    return table(["branch", "t", "leads to", "increments"], rows, words=True)


def show_in_notebooks() -> None:
    """Let scenes and load paths be shown as tables."""
    for kind, html in ((Scene, scene_html), (LoadPath, path_html)):
        setattr(kind, "_repr_html_", html)  # noqa: B010
