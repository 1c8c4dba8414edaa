"""Frictionless contacts, solved by every program to the same residual."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from environment import Peers, Refused, now, product, run_python

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    Row = dict[str, Any]

#: Largest residual allowed, over the approach: root-mean-square gap in the contact, and deepest
#: overlap outside. It is that of pyfret's default tolerance.
RESIDUAL = 1e-6
#: Tolerances of a program, from loose to tight; each means something else by it.
TOLERANCES = tuple(10 ** (-k / 2) for k in range(4, 17))


class Program(NamedTuple):
    """A program that solves frictionless contacts."""

    name: str
    file: str
    options: tuple[str, ...] = ()
    #: Its name in the package registry; none for our own.
    package: str | None = None


PROGRAMS = (
    Program("pyfret", "run_pyfret.py"),
    Program("pyfret, spinu2020", "run_pyfret.py", ("--preset", "spinu2020")),
    Program("Tamaas", "run_tamaas.py", package="tamaas"),
    Program("ContactMechanics", "run_contactmechanics.py", package="ContactMechanics"),
)


def python_of(program: Program, peers: Peers) -> Path:
    """The interpreter that has the program."""
    if program.package in peers.missing:
        raise Refused(f"not installed: {peers.missing[program.package]}")
    return peers.python if program.package else product()


def run(
    program: Program, peers: Peers, scene: str, cells: int, tolerances: Sequence[float], **more: Any
) -> list[Row]:
    """Runs of a program under several tolerances, in a process of its own."""
    arguments = [
        *("--scene", scene, "--cells", str(cells)),
        *("--tolerance", *(f"{tolerance:.3e}" for tolerance in tolerances)),
        *("--started", now(), *program.options),
    ]
    for name, value in more.items():
        arguments += [f"--{name}", str(value)]
    rows = run_python(python_of(program, peers), program.file, arguments)
    return [{"program": program.name, **row} for row in rows]


def precision(peers: Peers, scene: str, cells: int, seconds: float) -> Iterator[Row]:
    """Residual against time: every program under tolerances from loose to tight."""
    for program in PROGRAMS:
        options = {"seconds": seconds, "until": RESIDUAL / 10}
        try:
            yield from run(program, peers, scene, cells, TOLERANCES, **options)
        except Refused as reason:
            yield {"program": program.name, "scene": scene, "missing": str(reason)}


def loosest(rows: Sequence[Row], program: str) -> float:
    """The loosest tolerance under which a program meets the residual."""
    mine = [row for row in rows if row["program"] == program]
    for row in mine:
        if "missing" in row:
            raise Refused(row["missing"])
    met: list[float] = [row["tolerance"] for row in mine if row["residual"] <= RESIDUAL]
    if not met:
        raise Refused(f"no tolerance leads to the residual {RESIDUAL:.0e}")
    return max(met)


def within_residual(
    program: Program, peers: Peers, scene: str, cells: int, tolerance: float, seconds: float
) -> Row:
    """A run under the tolerance, or the next tighter one that meets the residual on this grid."""
    while tolerance >= min(TOLERANCES):
        (row,) = run(program, peers, scene, cells, [tolerance], seconds=seconds)
        if row["residual"] <= RESIDUAL:
            return row
        tolerance /= 10**0.5
    raise Refused(f"no tolerance leads to the residual {RESIDUAL:.0e}")


def grids(
    peers: Peers, scene: str, sizes: Sequence[int], ladder: Sequence[Row], seconds: float
) -> Iterator[Row]:
    """Every program on every grid, under the loosest tolerance that meets the residual there."""
    for cells in sizes:
        for program in PROGRAMS:
            try:
                tolerance = loosest(ladder, program.name)
                yield within_residual(program, peers, scene, cells, tolerance, seconds)
            except Refused as reason:
                missing = {"cells": cells, "missing": str(reason)}
                yield {"program": program.name, "scene": scene, **missing}
