"""Identity of a study: values, names, code."""

from __future__ import annotations

import functools
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import pyfret as fret
from conftest import SAME_PROCESS
from pyfret.study.identity import code_checksum

pytestmark = pytest.mark.solves

STEEL = fret.Elastic(E=210e9, nu=0.3)
SCENE = fret.Scene(
    body1=fret.Body(STEEL, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(STEEL),
    friction=0.3,
    grid=fret.Grid.centred(width=2e-4, n=8),
    path=fret.LoadPath.start().normal(10.0, increments=1),
)
#: A global that a measure names.
SCALE = 1.0


def solved(parameters: dict[str, Any], measure: Any, **options: Any) -> fret.study.Study:
    """A study in this process."""
    text = {"executor": SAME_PROCESS, "progress": False} | options
    return fret.study.run(SCENE, parameters, measure=measure, **text)


def scaled(result: Any, by: float = 1.0, *, offset: float = 0.0) -> float:
    """A measure with arguments."""
    return SCALE * by * float(result.p_max[-1]) + offset


@pytest.mark.parametrize(
    "twice",
    [
        {"mu": [0.2, 0.4], "friction.mu": [0.3]},
        {"friction.mu": [0.3], "mu": [0.2, 0.4]},
        {"path.0.W": [5.0, 10.0], "path.*.W": [10.0]},
        {"path.0.W,-path.0.W": [5.0]},
        {"body1.shape": [{"sphere": {"R": 5e-3}}], "body1.shape.sphere.R": [4e-3, 6e-3]},
        {"friction": [0.3, 0.4], "mu": [0.3]},
    ],
)
def test_a_value_that_is_set_twice_is_refused(twice: dict[str, Any]) -> None:
    """Whatever the names, in a study and for one scene."""
    with pytest.raises(ValueError, match="twice"):
        solved(twice, "p_max")
    with pytest.raises(ValueError, match="twice"):
        SCENE.replace({key: values[0] for key, values in twice.items()})


def test_a_function_is_told_by_what_it_does() -> None:
    """Code, defaults, closures, arguments, globals; not comments, docstrings or places."""
    factor = 2.0

    def with_closure(result: Any) -> float:
        return factor * float(result.p_max[-1])

    before = code_checksum(with_closure)
    factor = 3.0
    assert code_checksum(with_closure) != before
    by_two, by_three = (functools.partial(scaled, by=by) for by in (2.0, 3.0))
    assert (
        code_checksum(by_two)
        == code_checksum(functools.partial(scaled, by=2.0))
        != code_checksum(by_three)
    )
    assert code_checksum(functools.partial(scaled, offset=1.0)) != code_checksum(scaled)
    whole = code_checksum(scaled)
    globals()["SCALE"] = 2.0
    try:
        assert code_checksum(scaled) != whole
    finally:
        globals()["SCALE"] = 1.0
    assert code_checksum(scaled) == whole
    sources = [
        "def f(r):\n    'one'\n    return r + 1\n",
        "def f(r):\n\n    'two'  # words\n    return r + 1\n",
        "def f(r):\n    'one'\n    return r + 2\n",
        "def f(r):\n    'one'\n    return r - 1\n",
    ]
    progress = []
    for source in sources:
        room: dict[str, Any] = {"__name__": "m"}
        exec(source, room)
        progress.append(code_checksum(room["f"]))
    assert progress[0] == progress[1]
    assert len(set(progress)) == 3
    array = np.arange(3.0)
    assert code_checksum(functools.partial(np.dot, array)) != code_checksum(
        functools.partial(np.dot, 2 * array)
    )
    threshold = fret.fracture.Threshold(dK_th=1e6, dS_0=3e8)
    alternative = fret.fracture.Threshold(dK_th=2e6, dS_0=3e8)
    assert code_checksum(fret.study.Arrest(threshold)) != code_checksum(
        fret.study.Arrest(alternative)
    )


def test_what_cannot_be_told_needs_a_version() -> None:
    """An open file, a lock: a change of them cannot be detected."""
    with Path(__file__).open(encoding="utf-8") as file:

        def lines(result: Any) -> float:
            return float(len(file.readlines()))

        with pytest.raises(ValueError, match="give it a version"):
            code_checksum(lines)
        lines.version = 1  # type: ignore[attr-defined]
        first = code_checksum(lines)
        lines.version = 2  # type: ignore[attr-defined]
        assert code_checksum(lines) != first


def test_a_store_of_other_code_is_refused(tmp_path: Path) -> None:
    """Code of a measure and of the function of scenes counts."""
    path = tmp_path / "s.zarr"
    values = {"mu": [0.3]}
    solved(values, functools.partial(scaled, by=1.0), out=path)
    solved(values, functools.partial(scaled, by=1.0), out=path)
    with pytest.raises(fret.errors.StoreError, match="the code of the measure scaled"):
        solved(values, functools.partial(scaled, by=2.0), out=path)

    def scenes(W: float) -> Any:
        return lambda values: SCENE.replace(
            path=fret.LoadPath.start().normal(W, increments=1), friction=values["mu"]
        )

    path = tmp_path / "f.zarr"
    for W, refused in ((10.0, False), (10.0, False), (20.0, True)):
        call = functools.partial(
            fret.study.run,
            scenes(W),
            values,
            measure="p_max",
            executor=SAME_PROCESS,
            progress=False,
        )
        if refused:
            with pytest.raises(fret.errors.StoreError, match="differ in scene"):
                call(out=path)
        else:
            call(out=path)


@pytest.mark.parametrize("name", ["status", "reason", "nx", "seconds", "mu", "a/b", ".x", ""])
def test_names_that_the_study_needs_are_no_measures(name: str) -> None:
    """Names of functions and of their numbers are refused."""

    def measure(result: Any) -> Any:
        return {name: 1.0}

    study = solved({"mu": [0.3]}, measure)
    assert study.count()["failed"] == 1
    assert "name" in study.failed()[0][1]
    if name:
        measure.__name__ = name
        with pytest.raises(ValueError, match="measure"):
            solved({"mu": [0.3]}, measure)


def test_measures_that_give_one_name_are_refused() -> None:
    """Two functions whose mappings have a key in common."""

    def one(result: Any) -> Any:
        return {"a": 1.0}

    def two(result: Any) -> Any:
        return {"a": 2.0}

    study = solved({"mu": [0.3]}, [one, two])
    assert "two measures give a" in study.failed()[0][1]


def test_a_table_names_what_it_leaves_out() -> None:
    """A field has no column."""

    def profile(result: Any) -> xr.DataArray:
        return result.at(-1).p.isel(y=4)  # type: ignore[no-any-return]

    study = solved({"mu": [0.2, 0.4]}, ["p_max", profile])
    with pytest.warns(UserWarning, match=r"profile \(over x\)"):
        table = study.to_dataframe()
    assert list(table["p_max [Pa]"].round()) == list(study.dataset.p_max.values.round())


def test_a_study_in_memory_is_that_of_a_store(tmp_path: Path) -> None:
    """Variables, values, types and attributes are the same."""

    def profile(result: Any) -> xr.DataArray:
        return result.at(-1).p.isel(y=4)  # type: ignore[no-any-return]

    def fails(result: Any) -> float:
        if float(result.mu) > 0.3:
            raise ArithmeticError("no number")
        return math.pi

    for measures in (["p_max", profile], ["p_max", fails]):
        item = [
            solved({"mu": [0.2, 0.4]}, measures, out=out) for out in (None, tmp_path / "s.zarr")
        ]
        kept, stored = (study.dataset.drop_vars("seconds") for study in item)
        kept.attrs.pop("study"), stored.attrs.pop("study")
        xr.testing.assert_identical(kept.drop_encoding(), stored.drop_encoding())
        import shutil

        shutil.rmtree(tmp_path / "s.zarr")
