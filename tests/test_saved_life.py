"""A life is kept in the manner of all results: saved, opened, written as a table, as a page."""

from __future__ import annotations

import csv
import importlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyfret as fret

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]


@pytest.fixture
def public(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Objects of every kind."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    return importlib.import_module("public")


@pytest.mark.parametrize("ending", ["zarr", "nc"])
def test_a_saved_life_is_the_same_life(public: Any, tmp_path: Path, ending: str) -> None:
    steel = public.MATERIALS["steel_42CrMo4"]
    coated = public.RUN.life([steel, steel], "findley", y=0.0)
    for life in (public.LIFE, public.BARE.life(steel, "crossland"), coated):
        path = tmp_path / f"{life.dataset.criterion}.{ending}"
        life.save(path)
        opened = fret.open(path)
        assert type(opened) is type(life)
        assert opened == life
        assert (opened.layers, opened.worst, opened.range) == (life.layers, life.worst, life.range)
        assert repr(opened) == repr(life)
        assert opened._repr_html_() == life._repr_html_()
        with pytest.raises(ValueError, match="saved or unpickled has no stress: judge the result"):
            opened.over_distance([1e-5])
        opened.report(tmp_path / "life.html")
        assert opened.summary().splitlines()[0].split(" at ")[0] in " ".join(
            (tmp_path / "life.html").read_text().split()
        )
    over = public.LIFE.over_distance()
    over.save(tmp_path / f"over.{ending}")
    assert fret.open(tmp_path / f"over.{ending}") == over


def test_what_holds_no_life_is_refused_by_name(public: Any, tmp_path: Path) -> None:
    public.LIFE.dataset.assign_attrs(kind="Life", found="{}").to_netcdf(tmp_path / "none.nc")
    with pytest.raises(fret.errors.StoreError, match=r"none\.nc: is no life"):
        fret.open(tmp_path / "none.nc")


def test_a_life_says_over_which_distance_it_is_averaged(public: Any) -> None:
    life = public.LIFE
    assert life.L == life.range.L == pytest.approx(public.ALLOY.critical_distance())
    assert f"mean over L = {1e6 * life.L:.2f} um" in repr(life)
    point = public.RUN.life([public.ALLOY, None], "smith_watson_topper", y=0.0)
    assert point.L is None
    assert "value at a point" in repr(point)
    with pytest.raises(AttributeError, match=r"an Extremum has no 'L': .*life.L"):
        _ = life.worst.L


def test_tables_have_units_in_their_head(public: Any, tmp_path: Path) -> None:
    """Every result has one; each column equals the dataset."""
    results = {
        "life": (public.LIFE, "life [cycles]"),
        "over": (public.LIFE.over_distance(), "L [m]"),
        "wear": (public.WORN, "depth2 [m]"),
        "cracks": (public.CRACKS, "K_I [Pa m^0.5]"),
        "study": (public.STUDY, "body1.shape.sphere.R [m]"),
        "run": (public.RUN, "T_x [N]"),
    }
    for name, (entry, column) in results.items():
        entry.to_csv(tmp_path / f"{name}.csv")
        with (tmp_path / f"{name}.csv").open() as file:
            rows = list(csv.DictReader(file))
        assert column in rows[0], (name, list(rows[0]))
        values = entry.dataset[column.split(" [")[0]]
        computed = {float(row[column]) for row in rows}
        assert computed == {float(value) for value in np.unique(values)}
