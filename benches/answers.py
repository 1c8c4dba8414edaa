"""What answers cost beside the solution of their contact, and how well they are known.

Times are processor times, medians of several repetitions in one process for each number of threads.
Each question is asked alone, of a result of which nothing else was asked. The last row asks all of
them of one result. The change of an answer by twice as many depths stands beside its printed error:
an answer must not become faster by becoming worse. Counters of the work do not depend on the
machine: stresses (each point once for each state), planes judged by criteria, kernel tables made
when a question is asked for the first time. Tasks of many answers are in
:mod:`answer_tasks`. ::

    python benches/answers.py --document docs/performance.md
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
import warnings
from functools import partial
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from tables import table, write_between_marks

import pyfret as fret
from pyfret import _core

if TYPE_CHECKING:
    from collections.abc import Callable

    from pyfret.fatigue.criteria import CriterionName

#: A ball or a roller of steel on a flat of Ti-6Al-4V. The film is a tenth of the radius thick.
STEEL, TITANIUM = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=114e9, nu=0.34)
CARBON = fret.Elastic(E=200e9, nu=0.25)
R, W, W_LINE, MU = 5e-3, 20.0, 1e5, 0.5
#: Largest shear force over the friction force.
SHARE = 0.6
#: Yield stress of load factors, and of the body that yields [Pa].
S_Y, S_Y_LOW = 900e6, 550e6
MATERIAL = "titanium_6Al4V"
#: Criteria of stress: lives of strain are for closed loops, and the first cycle may ratchet.
CRITERIA: tuple[CriterionName, ...] = (
    "findley",
    "dang_van",
    "crossland",
    "matake",
    "mcdiarmid",
)
#: Contacts with their cells a side, by the number of threads. A solution of the body that yields
#: takes ten seconds: it is measured once.
CONTACTS = {
    1: [("bare", 64), ("bare", 128), ("coated", 64), ("coated", 128), ("line", 128)],
    2: [("coated", 64), ("coated", 128)],
}
ONCE = [("yielding", 32)]
#: Divisor of all numbers of cells of a quick run, which checks the program.
QUICK = 4


class Known(NamedTuple):
    """A number and its printed error."""

    value: float
    error: float


def contact(kind: str, cells: int) -> fret.Scene:
    """Return the scene of a contact over one cycle of shear."""
    line = kind == "line"
    shape = fret.Cylinder(R=R) if line else fret.Sphere(R=R)
    upper, force = fret.Body(STEEL, shape=shape), W_LINE if line else W
    a = half_width(upper, fret.Body(TITANIUM), force, line=line)
    coatings = [fret.Coating(CARBON, thickness=0.1 * a)] if kind == "coated" else []
    plastic = fret.Plastic(s_y=S_Y_LOW, hardening=5e9) if kind == "yielding" else None
    lower = fret.Body(TITANIUM.replace(plastic=plastic), coatings=coatings)
    path = fret.LoadPath.start().normal(force).cycles(1, T_x=SHARE * MU * force)
    side = 2.6 * a
    grid = fret.Grid.strip(extent=side, n=cells) if line else fret.Grid.centred(width=side, n=cells)
    return fret.Scene(body1=upper, body2=lower, friction=MU, grid=grid, path=path)


def half_width(upper: fret.Body, lower: fret.Body, force: float, *, line: bool) -> float:
    """Return half the width of the uncoated contact [m]."""
    if line:
        compliance = sum((1.0 - of.nu**2) / of.E for of in (STEEL, TITANIUM))
        return float(np.sqrt(4.0 * force * R * compliance / np.pi))
    return float(fret.reference.hertz(R=R, bodies=(upper, lower), W=force).a)


def twice_as_many(depths: np.ndarray) -> list[float]:
    """Return depths with one more between each two."""
    z = np.unique(depths)
    return sorted([*z.tolist(), *(0.5 * (z[1:] + z[:-1])).tolist()])


def stress(run: fret.Result, z: list[float] | None) -> Known:
    """Sample the stress of the last increment on its section."""
    field = run.at(-1).stress().von_mises
    return Known(float(field.max()), float("nan"))


def largest(*measures: str) -> Any:
    """Return a question for largest values in the last increment; its number is the first one."""

    def ask(run: fret.Result, z: list[float] | None) -> Known:
        below = run.at(-1).stress()
        found = [below.maximum(of) for of in measures]
        return Known(found[0].value, found[0].error)

    return ask


def lives(*criteria: CriterionName) -> Any:
    """Return a question for the worst points by criteria; its number belongs to the first one."""

    def ask(run: fret.Result, z: list[float] | None) -> Known:
        found = fret.fatigue.lives(run, MATERIAL, criteria, z)
        worst = [found[name].worst for name in criteria]
        return Known(worst[0].value, worst[0].error)

    return ask


def factors(run: fret.Result, z: list[float] | None) -> Known:
    """Ask for the three least load factors; the number belongs to first yield."""
    found = run.load_factors(S_Y, z)
    least = [found.least(of) for of in ("von_mises", "tresca", "shakedown")]
    return Known(least[0].value, least[0].error)


def crack(run: fret.Result, z: list[float] | None) -> Known:
    """Ask for cracks of all lengths from the rim; the number is the largest K_I."""
    K = run.crack().dataset
    at = np.unravel_index(int(np.argmax(K.K_I.values)), K.K_I.shape)
    return Known(float(K.K_I.values[at]), float(K.error.values[at]))


class Question(NamedTuple):
    """A question: title, function, whether it takes depths, contacts that it does not suit."""

    title: str
    ask: Any
    depths: bool = False
    unsuited: tuple[str, ...] = ()


QUESTIONS = (
    Question("`stress()`", stress),
    Question("`maximum('von_mises')`", largest("von_mises")),
    Question("`maximum('s_1')`", largest("s_1")),
    Question("von Mises, s_1, Tresca", largest("von_mises", "s_1", "tresca")),
    Question("life, one criterion", lives(CRITERIA[0]), depths=True),
    Question("life, five criteria", lives(*CRITERIA), depths=True),
    Question("load factors", factors, depths=True, unsuited=("yielding",)),
    Question("crack", crack),
)


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """Return the processor time of some work [s], and its result."""
    begun = time.process_time()
    result = work()
    return time.process_time() - begun, result


def measure(kind: str, cells: int, repeat: int, *, errors: bool) -> dict[str, Any]:
    """Measure all questions about a contact on a grid; with `errors` the changes by more depths."""
    scene = contact(kind, cells)

    def solve() -> fret.Result:
        return fret.solve(scene, save="all", progress=False)

    unit, run = timed(solve)
    if repeat > 1:
        unit = median(timed(solve)[0] for _ in range(repeat))
    row: dict[str, Any] = {"contact": kind, "cells": cells, "solve_s": unit}
    row["increments"] = int(run.dataset.sizes["increment"])
    asked = [question for question in QUESTIONS if kind not in question.unsuited]
    finer = twice_as_many(run.at(-1).stress().dataset.z.values)
    answers = {}
    for question in asked:
        times: list[float] = []
        counts = _core.count_work()
        for _ in range(repeat):
            fresh = fret.Result(run.dataset)
            seconds, known = timed(partial(question.ask, fresh, None))
            if not times:
                work = {name: n - counts[name] for name, n in _core.count_work().items()}
            times.append(seconds)
        answer: dict[str, Any] = {"seconds": median(times), "work": work, **known._asdict()}
        if question.depths and errors:
            by_depths = question.ask(fret.Result(run.dataset), finer)
            answer["change"] = abs(by_depths.value - known.value)
        answers[question.title] = answer
    together = fret.Result(run.dataset)
    whole, _ = timed(lambda: [question.ask(together, None) for question in asked])
    answers["all of these of one result"] = {"seconds": whole}
    return row | {"answers": answers}


def tabulate(rows: list[dict[str, Any]]) -> str:
    """Return the table of the page: cost over the solution, and error and change over the value."""
    heads = ["question", *(f"{row['contact']}, {row['cells']}" for row in rows)]
    titles = [question.title for question in QUESTIONS] + ["all of these of one result"]
    lines = [["solution, processor time", *(f"{row['solve_s']:.2g} s" for row in rows)]]
    lines += [[title, *(cost(row, title) for row in rows)] for title in titles]
    for title in titles[:-1]:
        works = [row["answers"].get(title, {}).get("work") for row in rows]
        lines.append([f"{title}: work", *(count(work) for work in works)])
    for title in titles[1:-1]:
        lines.append([f"{title}: error", *(share(row["answers"].get(title)) for row in rows)])
    return table(heads, lines)


def cost(row: dict[str, Any], title: str) -> str:
    """Return the cost of an answer over the solution, and in seconds."""
    answer = row["answers"].get(title)
    if answer is None:
        return ""
    return f"{answer['seconds'] / row['solve_s']:.2g} ({answer['seconds']:.2g} s)"


def count(work: dict[str, int] | None) -> str:
    """Return the work of an answer: stresses on lines and at points, planes, kernel tables."""
    if work is None:
        return ""
    names = ("stresses_on_grids", "stresses_at_points", "planes", "tables")
    return ", ".join(f"{work[name]:.2g}" for name in names)


def share(answer: dict[str, float] | None) -> str:
    """Return the error of an answer, and its change by more depths, in per cent of the value."""
    if answer is None or np.isnan(answer["error"]):
        return ""
    parts = [answer["error"], *([answer["change"]] if "change" in answer else [])]
    texts = (f"{100.0 * part / abs(answer['value']):.2g} %" for part in parts)
    return ", by depths ".join(texts)


def measured_apart(program: str, *arguments: str, threads: int) -> list[dict[str, Any]]:
    """Run a program of this folder with so many threads; return its lines of JSON."""
    command = [sys.executable, str(Path(__file__).with_name(program)), *arguments]
    environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
    done = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    rows = [json.loads(line) for line in done.stdout.splitlines()]
    for row in rows:
        print(json.dumps(row), flush=True)
    return rows


def tabulate_tasks(rows: list[dict[str, Any]]) -> str:
    """Return the table of the tasks."""
    lines = [
        [
            row["title"],
            "" if np.isnan(row["ratio"]) else f"{row['ratio']:.2g}",
            f"{row['processor']:.2g} s",
            f"{row['wall']:.2g} s",
        ]
        for row in rows
    ]
    return table(["task", "ratio", "processor time", "time, two threads"], lines)


def main() -> None:
    """Measure, and write the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--threads", type=int, help="measure the contacts of so many threads here")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--document", type=Path, help="page whose tables are replaced")
    parser.add_argument("--quick", action="store_true", help="small grids, to check the program")
    options = parser.parse_args()
    divisor = QUICK if options.quick else 1
    if options.threads is not None:
        warnings.simplefilter("ignore")
        is_first = options.threads == 1
        for kind, cells in CONTACTS[options.threads]:
            row = measure(kind, cells // divisor, options.repeat, errors=is_first)
            print(json.dumps(row), flush=True)
        for kind, cells in ONCE if is_first else []:
            row = measure(kind, cells // divisor, 1, errors=False)
            print(json.dumps(row), flush=True)
        return
    quick = ("--quick",) if options.quick else ()
    repeat = ("--repeat", str(options.repeat), *quick)
    pages = {}
    for threads, name in ((1, "answers"), (2, "answers, two threads")):
        asked = ("--threads", str(threads), *repeat)
        pages[name] = tabulate(measured_apart("answers.py", *asked, threads=threads))
    pages["tasks"] = tabulate_tasks(measured_apart("answer_tasks.py", *quick, threads=2))
    for name, text in pages.items():
        print(text)
        if options.document:
            write_between_marks(options.document, name, text)


if __name__ == "__main__":
    main()
