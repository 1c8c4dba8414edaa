"""Calls of kernels, operators and stresses."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from values import ARRAY, COATED, FIELD, GRID, PATH, STEEL, STICK, Call

import pyfret as fret
from pyfret import _core, kernels, subsurface

OPERATOR = fret.SurfaceOperator(COATED, COATED, GRID)
TENSORS = np.linspace(-1, 1, 30).reshape(6, 5)
FOLDER = Path(tempfile.mkdtemp(prefix="hostile-"))


def convert(enlargement: int = 2, aliases: int = 0, grid: fret.Grid = GRID) -> object:
    """The paper's conversion of a half-space's response."""
    body = fret.Body(STEEL)
    response = lambda x, y: kernels.surface_frf(body, x, y)  # noqa: E731
    return kernels.convert(response, grid, enlargement=enlargement, aliases=aliases)


def make_subsurface(**loads: Any) -> _core.Subsurface:
    """The tractions on a coated body."""
    return _core.Subsurface(COATED, GRID, **loads)


def enveloped(**changed: Any) -> object:
    """The envelope of one increment."""
    options = {"p": FIELD, "q_x": FIELD, "q_y": FIELD, "stick": STICK, "sigma_B": 0.0}
    made = _core.Envelope(COATED, GRID, PATH, [0.0, 1e-5], [0, 0], of=["von_mises"], y=0.0)
    number, branch = changed.pop("increment", 1), changed.pop("branch", 0)
    made.push(number, branch, **options | changed)
    return made.finish()


CALLS: list[Call] = [
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
    (
        "largest_of_samples",
        _core.largest_of_samples,
        {"0": ARRAY[None], "1": [1e-5], "2": [0], "3": ARRAY.tolist()},
    ),
    (
        "Subsurface",
        lambda **k: make_subsurface(**k).points([(0.0, 0.0, 1e-5, 0)]),
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
    (
        "Subsurface.section",
        make_subsurface(p=FIELD, rim=True).section,
        {"0": [1e-5], "1": [0], "y": 0.0},
    ),
    ("Subsurface.slice", make_subsurface(p=FIELD, rim=True).slice, {"0": 1e-5, "1": 0}),
    ("Subsurface.points", make_subsurface(p=FIELD, rim=True).points, {"0": [(0.0, 0.0, 1e-5, 0)]}),
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
        {
            "branch": [0],
            "T": [1.0],
            "delta": [1.0],
            "dissipated": [1.0],
            "status": [1],
            "contact_area": [1.0],
            "stick_ratio": [0.5],
            "grid": GRID,
            "errors": [[0.1, 0.1, 0.1]],
            "torsion": False,
        },
    ),
]
