"""The numbers of the figures of a report: SI prefixes, few digits, no more points than are seen."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import with_error
from pyfret._util.depths import stretched, thin
from pyfret._util.numbers import in_words
from pyfret.report.crack import CrackSection
from pyfret.report.digits import short
from pyfret.run.loops import NO_FRICTION, frictionless
from pyfret.run.summary import directions
from pyfret.subsurface.contact import stress_below
from pyfret.subsurface.line import fields_on, main_line, main_shear
from pyfret.subsurface.moments import lines_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret.run import Run, State
    from pyfret.wear.result import WearResult

__all__ = ["figures"]

#: Most cells along a side that a map shows: more are not seen.
SIDE = 128
#: Most increments whose fields are shown.
KEPT = 60
#: Most points along a section of stress.
ALONG, DOWN = 160, 120
#: Part of the contact's length, or of the depth, that is shown beside it below the surface.
SIDEWAYS = 0.3
#: Length over depth of a section beyond which equal lengths leave it too low to be read.
FLAT = 3.0
#: Force and shift of the loop, and what they are shown in.
LOOPS = {
    "x": ("T_x", "delta_x", "T<sub>x</sub>", "δ<sub>x</sub> [µm]"),
    "y": ("T_y", "delta_y", "T<sub>y</sub>", "δ<sub>y</sub> [µm]"),
    "torsion": ("M_z", "phi_z", "M<sub>z</sub>", "φ<sub>z</sub> [µrad]"),
}


def chosen(n: int, most: int) -> NDArray[np.int64]:
    """Choose evenly spaced indices, the first and the last among them."""
    return np.unique(np.linspace(0, n - 1, min(n, most)).round().astype(int))


def frame(result: Run, snapshots: list[State]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Columns and rows of cells to show: the box around all contacts with some room."""
    touched = np.logical_or.reduce([at.contact.values.astype(bool) for at in snapshots])
    return window_around(touched.any(axis=1)), window_around(touched.any(axis=0))


def window_around(touched: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return the places of a line that are shown: the contact with some room."""
    inside, n = np.flatnonzero(touched), touched.size
    first, last = (inside[0], inside[-1]) if inside.size else (0, n - 1)
    room = max((last - first + 1) // 12, 1)
    places = np.arange(max(first - room, 0), min(last + room, n - 1) + 1)
    return places[chosen(places.size, SIDE)]


def sticks_of(at: State) -> str:
    """The stick ratio of an increment, or that there is no friction."""
    if frictionless(at.scene):
        return NO_FRICTION
    ratio = float(at.dataset.stick_ratio)
    return "no contact" if math.isnan(ratio) else f"stick ratio {ratio:.3f}"


def increments(result: Run) -> dict[str, Any]:
    """Return pressure, shear and zones of increments with fields, and tractions along the shear."""
    numbers = result.dataset.saved_increment.values
    snapshots = [result.at(int(numbers[k])) for k in chosen(numbers.size, KEPT)]
    columns, rows = frame(result, snapshots)
    line = lines_of(result, numbers, 2)[0]
    on_line = [fields_on(at, line) for at in snapshots]
    # The same component at every increment: the largest at the last.
    component = main_shear(on_line[-1])
    near = window_around(np.logical_or.reduce([state.p.values > 0.0 for state in on_line]))
    force = result.dataset.W.attrs["units"]
    shown = []
    for at, cut in zip(snapshots, on_line, strict=True):
        d = at.dataset
        contact = d.contact.values.astype(bool)
        p = np.where(contact, d.p.values, np.nan)
        q = np.where(contact, np.hypot(d.q_x.values, d.q_y.values), np.nan)
        zone = np.where(contact, np.where(d.stick.values.astype(bool), 2.0, 1.0), np.nan)
        p_line, q_line = (1e-6 * cut[k].values[near] for k in ("p", component))
        profile = {"p": short(p_line), "q": short(q_line)}
        if np.isfinite(at.mu):
            profile["bound"] = short(at.mu * p_line)
        pick = np.ix_(columns, rows)
        shown.append(
            {
                "increment": int(d.increment),
                "says": f"W = {in_words(float(d.W))} {force}, "
                f"T\u2093 = {in_words(float(d.T_x))} {force}, " + sticks_of(at),
                **{
                    name: short(field[pick].T, 3)
                    for name, field in (("p", 1e-6 * p), ("q", 1e-6 * q), ("zone", zone))
                },
                "line": profile,
            }
        )
    x, y = (1e6 * result.dataset[k].values for k in ("x", "y"))
    largest = {
        name: float(
            max(np.nanmax(np.array(profile[name], dtype=float), initial=0) for profile in shown)
        )
        for name in ("p", "q")
    }
    flat = bool(result.scene.grid.plane_strain)
    return {
        "x": short(x[columns]),
        "y": short(y[rows]),
        "shown": shown,
        "largest": largest,
        "flat": flat,
        "line": {
            "s": short(1e6 * on_line[-1][line.axis].values[near]),
            "along": line.axis,
            "component": component,
        },
    }


def loop(result: Run) -> dict[str, Any]:
    """Return force over shift from the end of the first branch, and increments of points."""
    direction = next(iter(directions(result)), "x")
    force, shift, y, x = LOOPS[direction]
    d = result.dataset
    started = int(np.flatnonzero(d.branch_of_increment.values == 0)[-1])
    moved = 1e6 * (d[shift].values - float(d[shift][started]))
    return {
        "x": short(moved[started:], 5),
        "y": short(d[force].values[started:], 5),
        "increment": d.increment.values[started:].astype(int).tolist(),
        "labels": [x, f"{y} [{d[force].attrs['units']}]"],
    }


def stress(result: Run, crack: CrackSection | None = None) -> dict[str, Any] | None:
    """Return the von Mises stress on the section along the shear at the last increment.

    It is the stress of the lower body. With a crack, it lies on the plane of the crack in its body,
    with the crack.
    """
    at = result.at(-1)
    number = 2 if crack is None else int(crack.about["body_number"])
    body = result.scene.body1 if number == 1 else result.scene.body2
    if not bool(at.contact.any()) or not np.isfinite(body.substrate.E):
        return None
    line = main_line(at) if crack is None else crack.line
    shown = {} if line == main_line(at) else line.named()
    below = stress_below(at, **shown, body_number=number)
    largest = below.maximum()
    values = 1e-6 * below.von_mises.values
    z, x = below.von_mises.z.values, below.von_mises[line.axis].values
    assert at.outline is not None
    ends = line.place(*at.outline.centre) + np.array(at.outline.border(line.angle))
    room = SIDEWAYS * max(np.ptp(ends), z[-1])
    near = np.flatnonzero((x >= ends[0] - room) & (x <= ends[1] + room))
    depths, along = chosen(z.size, DOWN), near[chosen(near.size, ALONG)]
    interfaces = np.cumsum([layer.thickness for layer in body.coatings])
    borders = 1e6 * np.array([z[0], *interfaces, z[-1]])
    flat = np.ptp(x[along]) > FLAT * np.ptp(z)
    stretch = thin(borders)

    def place(depth: NDArray[np.float64]) -> list[float]:
        """Return the drawn position of a depth [um]; thin layers get more room."""
        drawn = np.interp(depth, borders, stretched(borders)) if stretch else depth
        return [float(position) for position in np.atleast_1d(drawn)]

    ticks = [*borders[:-1], (borders[-2] + borders[-1]) / 2, borders[-1]]
    return {
        "x": short(1e6 * x[along]),
        "z": short(1e6 * z[depths]),
        "place": place(1e6 * z[depths]),
        "ticks": [place(np.array(ticks)), [in_words(tick, 3) for tick in ticks]]
        if stretch
        else None,
        "equal": not (stretch or flat),
        "values": short(values[np.ix_(depths, along)], 3),
        "interfaces": place(borders[1:-1]),
        "along": line.axis,
        "plane": "shear through the middle of the contact" if crack is None else "crack",
        "largest": {
            "value": with_error(1e-6 * largest.value, 1e-6 * largest.error),
            "at": [1e6 * largest.x, 1e6 * largest.y, 1e6 * largest.z],
        },
        "mark": [1e6 * line.place(largest.x, largest.y), *place(np.array([1e6 * largest.z]))],
        "body": "upper" if number == 1 else "lower",
        "crack": None if crack is None else crack.drawn(1e6 * z[-1], place),
    }


def wear(worn: WearResult) -> dict[str, Any]:
    """Return depths over cycles, and worn profiles with the third body at the end."""
    d = worn.dataset
    cut, direction = worn.along(), worn.direction
    along = str(cut.worn2.dims[-1])
    return {
        "cycles": short(d.cycles.values, 6),
        "depth": [short(1e6 * d[f"depth{n}"].values) for n in (1, 2)],
        "along": along,
        "x": short(1e6 * cut[along].values),
        "profile": [short(1e6 * cut[f"worn{n}"][-1].values) for n in (1, 2)],
        "third": third_body(worn),
        "loops": [
            {
                "name": f"after {in_words(float(d.block_cycles[block]))} cycles",
                "x": short(1e6 * closed(d[f"loop_delta_{direction}"][block].values), 5),
                "y": short(closed(d[f"loop_T_{direction}"][block].values), 5),
            }
            for block in (0, -1)
        ],
        "labels": [LOOPS[direction][3], f"{LOOPS[direction][2]} [{d.loop_T_x.attrs['units']}]"],
    }


def third_body(worn: WearResult) -> list[dict[str, Any]]:
    """Return lines of the debris bed [um] and of the aerated share that the run computes."""
    cut = worn.along().isel(block=-1)
    names = {"bed": "debris", "air": "aerated share [1]"}
    fields = {"bed": 1e6 * cut.bed.values, "air": np.where(cut.p > 0.0, cut.aerated, 0.0)}
    return [
        {"name": name, "y": short(fields[key])} for key, name in names.items() if key in worn.table
    ]


def closed(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """The corners of a loop, the last one before the first."""
    return np.concatenate((corners[-1:], corners))


def figures(
    result: Run, worn: WearResult | None = None, crack: CrackSection | None = None
) -> dict[str, Any]:
    """Return all numbers of the figures of a page."""
    return {
        "fields": increments(result),
        "loop": loop(result),
        "stress": stress(result, crack),
        "crack": None if crack is None else crack.numbers(),
        "wear": None if worn is None else wear(worn),
    }
