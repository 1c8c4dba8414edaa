"""Small good arguments, and hostile ones of the same type."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

import pyfret as fret
from pyfret import reference

#: Function, its name, good arguments: those whose names are numbers go by position.
Call = tuple[str, Callable[..., Any], dict[str, Any]]
#: What may be raised, apart from the package's own errors.
ALLOWED = (ValueError, TypeError, OverflowError, KeyError, MemoryError, OSError)
OWN = (fret.errors.NoConvergenceError, fret.errors.SlidingError, fret.errors.KernelInaccurateError)

NAN, INF = float("nan"), float("inf")
FLOATS = [NAN, INF, -INF, 0.0, -1.0, 1e300, -1e300, 1e-300, 5e-324, 1e9, 1e30]
INTS = [0, -1, 1, 10**9, 2**31, 2**62, 2**63, 2**64]

STEEL = fret.Elastic(E=210e9, nu=0.3)
ALUMINIUM = fret.Elastic(E=70e9, nu=0.3)
PAIR = (STEEL, ALUMINIUM)
GRID = fret.Grid.from_spacing((6, 5), (1e-5, 2e-5))
WIDE = fret.Grid.from_spacing((14, 12), (1e-4, 1e-4))
COATED = fret.Body(STEEL, coatings=[fret.Coating(ALUMINIUM, thickness=3e-5)])
HERTZ = reference.hertz(R=0.01, bodies=PAIR, W=100.0)
TORN = np.zeros((12, 5))[::2]
FIELD = np.full((6, 5), 1e6)
STICK = np.zeros((6, 5), bool)
PATH = fret.LoadPath.start().normal(100.0, increments=2).tangential(0.2, increments=1)
SCENE = {
    "body1": fret.Body(STEEL, shape=fret.Sphere(R=0.01)),
    "body2": fret.Body(ALUMINIUM),
    "friction": 0.3,
    "grid": fret.Grid.centred(width=8e-4, n=12),
    "path": PATH,
}
TOML = fret.Scene(**SCENE).to_toml()
ARRAY = np.linspace(0, 2e-4, 5)


class Liar(list[Any]):
    """A list whose length claims to be very large."""

    def __len__(self) -> int:
        """Give far more than there is."""
        return 1 << 60


def repeated(value: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """An array of a million million numbers that takes no memory."""
    item = np.zeros((), value.dtype)
    return np.broadcast_to(item, (1 << (40 // max(value.ndim, 1)),) * max(value.ndim, 1))


def scene(**changed: Any) -> fret.Scene:
    """A small contact with some of it changed."""
    return fret.Scene(**SCENE | changed)


def tried(make: Callable[[], Any]) -> list[Any]:
    """Return the value of `make` in a list, empty if it raises."""
    try:
        return [make()]
    except (*ALLOWED, *OWN):
        return []


def objects_like(value: Any) -> list[Any]:
    """Hostile objects of the type of `value` that can be had."""
    if isinstance(value, fret.Elastic):
        every = [tried(lambda E=E: fret.Elastic(E=E, nu=0.3)) for E in FLOATS]
        every += [tried(lambda nu=nu: fret.Elastic(E=1e9, nu=nu)) for nu in (0.5 - 1e-16, NAN)]
        return [*(candidate for some in every for candidate in some), fret.RIGID]
    if isinstance(value, fret.Coating):
        layers = [lambda h=h: fret.Coating(STEEL, thickness=h) for h in [*FLOATS, 1e-200, 1e-12]]
        layers += [lambda m=m: fret.Coating(m, thickness=1e-5) for m in objects_like(STEEL)]
        return [candidate for make in layers for candidate in tried(make)]
    if isinstance(value, fret.Body):
        coats = objects_like(COATED.coatings[0])
        bodies = [lambda m=m: fret.Body(m) for m in objects_like(STEEL)]
        bodies += [lambda c=c: fret.Body(STEEL, coatings=[c]) for c in coats]
        bodies += [lambda: fret.Body(fret.RIGID, coatings=COATED.coatings)]
        bodies += [lambda: fret.Body(STEEL, coatings=COATED.coatings * 50)]
        return [candidate for make in bodies for candidate in tried(make)]
    if isinstance(value, fret.Grid):
        n, d = (6, 5), (1e-5, 2e-5)
        grids = [lambda x=x: fret.Grid.from_spacing(n, (x, 1e-5)) for x in [*FLOATS, 1e-200]]
        grids += [lambda x=x: fret.Grid.from_spacing(n, (x, x)) for x in [*FLOATS, 1e-200]]
        grids += [lambda k=k: fret.Grid.from_spacing((k, 1), d) for k in INTS]
        grids += [lambda: fret.Grid.from_spacing((1 << 14, 1 << 14), d)]
        grids += [lambda: fret.Grid.strip(extent=1e-3, n=6)]
        return [candidate for make in grids for candidate in tried(make)]
    if isinstance(value, fret.LoadPath):
        loads = [lambda v=v: PATH.normal(v, increments=1) for v in FLOATS]
        loads += [lambda v=v: PATH.torsion(v, increments=1) for v in FLOATS]
        loads += [lambda v=v: PATH.displace(phi_x=v, increments=1) for v in FLOATS]
        loads += [lambda: fret.LoadPath.start(), lambda: PATH.normal(1.0, increments=0)]
        return [candidate for make in loads for candidate in tried(make)]
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
        others += [repeated(value), np.ma.array(value, mask=True)]
        torn = np.zeros((2 * value.shape[0], *value.shape[1:]), value.dtype)[::2]
        return [*others, torn, np.asfortranarray(value), value.astype(object), value.astype("i4")]
    if isinstance(value, tuple):
        parts = [
            (*value[:i], alternative, *value[i + 1 :])
            for i, part in enumerate(value)
            for alternative in hostile(part)
        ]
        return [*parts, (), value * 2]
    if isinstance(value, list):
        parts = [[alternative] for part in value[:1] for alternative in hostile(part)]
        return [*parts, [], value * 300, Liar(value)]
    if isinstance(value, str):
        return ["", "x", "\0", "é" * 5000]
    return objects_like(value)
