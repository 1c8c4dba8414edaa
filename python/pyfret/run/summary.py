"""Summary of a run as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from pyfret._core import STRAIN_AT_A_RIM, TOO_FEW_INCREMENTS, with_error
from pyfret._util.numbers import in_words
from pyfret._util.text import shown
from pyfret._util.window import format_table, wrap
from pyfret.run.loops import frictionless, state_in_words

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from pyfret.run import Run

__all__ = ["summary"]

#: Motions in the plane, and the loads that drive them.
IN_PLANE = (("delta_x", "T_x"), ("delta_y", "T_y"), ("phi_z", "M_z"))

#: Bulk stresses of the bodies.
BULK = ("sigma_B", "sigma_B1")


def half_length(ends: xr.Dataset) -> str:
    """Name of the radius of the contact, of a line contact half its width."""
    return "half_width" if "half_width" in ends else "contact_radius"


def energy_scale(unit: str) -> tuple[float, str]:
    """Return the unit of energies: microjoules, for line contacts millijoules per metre."""
    return (1e3, "mJ/m") if unit == "J/m" else (1e6, "uJ")


def columns(result: Run, ends: xr.Dataset) -> list[list[str]]:
    """Return the columns of the summary: a title, then a cell per branch."""
    hertz = "a_H" in result.dataset.attrs
    radius = ("a/a_H", 1 / result.a_H) if hertz else ("a [um]", 1e6)
    pressure = ("p_max/p_H", 1 / result.p_H) if hertz else ("p_max [MPa]", 1e-6)
    energy, joules = energy_scale(ends.dissipated.attrs["units"])
    force, moment = (ends[name].attrs["units"] for name in ("W", "M_z"))
    numbers = [
        ("t", "t", 1.0),
        (f"W [{force}]", "W", 1.0),
        (f"T_x [{force}]", "T_x", 1.0),
        (radius[0], half_length(ends), radius[1]),
        ("stick ratio", "stick_ratio", 1.0),
        (pressure[0], "p_max", pressure[1]),
        ("delta_z [um]", "delta_z", 1e6),
        ("delta_x [um]", "delta_x", 1e6),
        (f"dissipated [{joules}]", "dissipated", energy),
    ]
    if yield_ratio(result) >= 1.0:
        volume = "um^2" if ends.plastic_volume.attrs["units"] == "m^3/m" else "um^3"
        per_cube = 1e12 if volume == "um^2" else 1e18
        numbers += [
            (f"plastic work [{joules}]", "plastic_work", energy),
            (f"yielded [{volume}]", "plastic_volume", per_cube),
            ("largest plastic strain [%]", "largest_plastic_strain", 1e2),
        ]
    others = [(f"T_y [{force}]", "T_y", 1.0), ("delta_y [um]", "delta_y", 1e6)]
    torsion = [(f"M_z [{moment}]", "M_z", 1.0), ("phi_z [urad]", "phi_z", 1e6)]
    bulk = [(f"{name} [MPa]", name, 1e-6) for name in BULK if drives(result, name)]
    numbers[3:3] = bulk
    for pair in (others, torsion):
        if any(drives(result, name) for _, name, _ in pair):
            numbers[3:3] = pair
    bars = result.error_bars().sel(part="total") if result.dataset.attrs.get("error_bars") else None
    if frictionless(result.scene):
        numbers = [row for row in numbers if row[1] != "stick_ratio"]
    table = []
    for title, name, scale in numbers:
        values = scale * round_to_error(result, ends, name)
        if bars is not None and name in bars:
            errors = scale * bars[name].values
            cells = [
                with_error(v, e) if np.isfinite(e) else in_words(v)
                for v, e in zip(values, errors, strict=True)
            ]
        else:
            cells = [in_words(value) if np.isfinite(value) else "-" for value in values]
        table.append([title, *cells])
    if "path_error" in ends:
        table.append(["error of shear", *(f"{100 * e:.2f} %" for e in ends.path_error.values)])
    return [*table, ["state", *(state_in_words(code, result.scene) for code in ends.status)]]


def round_to_error(result: Run, ends: xr.Dataset, name: str) -> NDArray[np.float64]:
    """Return a number at the end of every branch, 0 where its error is larger.

    The slip in stick cells is held to `tolerance` mu times the approach. A shift that answers to a
    load is no better known. A force that answers to a shift is known to `tolerance` mu W. The arm
    of rotations and moments is the radius of the contact.
    """
    values = ends[name].values
    branches = result.scene.path.branches
    part = (result.scene.settings.tolerance or 0.0) * min(result.scene.mu, 1.0)
    for motion, load in IN_PLANE:
        arm = ends[half_length(ends)].values if motion == "phi_z" else 1.0
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
    """Tabulate what the run ended with: a line per cycle, a row per branch, the warnings.

    Lengths are over a_H and pressures over p_H where there is a Hertz contact, else in um and
    MPa. Of a line contact a is half its width, and forces and energies are per metre. Errors that
    of the run stand behind ``+-``.
    """
    titles, *rows = zip(*columns(result, result.branches()), strict=True)
    table = format_table([title.replace(" [", "\n[") for title in titles], rows)
    title = f"{result.dataset.attrs['title'] or 'run'}: {result.status}"
    doubts = [f"warning: {doubt}" for doubt in result.doubts]
    lines = [
        *cycle_lines(result),
        *yardsticks(result),
        *far_from_yield(result),
        *strain_at_rim(result),
    ]
    return wrap(shown("\n".join([title, *lines, table, *doubts])))


def yardsticks(result: Run) -> list[str]:
    """Return the Hertz yardsticks of lengths and pressures, if there are any."""
    if "a_H" not in result.dataset.attrs:
        return []
    a, p = 1e6 * result.a_H, 1e-6 * result.p_H
    return [f"a_H = {in_words(a)} um, p_H = {in_words(p)} MPa: Hertz, without coatings"]


def yield_ratio(result: Run) -> float:
    """Largest stress of von Mises of the run over the yield stress, 1 where a body yields.

    0 for bodies that stay elastic.
    """
    return float(result.dataset.yield_ratio.max()) if "yield_ratio" in result.dataset else 0.0


def far_from_yield(result: Run) -> list[str]:
    """Return how far bodies that may yield are from it, if none has."""
    ratio = yield_ratio(result)
    if not 0.0 < ratio < 1.0:
        return []
    return [
        "nothing yields: the largest stress of von Mises is "
        f"{in_words(ratio, 3)} of the yield stress (on the volume grid)"
    ]


def strain_at_rim(result: Run) -> list[str]:
    """Return the note on a largest strain that does not converge."""
    last = result.dataset.get("strain_at_rim")
    if last is None or not last.size or last.values[-1] == 0.0:
        return []
    return [STRAIN_AT_A_RIM]


def cycle_lines(result: Run) -> list[str]:
    """Return a line for every cycle along every direction that is driven."""
    lines = []
    for direction in directions(result):
        loops = result.loops(direction=direction)
        for n in range(loops.sizes["cycle"]):
            loop = loops.isel(cycle=n)
            scale, joules = energy_scale(loop.dissipated.attrs["units"])
            energy = with_bar(loop, "dissipated", scale)
            lines.append(
                f"cycle {n + 1} ({direction}): {state_in_words(loop.status, result.scene)}, "
                f"{energy} {joules} dissipated, "
                f"energy ratio {with_bar(loop, 'energy_ratio', digits=3)}, "
                "sliding ratio (slip/shift) "
                f"{with_error(float(loop.sliding_ratio), float(loop.sliding_ratio_error))}, "
                f"stiffness {stiffness(loop)}"
            )
    return lines


def with_bar(of: xr.Dataset, name: str, scale: float = 1.0, digits: int = 4) -> str:
    """A number of a cycle with its error, or without where the run has no error bars."""
    if f"{name}_error" not in of:
        return in_words(scale * float(of[name]), digits)
    return with_error(scale * float(of[name]), scale * float(of[f"{name}_error"]))


def stiffness(of: xr.Dataset) -> str:
    """The stiffness of a cycle with its error and unit, or why it is not known."""
    value = float(of.stiffness)
    if np.isnan(value):
        return f"not known: {TOO_FEW_INCREMENTS}"
    return f"{with_error(value, float(of.stiffness_error))} {of.stiffness.attrs['units']}"


def directions(result: Run) -> list[Literal["x", "y", "torsion"]]:
    """Return the fretting motions that the path drives."""
    motions: list[tuple[Literal["x", "y", "torsion"], tuple[str, str]]] = [
        ("x", ("T_x", "delta_x")),
        ("y", ("T_y", "delta_y")),
        ("torsion", ("M_z", "phi_z")),
    ]
    return [motion for motion, names in motions if any(drives(result, name) for name in names)]
