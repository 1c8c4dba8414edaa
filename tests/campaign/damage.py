"""Damages and kills of what is saved: runs, wear, studies, fits.

``python tests/campaign/damage.py 300 60`` damages 300 stores and files of each kind and kills 60
processes that write each kind. What is opened after a damage is what was written, or it is refused
by name; after a kill a place holds nothing, or what is whole, and the work goes on to the same
numbers.
"""

from __future__ import annotations

import os
import random
import shutil
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

import pyfret as fret
from pyfret.fit import FitResult, Loops
from pyfret.fit.data import Measured
from pyfret.fit.outcome import Known

sys.path.append(str(Path(__file__).parents[1]))
from damaging import damage

STEEL = fret.Elastic(E=210e9, nu=0.3)
PATH = fret.LoadPath.start().normal(10.0, increments=3).tangential([1.0, -1.0, 1.0], increments=3)
SCENE = fret.Scene(
    body1=fret.Body(STEEL, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(STEEL),
    friction=0.3,
    grid=fret.Grid.centred(width=2e-4, n=16),
    path=PATH,
)
WEAR = fret.wear.Wear(cycles=1e3, body2=fret.wear.Archard(1e-15), first_branch=2, jumps=6)
MU = {"mu": [0.2, 0.3, 0.4, 0.5, 0.6, 0.7]}
#: What differs from run to run: times.
TIMES = ("seconds", "elapsed", "wall_time", "time_of_checkpoints")


def a_fit() -> FitResult:
    """A fit of a loop, its numbers made up."""
    loops = Loops.from_arrays(
        delta=1e-6 * np.array([0.0, 1.0, 2.0, 1.0, 0.0, -1.0, 0.0]),
        T=np.array([0.0, 3.0, 5.0, 0.0, -4.0, -5.0, 0.0]),
        W=10.0,
    )
    measured = Measured(loops, loops.T, loops.delta, ("shift [m]", "force [N]"))
    return FitResult(
        known={"mu": Known(0.5, 0.48, 0.53, 0.02, 1e-3, at_bound=False)},
        offsets={"offset of the shift [m]": 1e-8},
        offset_errors={"offset of the shift [m]": 1e-9},
        correlation=np.ones((1, 1)),
        residual=[0.01 * loops.T],
        computed=[0.99 * loops.T],
        sets=[measured],
        noise=[0.05],
        solves=12,
        solver_known=True,
        converged=True,
        scene=SCENE,
    )


def run(place: Path) -> None:
    """A run, or the rest of one."""
    if place.exists():
        fret.resume(place, progress=False)
    else:
        fret.solve(SCENE, out=place, progress=False)


def wear(place: Path) -> None:
    """A run of wear, or the rest of one."""
    if place.exists():
        fret.wear.resume(place, progress=False)
    else:
        fret.wear.solve(SCENE, WEAR, out=place, progress=False)


def study(place: Path) -> None:
    """A study, or the rest of one."""
    fret.study.run(
        SCENE, MU, measure="p_max", executor=ThreadPoolExecutor(1), out=place, progress=False
    )


def fit(place: Path) -> None:
    """A fit, saved again and again."""
    fitted = a_fit()
    for _ in range(20):
        fitted.save(place, overwrite=True)


WRITES: dict[str, tuple[Callable[[Path], None], str]] = {
    "run": (run, ".zarr"),
    "wear": (wear, ".zarr"),
    "study": (study, ".zarr"),
    "fit": (fit, ".zarr"),
    "fit in NetCDF": (fit, ".nc"),
}


def numbers(place: Path) -> xr.Dataset:
    """All that is there but times."""
    dataset: xr.Dataset = fret.open(place).dataset.load()
    return dataset.drop_vars([name for name in dataset.variables if name in TIMES])


def same(one: xr.Dataset, other: xr.Dataset) -> bool:
    """Whether variables and their labels are the same."""
    return bool(one.drop_attrs().identical(other.drop_attrs()))


def damaged(kind: str, count: int, folder: Path, rng: random.Random) -> str:
    """Damage a store `count` times; return the wrong answers, or the number of refusals."""
    write, ending = WRITES[kind]
    good, bad = folder / f"good{ending}", folder / f"bad{ending}"
    write(good)
    right = numbers(good)
    files = sorted(f.relative_to(good) for f in good.rglob("*") if f.is_file())
    refused = 0
    for n in range(count):
        shutil.rmtree(bad, ignore_errors=True)
        if good.is_dir():
            shutil.copytree(good, bad)
            name = Path(".zmetadata") if n % 8 == 0 else rng.choice(files)
            damage(bad / name, rng)
        else:
            name = Path()
            shutil.copy(good, bad)
            damage(bad, rng)
        try:
            read = numbers(bad)
        except fret.errors.StoreError as error:
            right_so = str(bad) in str(error)
            refused += 1
            why = str(error)
        else:
            right_so, why = same(read, right), "read as other numbers"
        if not right_so:
            raise AssertionError(f"{kind} {n}, {name}: {why}")
    return f"{count} damages of a {kind}: {refused} refused by name, the others read as written"


def killed(kind: str, count: int, folder: Path, rng: random.Random) -> str:
    """Kill the writing process `count` times; return the state of the stores."""
    write, ending = WRITES[kind]
    good = folder / f"whole{ending}"
    begun = time.monotonic()
    child(lambda: write(good))
    length = time.monotonic() - begun
    remaining = 0
    for n in range(count):
        path = folder / f"killed{n}{ending}"
        child(lambda place=path: write(place), after=rng.uniform(0.02, 1.0) * length)
        remaining += path.exists()
        if path.exists():
            child(lambda place=path: must_open(place))
        child(lambda place=path: write(place))
        child(lambda place=path: must_be(place, good))
        shutil.rmtree(path, ignore_errors=True)
    return f"{count} kills of a {kind}: {remaining} left one behind, all of it whole; all went on"


def must_open(place: Path) -> None:
    """Open the folder that a killed process left, unless the error is that nothing is there yet."""
    try:
        fret.open(place)
    except fret.errors.StoreError as error:
        if "no increment" not in str(error) and "no jump" not in str(error):
            raise


def must_be(place: Path, good: Path) -> None:
    """Refuse a place with other numbers."""
    assert same(numbers(place), numbers(good)), f"{place}: other numbers"


def child(work: Callable[[], Any], after: float | None = None) -> None:
    """Do something in a process of its own, which is killed after a time [s]."""
    sys.stdout.flush()
    item = os.fork()
    if item == 0:
        try:
            work()
        except BaseException:
            traceback.print_exc()
            os._exit(1)
        os._exit(0)
    if after is not None:
        time.sleep(after)
        os.kill(item, signal.SIGKILL)
    _, status = os.waitpid(item, 0)
    if after is None and status:
        raise AssertionError(f"status {status}")


def main(damages: int, kills: int) -> None:
    """All kinds."""
    warnings.simplefilter("ignore")
    rng = random.Random(5)
    with tempfile.TemporaryDirectory(prefix="damage-") as name:
        folder = Path(name)
        # Kills first: a process that has computed is not copied.
        for many, item in ((killed, kills), (damaged, damages)):
            for kind in WRITES:
                path = folder / f"{many.__name__} {kind}"
                path.mkdir()
                print(many(kind, item, path, rng), flush=True)
                shutil.rmtree(path)


if __name__ == "__main__":
    main(*(int(n) for n in sys.argv[1:3]))
