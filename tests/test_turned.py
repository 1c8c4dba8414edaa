"""Random contacts that are turned and mirrored: largest stress, life, crack and load factor stay.

``make turned`` goes through forty of them; ``tests/test_places.py`` has two in every run.
"""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass, replace

import numpy as np
import pytest

import pyfret as fret
from pyfret import fatigue, shapes

STEEL = fret.Elastic(E=210e9, nu=0.3)
W, RADIUS, N = 60.0, 0.01, 48
#: Range of K below which a crack counts as shut [Pa m^0.5]: thresholds are a hundred times that.
SHUT = 1e4
SCENES = int(os.environ.get("FRET_TURNED", "1"))


@dataclass(frozen=True)
class Drawn:
    """A contact whose first radius and whose shear lie at angles to the x axis."""

    radii: tuple[float, float]
    coating: tuple[float, float] | None
    mu: float
    part: float
    shape_angle: float
    shear_angle: float

    def turned(self, by: float) -> Drawn:
        """Return the same scene turned about z."""
        return replace(self, shape_angle=self.shape_angle + by, shear_angle=self.shear_angle + by)

    def mirrored(self) -> Drawn:
        """Its image in the plane y = 0."""
        return replace(self, shape_angle=-self.shape_angle, shear_angle=-self.shear_angle)

    def numbers(self) -> dict[str, float]:
        """Largest stresses, life, load factor and crack, where they are looked for by default."""
        E_star = STEEL.E / (2.0 * (1.0 - STEEL.nu**2))
        R_x, R_y = self.radii
        a = fret.reference.hertz_ellipse(R_x=R_x, R_y=R_y, E_star=E_star, W=W)
        extent = 2.7 * max(a.a_x, a.a_y)
        coatings = []
        if self.coating is not None:
            E, thickness = self.coating
            coatings.append(fret.Coating(fret.Elastic(E=E, nu=0.3), thickness=thickness))
        ball = shapes.Ellipsoid(R_x=R_x, R_y=R_y, angle=self.shape_angle)
        T = self.part * self.mu * W
        x, y = T * np.cos(self.shear_angle), T * np.sin(self.shear_angle)
        path = fret.LoadPath.start().normal(W, increments=1)
        for sign in (1.0, -1.0, 1.0):
            path = path.force(T_x=sign * x, T_y=sign * y, increments=4)
        scene = fret.Scene(
            body1=fret.Body(STEEL, shape=ball),
            body2=fret.Body(STEEL, coatings=coatings),
            friction=self.mu,
            grid=fret.Grid.centred(width=extent, n=N),
            path=path,
        )
        steel = fatigue.Materials()["steel_42CrMo4"]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = fret.solve(scene, progress=False, save="all")
            below = result.at(-1).stress()
            return {
                "s_1": below.maximum("s_1").value,
                "von_mises": below.maximum("von_mises").value,
                "margin": result.life(steel, "crossland").worst.margin,
                "factor": result.load_factors(900e6).least("von_mises").value,
                "dK": float(result.crack(lengths=[0.3 * min(a.a_x, a.a_y)]).dK().max()),
            }


def drawn(random: np.random.Generator) -> Drawn:
    """A ball or an ellipse of up to 1.5 to 1, bare or coated, sheared along an axis of it."""
    ratio = float(random.choice([1.0, random.uniform(1.2, 2.0)]))
    coating = None
    if random.random() < 0.5:
        coating = (float(210e9 * 2 ** random.uniform(-1, 1)), float(random.uniform(2e-5, 6e-5)))
    return Drawn(
        radii=(RADIUS * ratio**0.5, RADIUS / ratio**0.5),
        coating=coating,
        mu=float(random.uniform(0.2, 0.6)),
        part=float(random.uniform(0.4, 0.85)),
        shape_angle=0.0,
        shear_angle=float(random.choice([0.0, np.pi / 2])),
    )


@pytest.mark.slow
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("seed", range(SCENES))
def test_numbers_do_not_depend_on_how_a_scene_is_turned(seed: int) -> None:
    random = np.random.default_rng(seed)
    scene, angle = drawn(random), float(random.uniform(0.0, np.pi / 2))
    right = scene.numbers()
    turned = scene.turned(angle)
    for alternative in (turned, turned.mirrored()):
        for name, computed in alternative.numbers().items():
            least = SHUT if name == "dK" else 0.0
            about = (name, scene, np.degrees(angle))
            assert computed == pytest.approx(right[name], rel=0.01, abs=least), about
