"""A run as tables of HTML."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret.run.summary import STATUS, told
from pyfret.scene.tables import number, table

if TYPE_CHECKING:
    from pyfret.run.run import Run
    from pyfret.run.state import State

__all__ = ["cycles_table", "ends_table", "run_html", "state_html"]

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


def ends_table(result: Run) -> str:
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


def cycles_table(result: Run, direction: Any) -> str:
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


def run_html(result: Run) -> str:
    """A result as tables: what was solved, and the ends of the branches."""
    title = escape(str(result.dataset.attrs["title"]))
    return f"<p><b>{title}</b>: {escape(result.status)}</p>{ends_table(result)}"


def state_html(state: State) -> str:
    """An increment as a table: its loads and what they do."""
    d = state.dataset
    numbers = [
        (heading, factor * float(d[name]))
        for heading, name, factor in ENDS
        if name in d and (name == "W" or float(d[name]))
    ]
    rows = [[heading, number(value)] for heading, value in numbers]
    rows.append(["state", STATUS[int(d.status)]])
    title = f"<p><b>increment {int(d.increment)}</b>, t = {number(float(d.t))}</p>"
    return title + table(["", ""], rows)
