"""Calls that describe a contact, or solve one."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from values import COATED, GRID, PATH, STEEL, TOML, WIDE, Call, scene

import pyfret as fret
from pyfret import kernels

ROUGH = {"rms": 1e-8, "hurst": 0.8, "longest": 2e-4, "shortest": 1.5e-4, "seed": 1}
FOLDER = Path(tempfile.mkdtemp(prefix="hostile-"))


def used(path: fret.LoadPath) -> object:
    """Looks at all of a path."""
    return len(path), repr(path), path.t, path.W, path.branches


def checked(path: fret.LoadPath) -> None:
    """Checks a scene that has the path."""
    scene(path=path).check()


def marched(of: fret.Scene) -> None:
    """Solves the first increment."""
    next(iter(fret.march(of)))


def shaped(shape: Any) -> None:
    """Solves the first increment of a scene whose upper body has the shape."""
    marched(scene(body1=fret.Body(STEEL, shape=shape)))


def rough_friction(**law: Any) -> None:
    """Solves the first increments of a scene with the law."""
    for _ in fret.march(scene(friction=fret.Friction(**law))):
        pass


def with_settings(**settings: Any) -> None:
    """Solves a scene with the settings."""
    fret.solve(scene(settings=fret.Settings(**settings)), progress=False)


def on_grid(grid: fret.Grid) -> None:
    """Checks a scene on the grid."""
    scene(grid=grid).check()


def with_body(body: fret.Body) -> None:
    """Solves the first increment against the body."""
    marched(scene(body2=body))


def _graded(**changed: Any) -> None:
    """The layers of a graded coating."""
    options = {"E": fret.Profile.linear(top=1e9, bottom=2e9), "nu": fret.Profile.constant(0.3)}
    coatings = fret.graded(**options | {"thickness": 1e-5, "layers": 4} | changed)
    kernels.influence_coefficients(fret.Body(STEEL, coatings=coatings), GRID)


CALLS: list[Call] = [
    ("Elastic", fret.Elastic, {"E": 1e9, "nu": 0.3}),
    (
        "Coating",
        lambda h: with_body(fret.Body(STEEL, coatings=[fret.Coating(STEEL, thickness=h)])),
        {"0": 1e-5},
    ),
    ("coated bodies", with_body, {"0": COATED}),
    ("grids", on_grid, {"0": WIDE}),
    (
        "Profile.linear",
        lambda a, b: _graded(E=fret.Profile.linear(top=a, bottom=b)),
        {"0": 1e9, "1": 2e9},
    ),
    (
        "Profile.power",
        lambda a, e: _graded(E=fret.Profile.power(top=a, bottom=2e9, exponent=e)),
        {"0": 1e9, "1": 2.0},
    ),
    (
        "Profile.exponential",
        lambda a, b: _graded(E=fret.Profile.exponential(top=a, bottom=b)),
        {"0": 1e9, "1": 2e9},
    ),
    ("Profile.table", lambda t: _graded(E=fret.Profile.table(t)), {"0": [(0.0, 1e9), (1.0, 2e9)]}),
    ("Profile.constant", lambda v: _graded(nu=fret.Profile.constant(v)), {"0": 0.3}),
    ("graded", lambda **k: _graded(**k), {"thickness": 1e-5, "layers": 4}),
    ("Sphere", lambda **k: shaped(fret.Sphere(**k)), {"R": 0.01}),
    (
        "Ellipsoid",
        lambda **k: shaped(fret.shapes.Ellipsoid(**k)),
        {"R_x": 0.01, "R_y": 0.02, "angle": 0.1},
    ),
    ("Cylinder", lambda **k: shaped(fret.Cylinder(**k)), {"R": 0.01, "length": 1e-4, "angle": 0.1}),
    (
        "CrownedRoller",
        lambda **k: shaped(fret.shapes.CrownedRoller(**k)),
        {"R": 0.01, "length": 1e-4, "crown": 0.01, "angle": 0.1},
    ),
    ("Cone", lambda **k: shaped(fret.shapes.Cone(**k)), {"slope": 0.01}),
    (
        "Wedge",
        lambda **k: shaped(fret.shapes.Wedge(**k) + fret.Sphere(R=0.01)),
        {"slope": 0.01, "angle": 0.1},
    ),
    ("FlatPunch", lambda **k: shaped(fret.shapes.FlatPunch(**k)), {"radius": 1e-4, "edge": 0.01}),
    ("Ring", lambda **k: shaped(fret.shapes.Ring(**k)), {"radius": 1e-4, "R": 0.01}),
    (
        "Ridges",
        lambda **k: shaped(fret.shapes.Ridges(**k) + fret.Sphere(R=0.01)),
        {"R": 0.01, "spacing": 1e-4, "count": 3.0, "angle": 0.1},
    ),
    (
        "Waviness",
        lambda **k: shaped(fret.shapes.Waviness(**k) + fret.Sphere(R=0.01)),
        {"amplitude": 1e-8, "wavelength": 1e-4, "angle": 0.1, "phase": 0.1},
    ),
    ("Rough", lambda **k: shaped(fret.shapes.Rough(**k) + fret.Sphere(R=0.01)), ROUGH),
    (
        "SurfaceMap",
        lambda v, spacing: shaped(fret.SurfaceMap(v, spacing=spacing) + fret.Sphere(R=0.01)),
        {"0": np.zeros((20, 20)), "spacing": (1e-4, 1e-4)},
    ),
    ("Friction", rough_friction, {"mu": 0.3, "mu_y": 0.4, "kinetic": 0.2}),
    (
        "Friction.map",
        lambda v, spacing: rough_friction(mu=0.3, map=fret.SurfaceMap(v, spacing=spacing)),
        {"0": np.ones((20, 20)), "spacing": (1e-4, 1e-4)},
    ),
    (
        "Friction.history",
        lambda t: rough_friction(mu=0.3, history=(fret.History.SLIP, t)),
        {"0": [(0.0, 1.0)]},
    ),
    ("Grid.centred", fret.Grid.centred, {"width": 1e-3, "n": 8}),
    ("Grid.from_spacing", fret.Grid.from_spacing, {"0": (8, 8), "1": (1e-5, 1e-5)}),
    ("Grid.strip", fret.Grid.strip, {"extent": 1e-3, "n": 8, "width": 1.0}),
    ("LoadPath.normal", lambda W, n: checked(PATH.normal(W, increments=n)), {"0": 1.0, "1": 2}),
    (
        "LoadPath.normal, looked at",
        lambda W, n: used(PATH.normal(W, increments=n)),
        {"0": 1.0, "1": 2},
    ),
    (
        "LoadPath.tangential",
        lambda T, n: checked(PATH.tangential(T, increments=n)),
        {"0": [1.0], "1": 2},
    ),
    ("LoadPath.torsion", lambda M, n: checked(PATH.torsion(M, increments=n)), {"0": [1.0], "1": 2}),
    ("LoadPath.radial", lambda W, n: checked(PATH.radial(W, increments=n)), {"0": [1.0], "1": 2}),
    (
        "LoadPath.ellipse",
        lambda **k: used(PATH.ellipse(**k)),
        {"T_x": 1.0, "T_y": 1.0, "turns": 1, "increments": 4},
    ),
    (
        "LoadPath.waypoints",
        lambda n, **k: checked(PATH.waypoints(increments=n, **k)),
        {"0": 2, "W": [1.0], "t": [3.0]},
    ),
    (
        "PerRange",
        lambda n: checked(PATH.waypoints(increments=fret.PerRange(n), T_x=[1.0, 2.0])),
        {"0": 2},
    ),
    (
        "LoadPath.force",
        lambda **k: checked(PATH.force(**k)),
        {
            "W": 1.0,
            "T_x": 0.1,
            "T_y": 0.1,
            "M_x": 1e-9,
            "M_z": 1e-9,
            "sigma_B": 1.0,
            "sigma_B1": 1.0,
            "rolled": 8e-4 / 6,
            "increments": 2,
            "t": 9.0,
        },
    ),
    (
        "LoadPath.displace",
        lambda **k: checked(PATH.displace(**k)),
        {
            "delta_z": 1e-6,
            "delta_x": 1e-7,
            "delta_y": 1e-7,
            "phi_x": 1e-9,
            "phi_y": 1e-9,
            "phi_z": 1e-9,
            "increments": 2,
            "t": 9.0,
        },
    ),
    ("LoadPath, solved", lambda path: marched(scene(path=path)), {"0": PATH}),
    (
        "InverseFft",
        lambda **k: marched(
            scene(body2=COATED, settings=fret.Settings(kernel=fret.settings.InverseFft(**k)))
        ),
        {"enlargement": 2, "aliases": 1},
    ),
    (
        "FrequencyDomain",
        lambda **k: marched(
            scene(settings=fret.Settings(kernel=fret.settings.FrequencyDomain(**k)))
        ),
        {"enlargement": 2},
    ),
    (
        "Settings",
        with_settings,
        {
            "tolerance": 1e-4,
            "path_tolerance": 0.1,
            "max_alternations": 60,
            "max_iterations": 1000,
            "kernel_tolerance": 1e-6,
            "save": [1],
        },
    ),
    ("Scene.replace", lambda save: scene().replace(save=save).check(), {"0": [1]}),
    (
        "Scene.from_toml",
        lambda text, set: fret.Scene.from_toml(text, set=set),
        {"0": TOML, "1": ["friction.mu=0.2"]},
    ),
    (
        "solve",
        lambda **k: fret.solve(scene(), progress=False, **k),
        {"checkpoint": 1.0, "save": [1]},
    ),
    (
        "solve, stored",
        lambda checkpoint: fret.solve(
            scene(),
            out=Path(tempfile.mkdtemp(dir=FOLDER)) / "a.zarr",
            progress=False,
            checkpoint=checkpoint,
        ),
        {"0": 1.0},
    ),
]
