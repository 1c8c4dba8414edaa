"""
Error against the number of cells
=================================

Hertz's contact: numbers (radius, peak pressure, approach) fall with the square of the cell,
fields with the cell, since the outermost cells carry up to a tenth more or less than the pressure
at their centres.
"""

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

steel = fret.Elastic(E=210e9, nu=0.3)
R, W = 0.018, 1e3
hertz = fret.reference.hertz(R=R, bodies=(steel, steel), W=W)
cells = np.array([16, 24, 32, 48, 64, 96, 128, 192])
errors: dict[str, list[float]] = {"p (L2)": [], "p_max": [], "delta_z": []}
for n in cells:
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=R)),
        body2=fret.Body(steel),
        friction=0.0,
        grid=fret.Grid.centred(width=2.4 * hertz.a, n=int(n)),
        path=fret.LoadPath.start().normal(W, increments=1),
    )
    last = fret.solve(scene, progress=False).at(-1)
    p = last.p.values
    truth = hertz.p(np.hypot(*np.meshgrid(scene.grid.x, scene.grid.y, indexing="ij")))
    errors["p (L2)"].append(float(np.linalg.norm(p - truth) / np.linalg.norm(truth)))
    errors["p_max"].append(abs(float(last.p_max) / hertz.p0 - 1))
    errors["delta_z"].append(abs(float(last.delta_z) / hertz.delta_z - 1))

figure, ax = plt.subplots(layout="constrained")
for name, error in errors.items():
    ax.loglog(cells, error, "o-", label=name)
ax.set(xlabel="cells a side", ylabel="relative error")
ax.legend()
