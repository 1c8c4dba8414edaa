"""Does it start, does it stop? Titanium pads under bulk stress, bare and with 4 um of TiN."""

import numpy as np

import pyfret as fret
from pyfret import fatigue, fracture

titanium, TiN = fret.Elastic(E=117e9, nu=0.31), fret.Elastic(E=600e9, nu=0.25)
pad = fret.Body(titanium, shape=fret.Cylinder(R=0.05))
film = fret.Coating(TiN, thickness=4e-6)
material = fatigue.Materials()["titanium_6Al4V"]
threshold = fracture.Threshold(dK_th=2.5e6, dS_0=300e6)  # yours, measured at R = 0
grid = fret.Grid.strip(extent=1.7e-3, n=256)
for layers, judged, residual in (([], [material], None), ([film], [None, material], [-2.5e9, 0.0])):
    scene = fret.Scene(
        body1=pad, body2=fret.Body(titanium, coatings=layers), friction=0.6, grid=grid
    )
    for bulk in (0.0, 100e6, 200e6, 350e6):
        path = fret.LoadPath.start().force(W=4e5, increments=1)
        for T, sigma_B in ((1e5, bulk), (-1e5, 0.0), (1e5, bulk)):
            path = path.force(T_x=T, sigma_B=sigma_B, increments=6)
        result = fret.solve(scene, path, save="all", progress=False)
        start = result.life(judged, "smith_watson_topper", residual=residual).worst.margin
        cracks = result.crack(-result.a_H, lengths=np.geomspace(1e-5, 1e-3, 16), residual=residual)
        print(f"{len(layers)} layers, {bulk:.3g} Pa: {start:.3g}", cracks.arrest(threshold).verdict)
