"""One manner for all results: summary, figure, page, file, notebook view, names."""

from __future__ import annotations

import re
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pyfret as fret
from conftest import W, sphere_on_flat
from pyfret import _core
from pyfret.fit.data import Loops, Measured
from pyfret.fit.outcome import FitResult, Known

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore::UserWarning")]


def path() -> fret.LoadPath:
    """A cycle of partial slip under a bulk stress in phase."""
    start = fret.LoadPath.start().normal(W, increments=1)
    for sign in (1.0, -1.0, 1.0):
        start = start.force(T_x=50.0 * sign, sigma_B=4e7 * sign, increments=2)
    return start


def results() -> dict[str, Any]:
    """One of every kind."""
    scene = sphere_on_flat(n=16)
    run = fret.solve(scene, path(), save="all", progress=False)
    worn = fret.wear.solve(
        scene,
        path=path(),
        cycles=100,
        body2=fret.wear.Archard(1e-15),
        first_branch=2,
        jumps=2,
        progress=False,
    )
    study = fret.study.run(
        scene.replace(path=path()),
        {"mu": [0.3, 0.4]},
        measure="p_max",
        executor=ThreadPoolExecutor(1),
        progress=False,
    )
    loops = Loops.from_arrays(
        delta=np.array([0.0, 1e-6, 0.0, -1e-6, 0.0]), T=np.array([0.0, 5.0, 0.0, -5.0, 0.0]), W=W
    )
    measured = Measured(loops, loops.T, loops.delta, ("shift [um]", "force [N]"))
    computed = FitResult(
        known={"friction.mu": Known(0.4, 0.38, 0.42, 0.01, 0.005, at_bound=False)},
        offsets={"offset of the force [N]": 0.1},
        offset_errors={"offset of the force [N]": 0.01},
        correlation=np.ones((1, 1)),
        residual=[np.zeros(5)],
        computed=[loops.T],
        sets=[measured],
        noise=[0.0],
        solves=3,
        solver_known=True,
        converged=True,
        scene=scene.replace(path=path()),
    )
    return {
        "Result": run,
        "WearResult": worn,
        "Study": study,
        "FitResult": computed,
        "Cracks": run.crack(0.0, lengths=np.geomspace(1e-6, 1e-4, 5)),
    }


@pytest.fixture(scope="module")
def every() -> dict[str, Any]:
    """The results, computed once."""
    return results()


KINDS = ["Result", "WearResult", "Study", "FitResult", "Cracks"]


@pytest.mark.parametrize("kind", KINDS)
def test_every_result_has_the_same_manner(
    every: dict[str, Any], kind: str, tmp_path: Path, request: pytest.FixtureRequest
) -> None:
    item = every[kind]
    assert type(item).__name__ == kind
    summary = item.summary()
    assert summary
    assert item._repr_html_()
    drawn = item.plot()
    assert hasattr(getattr(drawn, "figure", drawn), "savefig")
    request.getfixturevalue("without_overview")
    item.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "http" not in page.replace("http://www.w3.org", "").split("<body")[0]
    names = [str(name) for name in item.dataset.data_vars if kind not in ("FitResult", "Result")]
    assert set(names) <= set(dir(item))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("ending", ["zarr", "nc"])
def test_what_is_saved_is_opened_as_what_it_was(
    every: dict[str, Any], kind: str, ending: str, tmp_path: Path
) -> None:
    item, path = every[kind], tmp_path / f"saved.{ending}"
    item.save(path)
    with pytest.raises(FileExistsError, match=r"already.*overwrite=True"):
        item.save(path)
    item.save(path, overwrite=True)
    again = fret.open(path)
    assert type(again) is type(item)
    assert again.summary() == item.summary()
    if kind != "Result":
        assert again == item


def test_overwriting_takes_no_other_file(every: dict[str, Any], tmp_path: Path) -> None:
    alternative = tmp_path / "mine.zarr"
    alternative.mkdir()
    (alternative / "notes.txt").write_text("mine")
    for item in every.values():
        with pytest.raises(FileExistsError, match="no store or file of results"):
            item.save(alternative, overwrite=True)
    assert (alternative / "notes.txt").read_text() == "mine"


def test_the_summary_has_the_bulk_stress(every: dict[str, Any]) -> None:
    summary = every["Result"].summary()
    titles, units, _, *rows = summary.partition("\nt ")[2].splitlines()
    assert "sigma_B" in titles
    assert "[MPa]" in units
    assert any(" -40 " in row for row in rows), summary


#: What nobody reads: more digits than are known, a negative zero, a place that is zero to rounding.
UNREAD = re.compile(
    r"\d\.\d{7,}|\d{7,}\.\d|(?<![\d.eE+-])-0(\.0*)?(?![\d.])|e-1[0-9] ?[nuµm]?m(?![\w^])"
)


@pytest.mark.parametrize("kind", KINDS)
def test_numbers_are_those_that_a_person_reads(every: dict[str, Any], kind: str) -> None:
    item = every[kind]
    texts = {"summary": item.summary(), "repr": repr(item)}
    if kind == "Result":
        life = item.life("7075", "crossland")
        texts |= {"life": repr(life), "worst": repr(life.worst), "page": life._repr_html_()}
        texts |= {"largest": repr(item.at(-1).stress().maximum()), "zone": repr(item.at(-1))}
    if kind == "WearResult":
        texts["cycles"] = repr(item.cycles_to(depth=0.3 * float(item.depth2[-1])))
    if kind == "Cracks":
        texts["verdict"] = repr(item.arrest(fret.fracture.Threshold(dK_th=1e6)))
    for name, text in texts.items():
        assert not UNREAD.findall(text), (name, text)


def test_the_search_for_numbers_that_nobody_reads() -> None:
    for text in (
        "W = 5.0000000000000036 N",
        "inclination=-0.0 degrees",
        "2.2e-16 m",
        "182345.6789",
    ):
        assert bool(UNREAD.findall(text)) == (text != "182345.6789"), text
    for text in ("182345.678901234", "1823456.7"):
        assert UNREAD.findall(text), text
    assert not UNREAD.findall("-0.04 to 1e-05 mm, 12.35 um")


def test_places_are_zero_where_they_are_zero_to_rounding(every: dict[str, Any]) -> None:
    """Every search for a largest value rounds places of a centred contact."""
    run = every["Result"]
    size = max(run.scene.grid.nx * run.scene.grid.dx, run.scene.grid.ny * run.scene.grid.dy)
    life = [run.life("7075", name).worst for name in ("crossland", "findley")]
    life += [run.at(-1).stress().maximum(name) for name in ("von_mises", "s_1", "s_xx")]
    for at in life:
        for position in (at.x, at.y):
            assert position == 0.0 or abs(position) >= 1e-9 * size, at
    assert _core.rounded_place(-2e-16, 1e-3) == 0.0
    assert _core.rounded_place(2e-6, 1e-3) == 2e-6
    assert _core.degrees(-1e-9) == "0 degrees"


def test_dir_of_a_result_has_its_numbers(every: dict[str, Any]) -> None:
    assert {"T_x", "p_max", "contact_radius", "W"} <= set(dir(every["Result"]))
    assert {"depth2", "volume2"} <= set(dir(every["WearResult"]))


def test_a_saved_fit_makes_nothing_but_parts_of_a_fit(
    every: dict[str, Any], tmp_path: Path
) -> None:
    dataset = every["FitResult"].dataset
    text = dataset.attrs["found"].replace('"part": "Known"', '"part": "Path"')
    dataset.assign_attrs(found=text, kind="FitResult").to_netcdf(tmp_path / "fit.nc")
    with pytest.raises(fret.errors.StoreError, match=r"fit.nc: is no fit"):
        fret.open(tmp_path / "fit.nc")
