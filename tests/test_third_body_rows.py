"""Rigid bodies with oxygen, debris and layers against closed forms: rows of crates/debris."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret

pytestmark = [
    pytest.mark.solves,
    pytest.mark.filterwarnings("ignore::pyfret.errors.SceneWarning"),
]

ROWS = json.loads(
    (Path(__file__).parents[1] / "crates/debris/tests/data/rows.json").read_text(encoding="utf-8")
)
#: Difference from the closed form, over it.
WITHIN = 5e-3
MU, STROKE = 0.5, 2e-6


def slides(W: float, stroke: float = STROKE) -> fret.LoadPath:
    """Press and slide to and fro; the stroke is one place."""
    path = fret.LoadPath.start().normal(W, increments=1)
    for to in (stroke, -stroke, stroke):
        path = path.displace(delta_x=to, increments=1)
    return path


def wear(scene: fret.Scene, **settings: Any) -> fret.wear.WearResult:
    """Wear the scene."""
    return fret.wear.solve(scene, progress=False, **settings)


@pytest.mark.parametrize(("name", "n"), [("strip_pad", 640), ("disc_pad", 512)])
def test_a_worn_pad_recedes_evenly_with_its_core(name: str, n: int) -> None:
    row = ROWS[name]
    get, exact = row["input"], row["output"]
    b, is_strip = get["b"], name == "strip_pad"
    if is_strip:
        grid = fret.Grid.strip(extent=2.4 * b, n=n)
    else:
        grid = fret.Grid.centred(width=2.4 * b, n=n)
    x = (np.arange(n) - 0.5 * (n - 1)) * grid.dx
    # A map has two lines at least.
    inside = np.repeat(abs(x)[:, None] < b, 2, axis=1) if is_strip else np.hypot(x, x[:, None]) < b
    pad = fret.SurfaceMap(np.where(inside, 0.0, -1e-3), spacing=(grid.dx, grid.dy))
    scene = fret.Scene(
        body1=fret.Body(fret.Elastic(E=1e12, nu=0.3), shape=pad),
        body2=fret.Body(fret.Elastic(E=1e12, nu=0.3)),
        friction=MU,
        grid=grid,
        path=slides(get["W"]),
    )
    times = get["Eperp"] / (4 * MU * STROKE)
    air = fret.wear.Air(
        distance=get["lref"] * math.log(2 * 21278.0 / 0.1),
        power_density=get["phiref"],
        power_exponent=get["m"],
    )
    law = fret.wear.DissipatedEnergy(times * get["aab"], starved=times * get["aad"])
    worn = wear(
        scene,
        cycles=2000,
        body1=law,
        cycling="sliding",
        air=air,
        frequency=get["f"] * times,
        jumps=6,
    )
    cells = inside[:, :1] if is_strip else inside
    starved = float(np.where(cells, 1 - np.asarray(worn.aerated[-1]), 0.0).sum())
    core = 0.5 * starved * grid.dx if is_strip else math.sqrt(starved / math.pi) * grid.dx
    assert core == pytest.approx(exact["core"], rel=WITHIN)
    lost, cycles = worn.volume1.values, worn.cycles.values
    area = 2 * b if is_strip else math.pi * b**2
    rate = (lost[-1] - lost[-2]) / (cycles[-1] - cycles[-2]) / area
    assert rate == pytest.approx(exact["recession"], rel=WITHIN)


@pytest.mark.parametrize(
    ("most", "extent", "n"), [(4, 9e-4, 112), pytest.param(5, 2.4e-3, 320, marks=pytest.mark.slow)]
)
def test_friction_follows_a_film_that_is_worn_through(most: int, extent: float, n: int) -> None:
    """Up to some of the half-widths of the row: the widest takes a wide grid and many jumps."""
    row = ROWS["worn_through_slippery"]
    get, exact = row["input"], row["output"]
    half_widths, ends_at = get["half_width"][:most], exact["cycles"][:most]
    stiff = fret.Elastic(E=1e13, nu=0.3)
    laws = [fret.wear.DissipatedEnergy(get[key]) for key in ("ac", "as_")]
    scene = fret.Scene(
        body1=fret.Body(stiff, shape=fret.Cylinder(R=get["R"])),
        body2=fret.Body(stiff, coatings=fret.Coating(stiff, thickness=get["t"])),
        friction=fret.Friction(layers=[exact["mu_of_contact"][0], get["mus"]]),
        grid=fret.Grid.strip(extent=extent, n=n),
        path=slides(get["W"], get["delta"]),
    )
    worn = wear(
        scene,
        cycles=1.06 * ends_at[-1],
        body2=laws,
        cycling="sliding",
        worn_through="go_on",
        # The mean friction of a jump has the error of its length: 1 % with 3e-3.
        tolerance=1e-3,
    )
    through = worn.cycles_to(part_of_coating=1.0)
    assert through == pytest.approx(exact["worn_through_at"], rel=WITHIN)
    ends, length, mu = (worn.dataset[name].values for name in ("cycles", "length", "mu"))
    for half_width, N, mu_of_contact in zip(
        half_widths, ends_at, exact["mu_of_contact"][:most], strict=True
    ):
        cycles = worn.cycles_to(depth=half_width**2 / (2 * get["R"]))
        assert cycles == pytest.approx(N, rel=WITHIN)
        # Single jumps scatter by the cells that pass from film to substrate.
        # Friction rises with a root where the film is worn through: no mean over both sides.
        last = 1.05 * N if 1.01 * exact["worn_through_at"] < N else N
        near = (ends > 0.95 * N) & (ends - length < last)
        mean = np.average(mu[near], weights=length[near])
        assert mean == pytest.approx(mu_of_contact, rel=WITHIN)
