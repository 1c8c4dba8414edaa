"""
Torsional fretting
==================

A ball turned to and fro about its axis: moment against rotation, beside Lubkin's closed form of
the first turn (J. L. Lubkin, J. Appl. Mech. 18 (1951) 183-187).
"""

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

steel = fret.Elastic(E=210e9, nu=0.3)
W, mu = 10.0, 0.3
hertz = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=W)
lubkin = fret.reference.Lubkin(hertz, bodies=(steel, steel), mu=mu)
scene = fret.Scene(
    body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(steel),
    friction=mu,
    grid=fret.Grid.centred(width=2.4 * hertz.a, n=48),
)
M = 0.8 * lubkin.M_limit
path = fret.LoadPath.start().normal(W, increments=1).cycles(1, M_z=M, increments=40)
result = fret.solve(scene, path, progress=False)

figure, ax = plt.subplots(layout="constrained")
fret.plot.fretting_loop(result, ax=ax, units="SI")
c = np.linspace(0.3, 0.999, 60) * hertz.a
first = lubkin.M_z(c) <= M
ax.plot(1e6 * lubkin.phi(c)[first], lubkin.M_z(c)[first], "k--", label="closed form, first turn")
ax.legend()
