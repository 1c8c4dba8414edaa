"""The paper's scene: error of the shear against time, with our solvers and with the paper's."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING, Any, NamedTuple

from environment import run_example

if TYPE_CHECKING:
    from collections.abc import Iterator

    Row = dict[str, Any]

SCENE = "scenes/coated_fretting.toml"
#: Tolerance of the solution that the others are compared with.
REFERENCE = 1e-8
PLAIN = 'solver.preset="spinu2020"'


class Case(NamedTuple):
    """One grid, one coating, one number of increments, several ways to solve."""

    ratio: float
    cells: int
    #: Increments of the whole path; the branches share them as in the paper.
    increments: int
    tolerances: tuple[float, ...]
    #: Those of the preset spinu2020.
    plain: tuple[float, ...] = ()


def path(increments: int) -> list[str]:
    """Settings that share the increments out over the six branches of the path."""
    shares = (1, 1, 2, 2, 2, 2)
    return [f"path.{k}.increments={increments * s // sum(shares)}" for k, s in enumerate(shares)]


def measure(case: Case) -> Iterator[Row]:
    """The rows of a case: time, work, and the errors at the ends of the branches."""
    common = [
        f"grid.n={case.cells}",
        f"body2.coatings.0.E.E_substrate={case.ratio}",
        *path(case.increments),
    ]
    ways = [("spinu2020", t) for t in case.plain] + [("pyfret", t) for t in case.tolerances]
    arguments = [SCENE, *common]
    for program, tolerance in [*ways, ("reference", REFERENCE)]:
        arguments += ["--", f"solver.tolerance={tolerance:g}"]
        if program == "spinu2020":
            arguments.append(PLAIN)
    said = run_example("work_precision", arguments)
    # The last one is the reference.
    for (program, tolerance), row in zip(ways, csv.DictReader(said.splitlines()), strict=False):
        numbers = {k: float(v) for k, v in row.items() if k != "settings"}
        where = {"ratio": case.ratio, "cells": case.cells}
        yield {"program": program, "tolerance": tolerance, **where, **numbers}


FULL = (1e-4, 1e-5, 1e-6, 1e-7)
#: About the loosest tolerance at which the preset's shear is within half a per cent of that of a
#: tolerance a hundred times tighter: E1/E2 = 2, 256 x 256, 1000 increments.
HALF_A_PER_CENT = 7e-6
#: The same of our solvers, for all E1/E2.
OURS = 4e-5
RATIOS = (0.5, 2.0, 4.0)


def cases(*, quick: bool) -> Iterator[Case]:
    """What is measured, the shortest first."""
    if quick:
        yield Case(2.0, 32, 100, FULL[1:3], plain=FULL[1:3])
        return
    for ratio in RATIOS:
        # The preset takes long for the whole path: a tenth of the increments, for all ways.
        yield Case(ratio, 64, 100, FULL, plain=FULL[:3])
    yield Case(2.0, 128, 100, FULL, plain=FULL[1:3])
    # Those of scenes/coated_small.toml.
    yield Case(2.0, 64, 200, (OURS, 1e-5, 1e-6))
    largest = (OURS, 1e-5, HALF_A_PER_CENT, 1e-6)
    for cells, tolerances in ((64, FULL), (128, FULL), (256, largest)):
        for ratio in RATIOS:
            # Once the preset too, for minutes.
            once = (HALF_A_PER_CENT,) if (cells, ratio) == (256, 2.0) else ()
            yield Case(ratio, cells, 1000, tolerances, plain=once)
