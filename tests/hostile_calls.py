"""Calls every public function and constructor with hostile values; run by ``test_hostile.py``.

``python hostile_calls.py START`` makes the calls from number START on, one line before and one
after each, under a limit of memory. Whoever reads along knows which call ended the process.
"""

from __future__ import annotations

import resource
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import pyfret as fret
from pyfret import _core, kernels, reference, subsurface

#: Address space beyond what is taken after the imports [bytes].
MEMORY = 3 << 30
#: What may be raised, apart from the package's own errors.
ALLOWED = (ValueError, TypeError, OverflowError, KeyError, MemoryError, OSError)
OWN = (fret.NoConvergenceError, fret.SlidingError, fret.KernelInaccurateError)

NAN, INF = float("nan"), float("inf")
FLOATS = [NAN, INF, -INF, 0.0, -1.0, 1e300, -1e300, 1e-300, 1e9, 1e30]
INTS = [0, -1, 1, 10**9, 2**31, 2**62, 2**63, 2**64]

STEEL = fret.Elastic(E=210e9, nu=0.3)
ALUMINIUM = fret.Elastic(E=70e9, nu=0.3)
PAIR = (STEEL, ALUMINIUM)
GRID = fret.Grid.from_spacing((6, 5), (1e-5, 2e-5))
WIDE = fret.Grid.from_spacing((6, 5), (2e-4, 2e-4))
COATED = fret.Body(STEEL, coatings=[fret.Coating(ALUMINIUM, thickness=3e-5)])
HERTZ = reference.hertz(R=0.01, bodies=PAIR, W=100.0)
TORN = np.zeros((12, 5))[::2]
FIELD = np.full((6, 5), 1e6)
STICK = np.zeros((6, 5), bool)
PATH = fret.LoadPath.start().normal(100.0, increments=2).tangential(0.2, increments=1)
SCENE = {
    "body1": fret.Body(STEEL, shape=fret.Sphere(R=0.01)),
    "body2": fret.Body(ALUMINIUM),
    "mu": 0.3,
    "grid": fret.Grid.centred(extent=8e-4, n=12),
    "path": PATH,
}
TOML = fret.Scene(**SCENE).to_toml()


def scene(**changed: Any) -> fret.Scene:
    """A small contact with some of it changed."""
    return fret.Scene(**SCENE | changed)


def tried(make: Callable[[], Any]) -> list[Any]:
    """What `make` gives, if it gives anything."""
    try:
        return [make()]
    except (*ALLOWED, *OWN):
        return []


def objects_like(value: Any) -> list[Any]:
    """Hostile objects of the type of `value` that can be had."""
    if isinstance(value, fret.Elastic):
        every = [tried(lambda E=E: fret.Elastic(E=E, nu=0.3)) for E in FLOATS]
        every += [tried(lambda nu=nu: fret.Elastic(E=1e9, nu=nu)) for nu in (0.5 - 1e-16, NAN)]
        return [*(found for some in every for found in some), fret.RIGID]
    if isinstance(value, fret.Coating):
        layers = [lambda h=h: fret.Coating(STEEL, thickness=h) for h in [*FLOATS, 1e-200, 1e-12]]
        layers += [lambda m=m: fret.Coating(m, thickness=1e-5) for m in objects_like(STEEL)]
        return [found for make in layers for found in tried(make)]
    if isinstance(value, fret.Body):
        coats = objects_like(COATED.coatings[0])
        bodies = [lambda m=m: fret.Body(m) for m in objects_like(STEEL)]
        bodies += [lambda c=c: fret.Body(STEEL, coatings=[c]) for c in coats]
        bodies += [lambda: fret.Body(fret.RIGID, coatings=COATED.coatings)]
        bodies += [lambda: fret.Body(STEEL, coatings=COATED.coatings * 50)]
        return [found for make in bodies for found in tried(make)]
    if isinstance(value, fret.Grid):
        n, d = (6, 5), (1e-5, 2e-5)
        grids = [lambda x=x: fret.Grid.from_spacing(n, (x, 1e-5)) for x in [*FLOATS, 1e-200]]
        grids += [lambda x=x: fret.Grid.from_spacing(n, (x, x)) for x in [*FLOATS, 1e-200]]
        grids += [lambda k=k: fret.Grid.from_spacing((k, 1), d) for k in INTS]
        grids += [lambda: fret.Grid.from_spacing((1 << 14, 1 << 14), d)]
        grids += [lambda: fret.Grid.strip(extent=1e-3, n=6)]
        return [found for make in grids for found in tried(make)]
    if isinstance(value, fret.LoadPath):
        loads = [lambda v=v: PATH.normal(v, increments=1) for v in FLOATS]
        loads += [lambda v=v: PATH.torsion(v, increments=1) for v in FLOATS]
        loads += [lambda v=v: PATH.displace(phi_x=v, increments=1) for v in FLOATS]
        loads += [lambda: fret.LoadPath.start(), lambda: PATH.normal(1.0, increments=0)]
        return [found for make in loads for found in tried(make)]
    return []


def hostile(value: Any) -> list[Any]:
    """Values of the type of `value` that should be refused, or bring no harm."""
    if isinstance(value, bool):
        return []
    if isinstance(value, float):
        return [*FLOATS, 2**63, None, "x"]
    if isinstance(value, int):
        return [*INTS, 0.5]
    if isinstance(value, np.ndarray):
        others = [np.full(value.shape, v) for v in FLOATS] if value.dtype.kind == "f" else []
        shapes = [(0,), (), (1,), (0, 5), (6, 0), (5, 6), (6, 5, 1)]
        others += [np.zeros(shape, value.dtype) for shape in shapes]
        torn = np.zeros((2 * value.shape[0], *value.shape[1:]), value.dtype)[::2]
        return [*others, torn, np.asfortranarray(value), value.astype(object), value.astype("i4")]
    if isinstance(value, tuple):
        parts = [
            (*value[:i], other, *value[i + 1 :])
            for i, part in enumerate(value)
            for other in hostile(part)
        ]
        return [*parts, (), value * 2]
    if isinstance(value, list):
        parts = [[other] for part in value[:1] for other in hostile(part)]
        return [*parts, [], value * 300]
    if isinstance(value, str):
        return ["", "x", "\0", "é" * 5000]
    return objects_like(value)


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
    for _ in fret.march(scene(mu=fret.Friction(**law))):
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


def convert(enlargement: int = 2, aliases: int = 0, grid: fret.Grid = GRID) -> object:
    """The paper's conversion of a half-space's response."""
    body = fret.Body(STEEL)
    response = lambda x, y: kernels.surface_frf(body, x, y)  # noqa: E731
    return kernels.convert(response, grid, enlargement=enlargement, aliases=aliases)


def below(**loads: Any) -> _core.Subsurface:
    """The tractions on a coated body."""
    return _core.Subsurface(COATED, GRID, **loads)


def enveloped(**changed: Any) -> object:
    """The envelope of one increment."""
    of = {"p": FIELD, "q_x": FIELD, "q_y": FIELD, "stick": STICK, "sigma_B": 0.0}
    made = _core.Envelope(COATED, GRID, PATH, [0.0, 1e-5], [0, 0], of=["von_mises"], y=0.0)
    number, branch = changed.pop("increment", 1), changed.pop("branch", 0)
    made.push(number, branch, **of | changed)
    return made.finish()


MINDLIN = reference.CattaneoMindlin(HERTZ, bodies=PAIR, mu=0.3)
LUBKIN = reference.Lubkin(HERTZ, bodies=PAIR, mu=0.3)
LINE = reference.line_contact(R=0.01, bodies=PAIR, W=1e5)
HAMILTON = reference.HertzStress(a=1e-4, nu=0.3)
COATING = COATED.coatings[0]
INDENTED = reference.coated_indentation(
    R=0.01, indenter=STEEL, coating=fret.Coating(STEEL, thickness=1e-4), substrate=STEEL, W=10.0
)
ARRAY = np.linspace(0, 2e-4, 5)
INSIDE = np.linspace(0.1, 1.0, 5) * HERTZ.a
ROUGH = {"rms": 1e-8, "hurst": 0.8, "longest": 2e-4, "shortest": 1.5e-4, "seed": 1}
OPERATOR = fret.SurfaceOperator(COATED, COATED, GRID)
TENSORS = np.linspace(-1, 1, 30).reshape(6, 5)
FOLDER = Path(tempfile.mkdtemp(prefix="hostile-"))


def springs(**changed: Any) -> object:
    """Springs, loaded."""
    made = {"R": 0.01, "bodies": PAIR, "mu": 0.3, "n": 10} | changed
    load = {"W": 50.0, "T": 5.0, "steps": 3}
    load |= {key: made.pop(key) for key in load if key in made}
    return reference.Springs(HERTZ, **made).load(**load)


Call = tuple[str, Callable[..., Any], dict[str, Any]]

#: Name, function, good arguments; those whose names are numbers go by position.
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
        lambda **k: shaped(fret.Ellipsoid(**k)),
        {"R_x": 0.01, "R_y": 0.02, "angle": 0.1},
    ),
    ("Cylinder", lambda **k: shaped(fret.Cylinder(**k)), {"R": 0.01, "length": 1e-4, "angle": 0.1}),
    (
        "CrownedRoller",
        lambda **k: shaped(fret.CrownedRoller(**k)),
        {"R": 0.01, "length": 1e-4, "crown": 0.01, "angle": 0.1},
    ),
    ("Cone", lambda **k: shaped(fret.Cone(**k)), {"slope": 0.01}),
    (
        "Wedge",
        lambda **k: shaped(fret.Wedge(**k) + fret.Sphere(R=0.01)),
        {"slope": 0.01, "angle": 0.1},
    ),
    ("FlatPunch", lambda **k: shaped(fret.FlatPunch(**k)), {"radius": 1e-4, "edge": 0.01}),
    (
        "Waviness",
        lambda **k: shaped(fret.Waviness(**k) + fret.Sphere(R=0.01)),
        {"amplitude": 1e-8, "wavelength": 1e-4, "angle": 0.1, "phase": 0.1},
    ),
    ("Rough", lambda **k: shaped(fret.Rough(**k) + fret.Sphere(R=0.01)), ROUGH),
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
    ("Grid.centred", fret.Grid.centred, {"extent": 1e-3, "n": 8}),
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
            scene(body2=COATED, settings=fret.Settings(kernel=fret.InverseFft(**k)))
        ),
        {"enlargement": 2, "aliases": 1},
    ),
    (
        "FrequencyDomain",
        lambda **k: marched(scene(settings=fret.Settings(kernel=fret.FrequencyDomain(**k)))),
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
    ("hertz", reference.hertz, {"R": 0.01, "bodies": PAIR, "W": 10.0}),
    ("Hertz.p", HERTZ.p, {"0": ARRAY}),
    (
        "hertz_ellipse",
        reference.hertz_ellipse,
        {"R_x": 0.01, "R_y": 0.02, "E_star": 1e11, "W": 10.0},
    ),
    (
        "CattaneoMindlin",
        lambda **k: reference.CattaneoMindlin(HERTZ, **k).T_limit,
        {"bodies": PAIR, "mu": 0.3},
    ),
    ("stick_radius", MINDLIN.stick_radius, {"0": 5.0}),
    ("stick_radius_reversed", MINDLIN.stick_radius_reversed, {"0": 5.0, "T_m": 6.0}),
    ("q_loading", MINDLIN.q_loading, {"0": ARRAY, "T": 5.0}),
    ("q_unloading", MINDLIN.q_unloading, {"0": ARRAY, "T": 5.0, "T_m": 6.0}),
    ("q_reloading", MINDLIN.q_reloading, {"0": ARRAY, "T": 5.0, "T_m": 6.0}),
    ("shift_loading", MINDLIN.shift_loading, {"0": ARRAY}),
    ("shift_unloading", MINDLIN.shift_unloading, {"0": ARRAY, "T_m": 6.0}),
    ("shift_reloading", MINDLIN.shift_reloading, {"0": ARRAY, "T_m": 6.0}),
    ("loop_energy", MINDLIN.loop_energy, {"0": 5.0}),
    ("energy_ratio", MINDLIN.energy_ratio, {"0": 5.0}),
    ("Lubkin", lambda **k: reference.Lubkin(HERTZ, **k).M_limit, {"bodies": PAIR, "mu": 0.3}),
    ("Lubkin.phi", LUBKIN.phi, {"0": INSIDE}),
    ("Lubkin.M_z", LUBKIN.M_z, {"0": INSIDE}),
    ("Lubkin.stick_radius", LUBKIN.stick_radius, {"M_z": 1e-4}),
    ("Lubkin.q", LUBKIN.q, {"0": ARRAY, "c": 5e-5}),
    (
        "HertzStress",
        lambda **k: reference.HertzStress(**k).pressure(ARRAY, 0.0, 1e-5),
        {"a": 1e-4, "nu": 0.3},
    ),
    ("HertzStress.pressure", HAMILTON.pressure, {"0": ARRAY, "1": 0.0, "2": 1e-5}),
    ("HertzStress.shear", HAMILTON.shear, {"0": ARRAY, "1": 0.0, "2": 1e-5}),
    ("line_contact", reference.line_contact, {"R": 0.01, "bodies": PAIR, "W": 1e5}),
    ("LineContact.p", LINE.p, {"0": ARRAY}),
    ("stick_half_width", LINE.stick_half_width, {"T": 1e4, "mu": 0.3}),
    ("stick_middle", LINE.stick_middle, {"eps_x": 1e-5, "mu": 0.3}),
    ("LineContact.q", LINE.q, {"0": ARRAY, "T": 1e4, "mu": 0.3, "middle": 0.0}),
    ("LineContact.stress", LINE.stress, {"0": ARRAY, "1": 1e-5, "T": 1e4, "mu": 0.3}),
    ("Springs", springs, {"R": 0.01, "bodies": PAIR, "mu": 0.3, "n": 10}),
    ("Springs.load", springs, {"W": 50.0, "T": 5.0, "steps": 3}),
    ("dundurs_beta", reference.dundurs_beta, {"0": STEEL, "1": ALUMINIUM}),
    ("goodman_stick_ratio", reference.goodman_stick_ratio, {"beta": 0.1, "mu": 0.3}),
    ("coupled_indentation", reference.coupled_indentation, {"beta": 0.1, "mu": 0.3}),
    (
        "coated_indentation",
        reference.coated_indentation,
        {
            "R": 0.01,
            "indenter": STEEL,
            "coating": fret.Coating(ALUMINIUM, thickness=1e-4),
            "substrate": STEEL,
            "W": 10.0,
        },
    ),
    ("CoatedIndentation.p", INDENTED.p, {"0": ARRAY}),
    ("SurfaceOperator", fret.SurfaceOperator, {"0": COATED, "1": COATED, "2": GRID}),
    (
        "SurfaceOperator.displacement",
        OPERATOR.displacement,
        {"p": FIELD, "q_x": FIELD, "q_y": FIELD},
    ),
    ("surface_frf", kernels.surface_frf, {"0": COATED, "1": ARRAY + 1e3, "2": ARRAY + 1e3}),
    ("_core.surface_frf", _core.surface_frf, {"0": COATED, "1": ARRAY + 1e3, "2": ARRAY + 1e3}),
    ("influence_coefficients", kernels.influence_coefficients, {"0": COATED, "1": GRID}),
    (
        "stress_coefficients",
        kernels.stress_coefficients,
        {"0": COATED, "1": GRID, "2": 1e-5, "layer": 0},
    ),
    (
        "stress_at",
        kernels.stress_at,
        {"0": COATED, "1": (1e-5, 1e-5), "2": (0.0, 1e-5, 1e-5), "layer": 0},
    ),
    ("convert", convert, {"enlargement": 2, "aliases": 0, "grid": GRID}),
    (
        "Conversion.convert",
        _core.Conversion(GRID, enlargement=2).convert,
        {"0": np.zeros((1101, 3, 3), complex)},
    ),
    ("continued_pressure", _core.continued_pressure, {"0": FIELD, "1": GRID}),
    ("depths", lambda b, z: _core.depths(b, z), {"0": COATED, "1": [1e-5]}),
    ("measure", _core.measure, {"0": "von_mises", "1": TENSORS}),
    ("principal", _core.principal, {"0": TENSORS}),
    ("rims", _core.rims, {"0": TENSORS, "1": ARRAY.tolist()}),
    (
        "maximum",
        _core.maximum,
        {"0": "von_mises", "1": TENSORS[:, None], "2": [1e-5], "3": [0], "4": ARRAY.tolist()},
    ),
    (
        "Subsurface",
        lambda **k: below(**k).points([(0.0, 0.0, 1e-5, 0)]),
        {
            "p": FIELD,
            "q_x": FIELD,
            "q_y": FIELD,
            "body_number": 2,
            "sigma_B": 0.0,
            "stick": STICK,
            "rim": True,
        },
    ),
    ("Subsurface.section", below(p=FIELD, rim=True).section, {"0": [1e-5], "1": [0], "y": 0.0}),
    ("Subsurface.slice", below(p=FIELD, rim=True).slice, {"0": 1e-5, "1": 0}),
    ("Subsurface.points", below(p=FIELD, rim=True).points, {"0": [(0.0, 0.0, 1e-5, 0)]}),
    (
        "stress",
        subsurface.stress,
        {
            "0": COATED,
            "1": GRID,
            "2": ARRAY,
            "p": FIELD,
            "q_x": FIELD,
            "x": 0.0,
            "sigma_B": 1.0,
            "body_number": 2,
        },
    ),
    (
        "displacement",
        subsurface.displacement,
        {"0": COATED, "1": GRID, "2": ARRAY, "p": FIELD, "q_x": FIELD, "x": 0.0, "body_number": 1},
    ),
    (
        "write_volume",
        lambda z, p, **k: subsurface.write_volume(
            COATED, GRID, Path(tempfile.mkdtemp(dir=FOLDER)) / "v.vti", z, p=p, **k
        ),
        {"0": ARRAY, "1": FIELD, "title": "volume", "sigma_B": 1.0},
    ),
    (
        "Envelope",
        enveloped,
        {
            "increment": 1,
            "branch": 0,
            "p": FIELD,
            "q_x": FIELD,
            "q_y": FIELD,
            "stick": STICK,
            "sigma_B": 1.0,
        },
    ),
    (
        "loops",
        lambda **k: _core.loops(PATH, **k),
        {"branch": [0], "T": [1.0], "delta": [1.0], "dissipated": [1.0], "status": [1]},
    ),
]


def _graded(**changed: Any) -> None:
    """The layers of a graded coating."""
    of = {"E": fret.Profile.linear(top=1e9, bottom=2e9), "nu": fret.Profile.constant(0.3)}
    coatings = fret.graded(**of | {"thickness": 1e-5, "layers": 4} | changed)
    kernels.influence_coefficients(fret.Body(STEEL, coatings=coatings), GRID)


def cases() -> Iterator[tuple[str, Callable[..., Any], dict[str, Any]]]:
    """Every call, with one argument hostile at a time."""
    for name, call, good in CALLS:
        yield f"{name}, as it should be", call, good
        for key, value in good.items():
            for other in hostile(value):
                text = " ".join(f"{other!r}".split())[:100]
                yield f"{name}({key} = {text})", call, good | {key: other}


def flat(values: Any) -> Iterator[Any]:
    """The numbers and arrays in nested lists and tuples."""
    for value in values:
        if isinstance(value, (list, tuple)):
            yield from flat(value)
        elif isinstance(value, (float, np.ndarray)):
            yield value


def outcome(call: Callable[..., Any], arguments: dict[str, Any]) -> str:
    """What a call does, in a word."""
    by_position = [arguments[key] for key in sorted(k for k in arguments if k.isdigit())]
    by_name = {key: value for key, value in arguments.items() if not key.isdigit()}
    try:
        found = call(*by_position, **by_name)
    except (*ALLOWED, *OWN) as error:
        text = str(error)
        # What PyO3 says of a value of another type has several lines.
        if not text.strip() or ("\n" in text.strip() and not isinstance(error, TypeError)):
            return f"BAD: {type(error).__name__} says {text[:200]!r}"
        return f"refused: {type(error).__name__}: {text[:150]}"
    except BaseException as error:
        return f"BAD: {type(error).__name__}: {str(error)[:200]!r}"
    given = list(flat([*by_position, *by_name.values()]))
    if all(np.all(np.isfinite(v)) for v in given if np.asarray(v).dtype.kind == "f"):
        for values in found if isinstance(found, (list, tuple)) else [found]:
            numbers = isinstance(values, (float, np.ndarray)) and np.asarray(values).dtype.kind
            if numbers in ("f", "c") and np.any(np.isnan(values)):
                return "BAD: finite numbers in, nan out"
    return "answered"


def main(start: int) -> None:
    """Makes the calls, with a line before and after each."""
    size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (size + MEMORY, resource.RLIM_INFINITY))
    for number, (text, call, arguments) in enumerate(cases()):
        if number < start:
            continue
        print(f"{number}\t{text}", flush=True)
        print(f"\t{' '.join(outcome(call, arguments).split())}", flush=True)
    print("done", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]))
