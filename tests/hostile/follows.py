"""Calls of what follows from a contact: fatigue, wear, heat, studies, results."""

from __future__ import annotations

import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from values import PATH, Call, scene

import pyfret as fret
from pyfret import fatigue

FOLDER = Path(tempfile.mkdtemp(prefix="hostile-"))
FINDLEY = fatigue.Criterion.findley(k=0.3)
#: A history of four instants at two points [Pa].
HISTORY = 1e8 * np.sin(np.arange(48.0)).reshape(4, 2, 6)
RESULT = fret.solve(scene(), save="all", progress=False)
CYCLE = fret.LoadPath.start().normal(100.0, increments=1).tangential([5.0, -5.0, 5.0], increments=2)


def worn(**options: Any) -> object:
    """Two jumps of wear."""
    laws = {"k": 1e-14, "threshold": 0.0}
    law = fret.wear.Archard(**{key: options.pop(key, value) for key, value in laws.items()})
    text = {"cycles": 10.0, "first_branch": 2, "jumps": 2} | options
    return fret.wear.solve(scene(), path=CYCLE, body2=law, progress=False, **text)


def studied(values: Any, measure: Any = "p_max") -> object:
    """A study in a thread."""
    return fret.study.run(
        scene(), {"mu": values}, measure=measure, executor=ThreadPoolExecutor(1), progress=False
    )


def written(text: str) -> Path:
    """A file of a text."""
    file = Path(tempfile.mkdtemp(dir=FOLDER)) / "z.txt"
    file.write_text(text, encoding="utf-8", errors="surrogateescape")
    return file


CALLS: list[Call] = [
    ("evaluate", fatigue.evaluate_criterion, {"0": HISTORY, "1": FINDLEY, "tolerance": 1e-2}),
    ("first_yield", fatigue.first_yield, {"0": HISTORY, "s_y": 1e8}),
    ("moving_load", fatigue.moving_load, {"0": HISTORY, "s_y": 1e8}),
    ("dang_van_path", fatigue.dang_van_path, {"0": HISTORY[:, 0]}),
    ("rainflow", fatigue.rainflow, {"0": HISTORY[:, 0, 0]}),
    ("rainflow of a list", fatigue.rainflow, {"0": [0.0, 1.0, 0.0]}),
    (
        "wear.solve",
        worn,
        {"cycles": 10.0, "k": 1e-14, "threshold": 0.0, "event_depth_fraction": 0.1},
    ),
    ("wear.solve, counts", worn, {"jumps": 2, "first_branch": 2}),
    ("study.run", studied, {"0": [0.2]}),
    ("Snapshot.stress", lambda z, **k: RESULT.at(-1).stress(z, **k), {"0": [1e-5], "y": 0.0}),
    ("Result.at", lambda n: RESULT.at(n), {"0": 1}),
    ("Result.loops", lambda: RESULT.loops(), {}),
    (
        "SurfaceMap.from_file",
        lambda t, **k: fret.SurfaceMap.from_file(written(t), **k),
        {
            "0": "1 2\n3 4\n",
            "spacing": 1e-6,
            "missing": "refuse",
        },
    ),
    (
        "LoadPath.from_csv",
        lambda t, **k: fret.LoadPath.from_csv(written(t), **k),
        {
            "0": "W\n1\n",
            "increments": 1,
        },
    ),
    ("march", lambda path: list(fret.march(scene(path=path))), {"0": PATH}),
]
