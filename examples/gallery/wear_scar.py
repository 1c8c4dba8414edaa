"""
A wear scar in partial slip
===========================

A sphere under a tangential force below the limit of friction wears in the annulus that slips,
until the contact has shrunk to the stick zone (V. L. Popov, Sci. Rep. 4 (2014) 3749).
"""

import matplotlib.pyplot as plt

import pyfret as fret

steel = fret.Elastic(E=200e9, nu=0.3)
W, mu = 50.0, 0.6
a = fret.reference.hertz(R=0.01, bodies=(steel, steel), W=W).a
scene = fret.Scene(
    body1=fret.Body(steel, shape=fret.Sphere(R=0.01)),
    body2=fret.Body(steel),
    friction=mu,
    grid=fret.Grid.centred(width=2.8 * a, n=48),
)
T = 0.5 * mu * W
path = fret.LoadPath.start().normal(W, increments=1).tangential([T, -T, T], increments=18)
law = fret.wear.Archard(k=1e-14)
result = fret.wear.solve(scene, path=path, cycles=1e6, first_branch=2, body2=law, progress=False)
fret.plot.wear_profiles(result, of="both")
plt.gcf().set_layout_engine("constrained")
