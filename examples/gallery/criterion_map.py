"""
A coating with a residual stress
================================

Dang Van's criterion below a coated contact over a cycle of partial slip, as deposited and with a
compressive residual stress: where it is dark a crack is near, and the bold line is the limit.
"""

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from pyfret import fatigue

steel = fret.Elastic(E=210e9, nu=0.3)
hard = fret.Elastic(E=400e9, nu=0.25)
W, mu = 10.0, 0.4
a = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=W).a
scene = fret.Scene(
    body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(steel, coatings=fret.Coating(hard, thickness=0.3 * a)),
    friction=mu,
    grid=fret.Grid.centred(width=3.0 * a, n=48),
)
T = 0.7 * mu * W
path = fret.LoadPath.start().normal(W, increments=2).tangential([T, -T, T], increments=10)
result = fret.solve(scene, path, save="all", progress=False)
z = np.linspace(0.0, 0.9 * a, 46)
material = fatigue.Materials()["steel_30NCD16"]
cooled = fret.subsurface.thermal_stress(
    hard, alpha_coating=9.4e-6, alpha_substrate=12e-6, temperature_change=-400.0
)

figure, axes = plt.subplots(2, 1, figsize=(6.4, 6.4), layout="constrained")
for ax, residual in zip(axes, (0.0, cooled), strict=True):
    life = result.life([material, material], "dang_van", z, residual=[residual, 0.0])
    fret.plot.criterion_map(life, ax=ax)
    ax.set_title(f"residual stress of the coating {residual / 1e6:.0f} MPa")
