"""Scenes, paths, results and studies as tables of HTML."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import LoadPath, Scene
from pyfret.summary import told

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pyfret._core import Body, Branch
    from pyfret.results import Result
    from pyfret.studies.outcome import Study

__all__ = ["path_html", "result_html", "scene_html", "study_html"]

#: What the codes of ``status`` mean.
STATUS = ("no contact", "full stick", "partial slip", "gross slip")
#: Scalars at the ends of the branches: heading, name, factor of the unit.
ENDS = (
    ("W [N]", "W", 1.0),
    ("T<sub>x</sub> [N]", "T_x", 1.0),
    ("T<sub>y</sub> [N]", "T_y", 1.0),
    ("M<sub>z</sub> [N m]", "M_z", 1.0),
    ("&delta;<sub>z</sub> [µm]", "delta_z", 1e6),
    ("&delta;<sub>x</sub> [µm]", "delta_x", 1e6),
    ("&delta;<sub>y</sub> [µm]", "delta_y", 1e6),
    ("&phi;<sub>z</sub> [µrad]", "phi_z", 1e6),
    ("contact radius [µm]", "contact_radius", 1e6),
    ("p<sub>max</sub> [MPa]", "p_max", 1e-6),
    ("stick ratio", "stick_ratio", 1.0),
    ("dissipated [µJ]", "dissipated", 1e6),
)
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


def ends_table(result: Result) -> str:
    """Numbers at the end of every branch, with their error bars where there are any."""
    ends = result.branches()
    bars = result.error_bars().sel(part="total") if result.dataset.attrs.get("error_bars") else None
    values = {name: told(result, ends, name) for _, name, _ in ENDS}
    shown = [of for of in ENDS if of[1] == "W" or np.any(values[of[1]])]
    rows = []
    for n in range(ends.sizes["branch"]):
        cells = [str(int(ends.branch[n]))]
        for _, name, factor in shown:
            cell = number(factor * float(values[name][n]))
            if bars is not None and name in bars:
                cell += f" &plusmn; {factor * float(bars[name][n]):.1g}"
            cells.append(cell)
        rows.append([*cells, STATUS[int(ends.status[n])]])
    return table(["branch", *(heading for heading, _, _ in shown), "state"], rows)


def cycles_table(result: Result, direction: Any) -> str:
    """Energies and stiffness of every closed cycle."""
    loops = result.loops(direction=direction)
    if not loops.sizes["cycle"]:
        return ""
    heading = ["cycle", "dissipated [µJ]", "energy ratio", "sliding ratio", "stiffness", "state"]
    rows = [
        [
            str(n + 1),
            number(1e6 * float(of.dissipated)),
            number(float(of.energy_ratio)),
            number(float(of.sliding_ratio)),
            f"{number(float(of.stiffness))} {of.stiffness.attrs['units']}",
            STATUS[int(of.status)],
        ]
        for n, of in ((n, loops.isel(cycle=n)) for n in range(loops.sizes["cycle"]))
    ]
    return table(heading, rows)


def result_html(result: Result) -> str:
    """A result as tables: what was solved, and the ends of the branches."""
    title = escape(str(result.dataset.attrs["title"]))
    return f"<p><b>{title}</b>: {escape(result.status)}</p>{ends_table(result)}"


def study_html(study: Study) -> str:
    """A study as a table: range of every parameter and measure."""
    d = study.dataset
    rows = []
    for kind, names in (("parameter", study.parameters), ("measure", study.measures)):
        for name in names:
            values = d[name].values
            if values.dtype.kind in "ifb" and np.isfinite(values).any():
                span = f"{number(np.nanmin(values))} to {number(np.nanmax(values))}"
            else:
                span = f"{np.unique(values).size} values"
            unit = str(d[name].attrs.get("units", ""))
            rows.append([kind, escape(name), span, "" if unit == "1" else escape(unit)])
    counts = ", ".join(f"{n} {name}" for name, n in study.count().items() if n)
    return f"<p><b>Study</b>: {counts}</p>{table(['', '', 'from, to', 'unit'], rows)}"
