"""
Fatigue below a fretting contact
================================

Findley's parameter on the section y = 0 over one cycle of partial slip. It is largest at the
edges of the contact, where cracks of fretting begin.
"""

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from pyfret import fatigue

steel = fret.Elastic(E=210e9, nu=0.3)
W, mu = 10.0, 0.5
a = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=W).a
scene = fret.Scene(
    body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(steel),
    friction=mu,
    grid=fret.Grid.centred(width=2.8 * a, n=48),
)
T = 0.7 * mu * W
path = fret.LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=10)
result = fret.solve(scene, path, save="all", progress=False)
z = np.linspace(0.0, a, 16)
stress = fatigue.history(result, z=z, y=0.0)
value = fatigue.evaluate_criterion(stress, fatigue.Criterion.findley(k=0.3)).value

figure, ax = plt.subplots(figsize=(7.2, 3.6), layout="constrained")
shown = ax.contourf(scene.grid.x / a, z / a, value / 1e6, 14)
ax.invert_yaxis()
ax.set(xlabel="x / a_H", ylabel="z / a_H")
figure.colorbar(shown, label="Findley's parameter [MPa]")
