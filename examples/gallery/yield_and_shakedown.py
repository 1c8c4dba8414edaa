"""
Yield and shakedown below a ball
================================

Load over the limit of first yield (von Mises) and of elastic shakedown over a cycle of partial
slip, in a hard coating and its substrate, each with its own yield stress.
"""

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

steel = fret.Elastic(E=210e9, nu=0.3)
hard = fret.Elastic(E=400e9, nu=0.25)
W, mu = 10.0, 0.3
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
factors = result.load_factors([2.5e9, 0.8e9], z)

figure, axes = plt.subplots(2, 1, figsize=(6.4, 6.4), layout="constrained")
fret.plot.load_factor_map(factors, of="von_mises", ax=axes[0])
fret.plot.load_factor_map(factors, of="shakedown", ax=axes[1])
