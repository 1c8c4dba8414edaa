"""Scenes and all their parts are values: pickled, copied, and given with something exchanged."""

from __future__ import annotations

import copy
import math
import pickle
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from conftest import ROOT, paper_path, sphere_on_flat

MAP = fret.SurfaceMap(np.arange(12.0).reshape(3, 4) * 1e-8, spacing=(1e-6, 2e-6))
STEEL = fret.Elastic(E=210e9, nu=0.3)
LAW = fret.Friction(
    0.3, mu_y=0.2, kinetic=0.25, map=MAP, history=(fret.History.SLIP, [(0.0, 1.0), (1e-5, 2.0)])
)
PATH = (
    fret.LoadPath.start()
    .normal(1e3)
    .displace(delta_x=[1e-7, -1e-7])
    .force(sigma_B=1e8, M_z=0.1, increments=7)
    .cycles(1, T_x=30.0, increments=4)
)
BODY = fret.Body(
    STEEL, coatings=[fret.Coating(STEEL, thickness=1e-5)], shape=fret.Sphere(1.0) + MAP
)
SETTINGS = fret.Settings(
    preset=fret.settings.Preset.SPINU2020,
    tolerance=1e-7,
    kernel=fret.settings.InverseFft(enlargement=4, aliases=1),
    skip=fret.settings.Skip(mirror=False),
    save=[3, 4],
)

#: A value of every public class of a scene, and something of it to exchange.
PARTS: list[tuple[Any, dict[str, Any]]] = [
    (STEEL, {"nu": 0.2}),
    (fret.RIGID, {}),
    (fret.Coating(STEEL, thickness=1e-6), {"thickness": 2e-6}),
    (fret.Bond(normal=1e-17), {"shear": 1e-16}),
    (fret.shapes.Flat(), {}),
    (fret.Sphere(0.01), {"R": 0.02}),
    (fret.shapes.Ellipsoid(R_x=0.1, R_y=0.2, angle=0.3), {"angle": 0.4}),
    (fret.Cylinder(R=0.1), {"length": 1e-3}),
    (fret.shapes.CrownedRoller(R=0.1, length=1e-3, crown=1.0), {"crown": 2.0}),
    (fret.shapes.Cone(slope=0.01), {"slope": 0.02}),
    (fret.shapes.Wedge(slope=0.01), {"angle": 0.1}),
    (fret.shapes.FlatPunch(radius=1e-3, edge=1e-4), {"edge": 2e-4}),
    (fret.shapes.Ring(radius=1e-3, R=1e-2), {"R": 2e-2}),
    (fret.shapes.Ridges(R=1e-2, spacing=1e-4), {"count": 3.0}),
    (fret.shapes.Waviness(amplitude=1e-7, wavelength=1e-5), {"phase": 1.0}),
    (fret.shapes.Rough(rms=1e-7, hurst=0.8, longest=1e-4, shortest=1e-5, seed=3), {"seed": 4}),
    (MAP, {"spacing": (3e-6, 3e-6)}),
    (fret.Sphere(1.0) + MAP, {"parts": [fret.Sphere(2.0), MAP]}),
    (BODY, {"substrate": fret.RIGID, "coatings": []}),
    (LAW, {"kinetic": None}),
    (fret.Friction(math.inf), {"mu": 0.1}),
    (fret.Grid.centred(width=1e-3, n=33), {"nx": 40}),
    (fret.Grid.strip(extent=1e-3, n=37, width=0.3), {"nx": 40}),
    (PATH, {"branches": PATH.branches[:2]}),
    (fret.LoadPath.start().normal(5.0).hold(increments=2), {"branches": []}),
    (PATH.branches[2], {"increments": 3}),
    (fret.PerRange(40), {"increments": 20}),
    (SETTINGS, {"save": "all"}),
    (fret.Plastic(s_y=1e9, hardening=2e9), {"s_y": 2e9}),
    (fret.settings.Skip(contact_window=False), {"contact_window": True}),
    (fret.settings.Hankel(), {}),
    (fret.settings.InverseFft(enlargement=4), {"aliases": 2}),
    (fret.settings.FrequencyDomain(enlargement=4), {"enlargement": 5}),
    (fret.wear.Archard(1e-14, threshold=1e-9), {"k": 2e-14}),
    (fret.wear.DissipatedEnergy(1e-14), {"threshold": 1.0}),
    (fret.wear.Archard(1e-14, factor=("cycles", [(0.0, 1.0), (9.0, 2.0)])), {"factor": None}),
    (fret.wear.Air(distance=1e-3, power_density=1e4), {"threshold": 1.0}),
    (fret.wear.DebrisBed(kappa=1e-3), {"volume_ratio": 2.0}),
    (fret.wear.Wear(1e4, body2=fret.wear.Archard(1e-14)), {"cycles": 2e4}),
    (
        fret.Scene(
            body1=BODY,
            body2=fret.Body(STEEL),
            friction=LAW,
            grid=fret.Grid.centred(width=1.0, n=8),
            path=PATH,
            settings=SETTINGS,
            title="all",
        ),
        {"title": "other", "grid": fret.Grid.centred(width=1.0, n=9), "body2": BODY},
    ),
]


@pytest.mark.parametrize(("part", "changes"), PARTS, ids=lambda v: type(v).__name__)
def test_a_part_is_pickled_copied_and_exchanged(part: Any, changes: dict[str, Any]) -> None:
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(part, protocol)) == part
    assert copy.copy(part) == part
    assert copy.deepcopy([part, part]) == [part, part]
    alternative = part.replace(**changes)
    assert type(alternative) is type(part)
    assert (alternative == part) == (not changes)
    assert part.__replace__(**changes) == alternative
    if hasattr(copy, "replace"):
        assert copy.replace(part, **changes) == alternative


@pytest.mark.parametrize(
    "part", [p for p, changes in PARTS if changes], ids=lambda v: type(v).__name__
)
def test_a_part_that_does_not_exist_is_refused(part: Any) -> None:
    with pytest.raises(TypeError, match="nonsense"):
        part.replace(nonsense=1.0)


@pytest.mark.parametrize("kind", [fret.settings.Preset, fret.Spacing, fret.History])
def test_members_of_enumerations_are_pickled(kind: Any) -> None:
    for name in (n for n in dir(kind) if n.isupper()):
        member = getattr(kind, name)
        assert pickle.loads(pickle.dumps(member)) == member == copy.deepcopy(member)


def test_all_classes_of_a_scene_are_here() -> None:
    local = {type(part).__name__ for part, _ in PARTS} | {"Preset", "Spacing", "History"}
    elsewhere = {"Profile", "SurfaceOperator"}
    modules = (fret, fret.shapes, fret.settings, fret.wear)
    made = {n for module in modules for n in module.__all__ if isinstance(getattr(module, n), type)}
    of_data = {n for item in (fret.settings, fret.wear) for n in item.__all__ if n != "WearResult"}
    made |= {"Branch", "PerRange", "Spacing"}  # Parts of a load path that its methods make.
    parts = {n for n in made if hasattr(fret._core, n) or n in of_data}
    assert parts == local | elsewhere


@pytest.mark.parametrize("scene", sorted((ROOT / "scenes").glob("*.toml")), ids=lambda p: p.stem)
def test_a_scene_of_a_file_is_the_same_after_a_journey(scene: Any) -> None:
    there = fret.Scene.from_file(scene)
    back = pickle.loads(pickle.dumps(there))
    assert back == there
    assert back.to_toml() == there.to_toml()


def test_a_result_is_pickled_and_copied() -> None:
    path = paper_path(indentation=2, cycles=9)
    result = fret.solve(sphere_on_flat(n=16), path, progress=False)
    for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
        assert again.dataset.identical(result.dataset)
        assert again.scene == result.scene
    at = copy.copy(result.at(-1))
    assert at.dataset.identical(result.at(-1).dataset)
