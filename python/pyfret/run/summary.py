"""What a run ended with, as a table for people."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from pyfret.run import Run

__all__ = ["summary"]

#: Motions in the plane, and the loads that drive them.
IN_PLANE = (("delta_x", "T_x"), ("delta_y", "T_y"), ("phi_z", "M_z"))
#: What the codes of ``status`` mean.
STATUS = ("no contact", "full stick", "partial slip", "gross slip")


def columns(result: Run, ends: xr.Dataset) -> list[list[str]]:
    """Columns of the summary: a title, then a cell per branch."""
    hertz = "a_H" in result.dataset.attrs
    radius = ("a/a_H", 1 / result.a_H) if hertz else ("a [um]", 1e6)
    grid = result.scene.grid
    if grid.plane_strain:
        # Half the width of the strips that touch.
        ends["contact_radius"] = ends.contact_area / (2 * grid.dy)
    pressure = ("p_max/p_H", 1 / result.p_H) if hertz else ("p_max [MPa]", 1e-6)
    numbers = [
        ("t", "t", 1.0),
        ("W [N]", "W", 1.0),
        ("T_x [N]", "T_x", 1.0),
        (radius[0], "contact_radius", radius[1]),
        ("stick ratio", "stick_ratio", 1.0),
        (pressure[0], "p_max", pressure[1]),
        ("delta_z [um]", "delta_z", 1e6),
        ("delta_x [um]", "delta_x", 1e6),
        ("dissipated [uJ]", "dissipated", 1e6),
    ]
    others = [("T_y [N]", "T_y", 1.0), ("delta_y [um]", "delta_y", 1e6)]
    torsion = [("M_z [N m]", "M_z", 1.0), ("phi_z [urad]", "phi_z", 1e6)]
    for pair in (others, torsion):
        if any(drives(result, name) for _, name, _ in pair):
            numbers[3:3] = pair
    table = [
        [title, *(f"{value:.5g}" for value in scale * told(result, ends, name))]
        for title, name, scale in numbers
    ]
    return [*table, ["state", *(STATUS[int(code)] for code in ends.status)]]


def told(result: Run, ends: xr.Dataset, name: str) -> NDArray[np.float64]:
    """Give a number at the end of every branch, 0 where the run cannot tell it from zero.

    The slip in stick cells is held to `tolerance` mu times the approach; a shift that answers to a
    load is no better known, nor is a force that answers to a shift than `tolerance` mu W. The arm
    of rotations and moments is the radius of the contact.
    """
    values = ends[name].values
    branches = result.scene.path.branches
    part = (result.scene.settings.tolerance or 0.0) * min(result.scene.mu, 1.0)
    for motion, load in IN_PLANE:
        arm = ends.contact_radius.values if motion == "phi_z" else 1.0
        if name == motion:
            small = arm * np.abs(values) < part * np.abs(ends.delta_z.values)
        elif name == load:
            small = np.abs(values) < part * ends.W.values * arm
        else:
            continue
        answers = [getattr(branches[int(n)], name) is None for n in ends.branch]
        return np.where(answers & small, 0.0, values)
    return values


def drives(result: Run, name: str) -> bool:
    """Whether the path gives that load or motion a value other than zero."""
    return any(getattr(branch, name) for branch in result.scene.path.branches)


def summary(result: Run) -> str:
    """Tabulate what the run ended with: a line per branch, one per cycle, what is to be doubted.

    Lengths are over a_H and pressures over p_H where there is a Hertz contact, else in um and
    MPa; in plane strain a is half the width of the contact.
    """
    table = columns(result, result.branches())
    widths = [max(len(cell) for cell in column) for column in table]
    rows = [
        "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
        for row in zip(*table, strict=True)
    ]
    title = f"{result.dataset.attrs['title'] or 'run'}: {result.status}"
    doubts = [f"doubted: {doubt}" for doubt in result.doubts]
    return "\n".join([title, *rows, *cycle_lines(result), *doubts])


def cycle_lines(result: Run) -> list[str]:
    """A line for every cycle along every direction that is driven."""
    lines = []
    for direction in directions(result):
        loops = result.loops(direction=direction)
        for n in range(loops.sizes["cycle"]):
            of = loops.isel(cycle=n)
            lines.append(
                f"cycle {n + 1} ({direction}): {STATUS[int(of.status)]}, "
                f"{1e6 * float(of.dissipated):.4g} uJ dissipated, "
                f"energy ratio {float(of.energy_ratio):.3g}, "
                f"stiffness {float(of.stiffness):.4g} {of.stiffness.attrs['units']}"
            )
    return lines


def directions(result: Run) -> list[Literal["x", "y", "torsion"]]:
    """The fretting motions that the path drives."""
    motions: list[tuple[Literal["x", "y", "torsion"], tuple[str, str]]] = [
        ("x", ("T_x", "delta_x")),
        ("y", ("T_y", "delta_y")),
        ("torsion", ("M_z", "phi_z")),
    ]
    return [of for of, names in motions if any(drives(result, name) for name in names)]
