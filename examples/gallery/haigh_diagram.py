"""
Mean and amplitude on the critical planes
=========================================

Haigh's diagram of all points below a ball over a cycle of partial slip, on the planes of Smith,
Watson and Topper's criterion: pulled at the trailing edges, pressed below the contact.
"""

import matplotlib.pyplot as plt

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
table = fatigue.Materials()
life = result.life(table["steel_4340"], "smith_watson_topper")

figure, ax = plt.subplots(figsize=(7.2, 4.2), layout="constrained")
fret.plot.haigh_diagram(life, material=table["steel_30NCD16"], ax=ax)
