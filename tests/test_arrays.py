"""The door for arrays: labels, missing values, kinds, and what belongs together."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import pyfret as fret
from pyfret import fatigue
from pyfret._util.arrays import COMPONENTS, histories, plain, together

HISTORY = 1e8 * np.random.default_rng(3).normal(size=(5, 2, 3, 6))
LABELLED = xr.DataArray(
    HISTORY,
    dims=("increment", "depth", "x", "component"),
    coords={
        "increment": np.arange(5),
        "z": ("depth", [0.0, 1e-5]),
        "x": [0.0, 1e-5, 2e-5],
        "component": list(COMPONENTS),
    },
)
#: The same stress with its axes and components in other orders.
ORDERS = {
    "as it is": LABELLED,
    "components by name": LABELLED.sortby("component"),
    "depth first": LABELLED.transpose("depth", "increment", "x", "component"),
    "component first": LABELLED.transpose("component", "x", "increment", "depth"),
    "time by another name": LABELLED.rename(increment="time"),
    "backwards in time": LABELLED.isel(increment=slice(None, None, -1)),
}
FINDLEY = fatigue.Criterion.findley(k=0.3)
MATERIAL = fatigue.Materials()["steel_42CrMo4"]
JUDGES: dict[str, Callable[[Any], Any]] = {
    "evaluate": lambda s: fatigue.evaluate_criterion(s, FINDLEY).value,
    "assess": lambda s: fatigue.evaluate_margin(s, MATERIAL, "crossland").safety_factor,
    "first_yield": lambda s: fatigue.first_yield(s, s_y=9e8).tresca,
    "moving_load": lambda s: fatigue.moving_load(s, s_y=9e8),
}


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("judge", JUDGES)
def test_a_history_is_taken_by_its_labels(judge: str, order: str) -> None:
    computed = JUDGES[judge](ORDERS[order])
    if isinstance(computed, xr.DataArray):
        computed = computed.transpose("depth", "x").values
    elif order == "component first":
        # Without labels the axes are those that came in.
        computed = computed.T
    np.testing.assert_allclose(computed, JUDGES[judge](HISTORY), rtol=1e-6)


def test_results_keep_the_labels_that_came_in() -> None:
    fields = fatigue.evaluate_criterion(LABELLED, FINDLEY)
    assert fields.value.dims == ("depth", "x")
    np.testing.assert_array_equal(fields.x, LABELLED.x)
    np.testing.assert_array_equal(fields.z, LABELLED.z)
    assert fields.normal.dims == ("depth", "x", "axis")
    assert fatigue.evaluate_criterion(HISTORY, FINDLEY).value.dims == ("dim_0", "dim_1")


@pytest.mark.parametrize(
    "wrong",
    [
        LABELLED.drop_vars("component"),
        LABELLED.rename(increment="load"),
        LABELLED.assign_coords(component=list("abcdef")),
        LABELLED.isel(component=slice(5)),
    ],
)
def test_labels_that_say_nothing_are_refused(wrong: xr.DataArray) -> None:
    with pytest.raises(ValueError, match="component"):
        histories(wrong)


@pytest.mark.parametrize(
    ("values", "error"),
    [
        (True, TypeError),
        ([1.0, True], TypeError),
        (np.array([True, False]), TypeError),
        (np.array([1.0 + 0.0j]), TypeError),
        (np.array([1.0, None], dtype=object), TypeError),
        (["1.0"], TypeError),
        (np.array(["2020-01-01"], dtype="M8[D]"), TypeError),
        ([1.0, np.nan], ValueError),
        ([np.inf], ValueError),
        (np.ma.masked_array([1.0, 2.0], mask=[False, True]), ValueError),
        (xr.DataArray(np.zeros((2, 2)), dims=("a", "b")), TypeError),
        (pd.DataFrame({"a": [1.0], "b": [2.0]}), TypeError),
    ],
)
def test_no_numbers_are_refused(values: Any, error: type[Exception]) -> None:
    with pytest.raises(error, match="value"):
        plain(values, "value")


def test_numbers_of_every_kind_are_taken() -> None:
    for values in (1, 2.0, [1, 2.5], np.arange(3, dtype="i2"), np.float32(1.5), pd.Series([1, 2])):
        np.testing.assert_array_equal(plain(values, "value"), np.asarray(values, dtype=float))


def test_a_hole_is_masked_or_nan() -> None:
    masked = np.ma.masked_array([1.0, 9.0, 3.0, 4.0], mask=[False, True, False, False])
    first, second = together(holes=True, one=masked, other=[1.0, 2.0, np.nan, 4.0])
    np.testing.assert_array_equal([first, second], [[1.0, 4.0], [1.0, 4.0]])


def test_points_are_not_paired_by_place_where_they_have_names() -> None:
    force = pd.Series([1.0, 2.0, 3.0], index=[0, 1, 2])
    approach = 1e-6 * force
    with pytest.raises(ValueError, match="other labels"):
        fret.fit.Indentation.from_arrays(force, approach.sort_index(ascending=False))
    with pytest.raises(ValueError, match="as many"):
        fret.fit.Scar.from_arrays([0.0, 1.0], [0.0], wear={})
    assert fret.fit.Indentation.from_arrays(force, approach).W.size == 3


STEEL = fret.Elastic(E=210e9, nu=0.3)
GRID = fret.Grid.from_spacing((4, 3), (1e-5, 2e-5))
FIELD = xr.DataArray(
    np.arange(12.0).reshape(4, 3) * 1e6,
    dims=("x", "y"),
    coords={"x": GRID.x, "y": GRID.y},
)
#: What takes a field of the cells, or of the points of a map.
FIELDS: dict[str, Callable[[Any], Any]] = {
    "displacement": lambda p: fret.SurfaceOperator(
        fret.Body(STEEL), fret.Body(STEEL), GRID
    ).displacement(p=p),
    "stress": lambda p: fret.subsurface.stress(fret.Body(STEEL), GRID, [1e-5], p=p, y=0.0).s_zz,
    "map": lambda z: fret.SurfaceMap(1e-15 * z, spacing=(1e-5, 2e-5)).values,
}


@pytest.mark.parametrize("take", FIELDS)
def test_a_field_is_taken_by_its_coordinates(take: str) -> None:
    """The order is free; coordinates of another grid are refused."""
    right = np.asarray(FIELDS[take](FIELD.values))
    for same in (FIELD, FIELD.T, FIELD[::-1], FIELD.T[::-1], FIELD.drop_vars("x")):
        np.testing.assert_allclose(FIELDS[take](same), right, rtol=1e-12)
    for alternative, pattern in (
        (FIELD.assign_coords(x=1e3 * GRID.x), "along x lie"),
        (FIELD.assign_coords(y=range(3)), "along y lie"),
        (FIELD.assign_coords(x=[0.0, 1e-5, 2e-5, 4e-5]), "evenly spaced"),
        (FIELD.rename(x="i"), "order is not known|must be an array"),
    ):
        with pytest.raises((ValueError, TypeError), match=pattern):
            FIELDS[take](alternative)


def test_a_table_of_wear_is_pairs_of_numbers() -> None:
    for wrong, pattern in (
        (np.ma.masked_equal([[0.0, 1.0], [9.0, 2.0]], 2.0), "masked"),
        ([(0.0, True), (9.0, False)], "no numbers"),
        (pd.DataFrame({"cycles": [0.0, 9.0], "factor": [1.0, 2.0]}), "order is not known"),
        ({0.0: 1.0, 9.0: 2.0}, "must be a list"),
        ([0.0, 1.0, 2.0], "pair|list"),
        ([(0.0, 1.0), (9.0, np.nan)], "finite"),
    ):
        with pytest.raises((ValueError, TypeError), match=pattern):
            fret.wear.Archard(1e-14, factor=("cycles", wrong))
    table = fret.wear.Archard(1e-14, factor=("cycles", np.array([[0.0, 1.0], [9.0, 2.0]])))
    assert table.factor == ("cycles", ((0.0, 1.0), (9.0, 2.0)))


class Liar(list[Any]):
    """A list whose length claims to be very large."""

    def __len__(self) -> int:
        return 1 << 60


def test_what_a_list_says_of_its_length_is_not_handed_on() -> None:
    for call in (
        lambda: fret.wear.Wear(cycles=1.0, body2=Liar([fret.wear.Archard(1e-14)])).document(),
        lambda: fatigue.first_yield(HISTORY, s_y=3e8, constant=Liar([0.0] * 6)),
    ):
        assert call() is not None
