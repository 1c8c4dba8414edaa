"""
Fretting loops under a given shift
==================================

A steel ball on titanium, three amplitudes of the shift: from partial slip, where the middle of
the contact sticks and the loop is narrow, to gross slip, where the force stays at the limit of
friction.
"""

import matplotlib.pyplot as plt

import pyfret as fret

ball = fret.Body(fret.Elastic(E=210e9, nu=0.3), shape=fret.Sphere(R=5e-3))
flat = fret.Body(fret.Elastic(E=114e9, nu=0.34))
W, mu = 10.0, 0.3
a = fret.reference.hertz(R=5e-3, bodies=(ball, flat), W=W).a
scene = fret.Scene(body1=ball, body2=flat, friction=mu, grid=fret.Grid.centred(width=2.4 * a, n=48))

figure, ax = plt.subplots(layout="constrained")
for delta_x in (0.2e-6, 0.5e-6, 1.0e-6):
    path = fret.LoadPath.start().normal(W, increments=4).cycles(1, delta_x=delta_x, increments=40)
    result = fret.solve(scene, path, progress=False)
    fret.plot.fretting_loop(result, ax=ax, units="SI", label=f"{1e6 * delta_x:g} µm")
ax.legend(title="amplitude")
