"""
Soft and hard coatings
======================

Von Mises stress below the same ball for a coating of half and of four times the modulus of the
substrate: inside a soft coating, at the interface below a hard one.
"""

import matplotlib.pyplot as plt

import pyfret as fret

steel = fret.Elastic(E=210e9, nu=0.3)
W, mu = 10.0, 0.3
a = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=W).a

figure, axes = plt.subplots(2, 1, figsize=(7.2, 7.2), layout="constrained")
for ax, ratio in zip(axes, (0.5, 4.0), strict=True):
    coating = fret.Coating(fret.Elastic(E=ratio * 210e9, nu=0.3), thickness=0.5 * a)
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(steel, coatings=coating),
        friction=mu,
        grid=fret.Grid.centred(width=3.0 * a, n=64),
    )
    path = fret.LoadPath.start().normal(W, increments=4).tangential(0.9 * mu * W, increments=4)
    below = fret.solve(scene, path, progress=False).at(-1).stress()
    fret.plot.stress_map(below, ax=ax)
    ax.set_title(f"E1/E2 = {ratio:g}: {below.maximum().value / 1e9:.2f} GPa at most", pad=18)
