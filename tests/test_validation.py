"""The machinery of the validation book on small grids."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from validation import pages, runner
from validation.truth import Known, order
from validation.truths import TRUTHS, bodies
from validation.worn import Worn, WornCylinder, WornSphere

import pyfret as fret

HERTZ = bodies.PAGES[0]


def test_order_is_the_slope_of_the_error() -> None:
    sizes = (16, 32, 64)
    assert order(sizes, [n**-2.0 for n in sizes]) == pytest.approx(2.0)
    assert np.isnan(order(sizes, [1.0, 0.0, 0.0]))


def test_errors_are_over_the_truth_or_the_scale() -> None:
    assert Known(1.1, 1.0).error == pytest.approx(0.1)
    assert Known(1.1, -1.0, 2.0).error == pytest.approx(1.05)


def test_every_page_has_a_name_of_its_own() -> None:
    names = [truth.name for truth in TRUTHS]
    assert len(set(names)) == len(names)


@pytest.mark.solves
def test_a_page_says_what_was_run(tmp_path: Path) -> None:
    outcome = runner.run(replace(HERTZ, grids=(32, 64)))
    grids = outcome.grids
    # The largest pressure, between four cells, converges with the square of the cell.
    assert grids.order("p_max") > 1.5
    # The rim is found within a twentieth of a cell.
    x = outcome.finest.dataset.x.values
    a = grids.known[-1]["a"]
    assert abs(a.ours - a.truth) < 0.05 * (x[1] - x[0])
    pages.write(outcome, tmp_path)
    text = (tmp_path / "hertz.md").read_text(encoding="utf-8")
    assert "| 64 |" in text
    assert "observed order" in text
    assert {f.name for f in tmp_path.iterdir()} == {"hertz.md", "hertz.png", "hertz_error.png"}
    assert "hertz.md" in pages.front_row(outcome)


def test_error_bars_tell_their_parts() -> None:
    fine = fret.solve(HERTZ.scene(64), progress=False, error=True)
    bars = fine.error_bars()
    assert bars.sizes == {"branch": 1, "part": 4}
    total, cells = (bars.sel(part=part).isel(branch=0) for part in ("total", "cells"))
    # Without friction the increments leave nothing, and the solver little but in single cells.
    assert float(total.p_max) == pytest.approx(
        float(np.hypot(cells.p_max, bars.sel(part="solver").isel(branch=0).p_max)), rel=0.1
    )
    for name in ("delta_z", "contact_radius"):
        assert float(total[name]) == pytest.approx(float(cells[name]), rel=0.1)
    for name, truth in (("p_max", bodies.ROUND.p0), ("delta_z", bodies.ROUND.delta_z)):
        error = abs(float(fine.at(-1).dataset[name]) - truth)
        assert 0.2 < error / float(total[name]) < 1.5
    p = fine.at(-1).p.values
    truth = bodies.ROUND.p(bodies.distance(fine.at(-1)))
    error = np.linalg.norm(p - truth) / np.linalg.norm(p)
    assert 0.2 < error / float(total.p) < 1.5
    with pytest.raises(ValueError, match="error=True"):
        fret.solve(HERTZ.scene(32), progress=False).error_bars()
    with pytest.warns(fret.errors.SceneWarning, match="20 or more cells"):
        few = fret.solve(HERTZ.scene(16), progress=False, error=True)
    assert few.status == "done"
    assert any("20 or more cells" in doubt for doubt in few.doubts)


@pytest.mark.parametrize("cells", [24, 33, 48, 64])
def test_error_bars_of_coarser_grids_cover_hertz(cells: int) -> None:
    result = fret.solve(HERTZ.scene(cells), progress=False, error="coarser")
    bars = result.error_bars().sel(part="total").isel(branch=0)
    last = result.at(-1).dataset
    for name, truth in (
        ("p_max", bodies.ROUND.p0),
        ("delta_z", bodies.ROUND.delta_z),
        ("contact_radius", bodies.ROUND.a),
    ):
        error_bar = float(bars[name])
        ratio = abs(float(last[name]) - truth) / error_bar
        assert ratio < 1.5, name
        assert error_bar < 0.07 * truth, name
    with pytest.raises(TypeError, match='True, False, or "coarser"'):
        fret.solve(HERTZ.scene(cells), progress=False, error="finest")


@pytest.mark.parametrize(
    ("amplitude", "c", "approach", "p", "b", "deepest", "volume"),
    [
        (0.5, 0.793701, 1.049934, 1.058267, 1.136091, 0.094485, 0.132158),
        (0.7, 0.669433, 1.145248, 1.190103, 1.258594, 0.219995, 0.517739),
    ],
)
def test_a_worn_sphere_has_known_numbers(
    amplitude: float, c: float, approach: float, p: float, b: float, deepest: float, volume: float
) -> None:
    worn = WornSphere(amplitude)
    computed = (worn.c, worn.approach, worn.p(np.zeros(1))[0], worn.b, worn.deepest, worn.volume)
    assert computed == pytest.approx((c, approach, p, b, deepest, volume), abs=6e-7)


@pytest.mark.parametrize("amplitude", [0.3, 0.7])
@pytest.mark.parametrize(
    ("kind", "force"), [(WornSphere, 2 * np.pi / 3), (WornCylinder, np.pi / 2)]
)
def test_the_pressure_of_a_worn_contact_carries_the_whole_force(
    kind: type[Worn], force: float, amplitude: float
) -> None:
    worn = kind(amplitude)
    # x = c sin(t) takes the root singularity at c away.
    t = (np.arange(4000) + 0.5) * np.pi / 8000
    x, weight = worn.c * np.sin(t), worn.c * np.cos(t) * np.pi / 8000
    assert (worn.p(x) * worn.measure(x) * weight).sum() == pytest.approx(force, rel=1e-6)


def test_a_worn_cylinder_has_the_area_of_its_integral() -> None:
    worn = WornCylinder(0.5)
    remainder = worn.b**2 - worn.c**2
    assert worn.volume == pytest.approx(
        np.sqrt(remainder) * (worn.b**2 - 1 - remainder / 3), rel=1e-6
    )
