"""Questions about one run share the stress below it: their answers do not depend on their order."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import pyfret as fret
from pyfret.fracture.below import Cycle

STEEL, TITANIUM = fret.Elastic(E=210e9, nu=0.3), fret.Elastic(E=114e9, nu=0.34)
W, R, MU = 2e5, 0.05, 0.6
CRITERIA = ("crossland", "dang_van")


@pytest.fixture(scope="module")
def rig() -> fret.Result:
    """A coated line contact over one cycle of shear."""
    film = fret.Elastic(E=300e9, nu=0.25)
    coating = fret.Coating(film, thickness=4e-5, residual=-100e6)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=R)),
        body2=fret.Body(TITANIUM, coatings=[coating], residual=20e6),
        friction=MU,
        grid=fret.Grid.strip(extent=1.2e-3, n=24),
    )
    path = fret.LoadPath.start().normal(W, increments=1).cycles(1, T_x=0.5 * MU * W, increments=2)
    return fret.solve(scene, path, save="all", progress=False)


def answers(run: fret.Result, order: str) -> dict[str, tuple[float, ...]]:
    """Ask for lives, load factors and the history of a place, in an order."""
    numbers: dict[str, tuple[float, ...]] = {}
    for letter in order:
        if letter == "l":
            lives = fret.fatigue.lives(run, "titanium_6Al4V", CRITERIA)
            worst = (lives[name].worst for name in CRITERIA)
            numbers["lives"] = tuple(
                x for point in worst for x in (point.value, point.error, *point.place)
            )
        elif letter == "f":
            least = run.load_factors(900e6).least("shakedown")
            numbers["factors"] = (least.value, least.error, *least.place)
        else:
            numbers["elsewhere"] = (
                float(run.life("titanium_6Al4V", "dang_van", x=0.0).worst.value),
            )
    return numbers


@pytest.mark.solves
@pytest.mark.parametrize("order", ["fl", "xlf"])
def test_answers_do_not_depend_on_what_was_asked_before(rig: fret.Result, order: str) -> None:
    alone = {}
    for question in sorted(set(order)):
        alone |= answers(fret.Result(rig.dataset), question)
    together = answers(fret.Result(rig.dataset), order)
    assert together == alone


@pytest.mark.solves
def test_another_dataset_has_its_own_stress(rig: fret.Result) -> None:
    first = fret.Result(rig.dataset.copy(deep=True))
    value = first.load_factors(900e6).least("von_mises").value
    for name in ("p", "q_x"):
        first.dataset[name].values[...] *= 0.5
    halved = first.load_factors(900e6).least("von_mises").value
    assert halved > 1.2 * value
    assert first.shared
    for copied in (copy.copy(first), copy.deepcopy(first), pickle.loads(pickle.dumps(first))):
        assert not copied.shared


@pytest.mark.solves
def test_the_crack_opens_where_the_range_of_k_is_largest() -> None:
    """Directions that are sorted out on larger cells have smaller ranges on the grid as well."""
    body, ball = fret.Body(TITANIUM), fret.Body(STEEL, shape=fret.Sphere(R=5e-3))
    a = fret.reference.hertz(R=5e-3, bodies=(ball, body), W=20.0).a
    path = fret.LoadPath.start().normal(20.0, increments=2)
    for sign in (1, -1, 1):
        path = path.force(T_x=3.0 * sign, T_y=4.0 * sign, increments=2)
    grid = fret.Grid.centred(width=2.6 * a, n=16)
    run = fret.solve(
        fret.Scene(body1=ball, body2=body, friction=0.5, grid=grid),
        path,
        save="all",
        progress=False,
    )
    cycle = Cycle(run, -1, 2, None)
    lengths = (cycle.half_width * np.array([0.05, 0.1, 0.2, 0.4])).tolist()
    angles = np.radians(np.arange(0.0, 180.0, 30.0)) + 0.2
    places = [(end, phi, 0.0) for phi in angles.tolist() for end in cycle.outermost(phi)]
    chosen = cycle.contact.widest_range(places, lengths=lengths)

    def largest_range(mouth: tuple[float, float, float]) -> float:
        x, azimuth, offset = mouth
        K = cycle.contact.intensity(x=x, azimuth=azimuth, offset=offset, lengths=lengths)
        return float(np.ptp(K["K_I"], axis=0).max())

    ranges = [largest_range(mouth) for mouth in places]
    assert ranges[chosen] > 0.97 * max(ranges)
