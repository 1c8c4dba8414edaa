"""A run as tables of HTML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import with_error
from pyfret._util.text import html
from pyfret.run.loops import frictionless, state_in_words
from pyfret.run.summary import round_to_error, with_bar
from pyfret.scene.tables import number, table

if TYPE_CHECKING:
    import xarray as xr

    from pyfret._core import Scene
    from pyfret.run.run import Run
    from pyfret.run.state import State

__all__ = ["cycles_table", "ends_table", "run_html", "state_html"]

#: Scalars at the ends of the branches: what they are called, and their names.
ENDS = {
    "W": "W",
    "T_x": "T<sub>x</sub>",
    "T_y": "T<sub>y</sub>",
    "M_z": "M<sub>z</sub>",
    "delta_z": "&delta;<sub>z</sub>",
    "delta_x": "&delta;<sub>x</sub>",
    "delta_y": "&delta;<sub>y</sub>",
    "phi_z": "&phi;<sub>z</sub>",
    "sigma_B": "&sigma;<sub>B</sub>",
    "sigma_B1": "&sigma;<sub>B1</sub>",
    "contact_radius": "contact radius",
    "half_width": "half width",
    "p_max": "p<sub>max</sub>",
    "stick_ratio": "stick ratio",
    "dissipated": "dissipated",
    "plastic_work": "plastic work",
    "plastic_volume": "yielded",
    "largest_plastic_strain": "largest plastic strain",
    "path_error": "error of shear",
}
#: Units that people read numbers in, with their factors, by SI unit.
SHOWN_IN = {
    "m": (1e6, "µm"),
    "rad": (1e6, "µrad"),
    "Pa": (1e-6, "MPa"),
    "J": (1e6, "µJ"),
    "J/m": (1e3, "mJ/m"),
    "m^3": (1e18, "µm³"),
    "m^3/m": (1e12, "µm²"),
}


def heading(d: xr.Dataset, name: str) -> tuple[float, str]:
    """Return the factor of a scalar for a table, and its heading with the unit."""
    unit = str(d[name].attrs["units"])
    factor, shown = SHOWN_IN.get(unit, (1.0, unit))
    return factor, ENDS[name] if unit == "1" else f"{ENDS[name]} [{shown}]"


def has(name: str, scene: Scene) -> bool:
    """Whether a contact has a number: without friction it has no stick ratio."""
    return not (name == "stick_ratio" and frictionless(scene))


def ends_table(result: Run) -> str:
    """Return the numbers at the end of every branch, with their error bars if there are any."""
    ends = result.branches()
    bars = result.error_bars().sel(part="total") if result.dataset.attrs.get("error_bars") else None
    names = [name for name in ENDS if name in ends and has(name, result.scene)]
    values = {name: round_to_error(result, ends, name) for name in names}
    shown = {
        name: heading(ends, name)
        for name, column in values.items()
        if name == "W" or np.any(column)
    }
    rows = []
    for n in range(ends.sizes["branch"]):
        cells = [str(int(ends.branch[n]))]
        for name, (factor, _) in shown.items():
            value = float(values[name][n])
            cell = number(factor * value) if np.isfinite(value) else "-"
            if bars is not None and name in bars and np.isfinite(value):
                cell += f" &plusmn; {factor * float(bars[name][n]):.1g}"
            cells.append(cell)
        rows.append([*cells, state_in_words(ends.status[n], result.scene)])
    return table(["branch", *(title for _, title in shown.values()), "state"], rows)


def cycles_table(result: Run, direction: Any) -> str:
    """Return energies and stiffness of every closed cycle."""
    loops = result.loops(direction=direction)
    if not loops.sizes["cycle"]:
        return ""
    factor, joules = SHOWN_IN[loops.dissipated.attrs["units"]]
    stiff = f"stiffness [{loops.stiffness.attrs['units']}]"
    titles = ["cycle", f"dissipated [{joules}]", "energy ratio", "sliding ratio", stiff, "state"]
    rows = [
        [
            str(n + 1),
            with_bar(loop, "dissipated", factor),
            with_bar(loop, "energy_ratio"),
            with_error(float(loop.sliding_ratio), float(loop.sliding_ratio_error)),
            with_error(float(loop.stiffness), float(loop.stiffness_error)),
            state_in_words(loop.status, result.scene),
        ]
        for n, loop in ((n, loops.isel(cycle=n)) for n in range(loops.sizes["cycle"]))
    ]
    return table(titles, [[cell.replace("+-", "&plusmn;") for cell in row] for row in rows])


def run_html(result: Run) -> str:
    """A result as tables: what was solved, and the ends of the branches."""
    title = html(str(result.dataset.attrs["title"])) or "run"
    return f"<p><b>{title}</b>: {html(result.status)}</p>{ends_table(result)}"


def state_html(state: State) -> str:
    """Return an increment as a table: its loads, the contact and its motions."""
    d = state.dataset
    rows = []
    for name in ENDS:
        if name in d and has(name, state.scene) and (name == "W" or float(d[name])):
            if not np.isfinite(float(d[name])):
                continue
            factor, title = heading(d, name)
            rows.append([title, number(factor * float(d[name]))])
    rows.append(["state", state_in_words(d.status, state.scene)])
    title = f"<p><b>increment {int(d.increment)}</b>, t = {number(float(d.t))}</p>"
    return title + table(["", ""], rows)
