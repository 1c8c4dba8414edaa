"""Does it start, does it stop? Pads on titanium under bulk stress, bare and with 4 um of TiN."""

import numpy as np

import pyfret as fret
from pyfret import fracture

titanium, TiN = fret.Elastic(E=117e9, nu=0.31), fret.Elastic(E=600e9, nu=0.25)
material = fret.fatigue.Materials()["titanium_6Al4V"]
threshold = fracture.Threshold(dK_th=4.2e6, dS_0=500e6)  # yours: measured at R = 0 and -1
for name, coatings, residual in (
    ("bare", [], None),
    ("TiN", [fret.Coating(TiN, thickness=4e-6)], [-2.5e9, 0.0]),
):
    scene = fret.Scene(
        body1=fret.Body(titanium, shape=fret.Cylinder(R=0.05)),
        body2=fret.Body(titanium, coatings=coatings),
        mu=0.6,
        grid=fret.Grid.strip(extent=1.7e-3, n=256),
    )
    for bulk in np.linspace(0.0, 350e6, 8):
        path = fret.LoadPath.start().force(W=4e5, increments=1)
        for sign in (1.0, -1.0, 1.0):
            path = path.force(T_x=sign * 1e5, sigma_B=bulk * (sign > 0.0), increments=6)
        result = fret.solve(scene, path, save="all", progress=False)
        life = result.life(
            [None] * len(coatings) + [material], "smith_watson_topper", residual=residual
        )
        arrest = result.crack(residual=residual).arrest(threshold)
        print(
            f"{name}, {bulk / 1e6:.0f} MPa: starts after {life.worst.margin:.3g} cycles, {arrest}"
        )
