"""
How hot a fretting contact gets
===============================

An alumina ball that slides to and fro on a titanium alloy, 60 cycles a second. Both surfaces have
the same temperature where they touch; alumina conducts five times as well and takes most of the
heat.
"""

import matplotlib.pyplot as plt

import pyfret as fret
from pyfret import fatigue

table = fatigue.Materials()
alumina, titanium = table["alumina"], table["titanium_6Al4V"]
ball, flat = (fret.Elastic(E=m.number("E"), nu=m.number("nu")) for m in (alumina, titanium))
a = fret.reference.hertz(R=5e-3, bodies=(ball, flat), W=20.0).a
scene = fret.Scene(
    body1=fret.Body(ball, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(flat),
    friction=0.4,
    grid=fret.Grid.centred(width=3.0 * a, n=48),
)
path = fret.LoadPath.start().normal(20.0, increments=1)
path = path.displace(delta_x=[20e-6, -20e-6, 20e-6], increments=60)
result = fret.solve(scene, path, save="all", progress=False)
found = result.temperature(alumina, titanium, frequency=60.0)

figure, axes = plt.subplots(2, 1, figsize=(6.4, 6.4), layout="constrained")
fret.plot.temperature(found, ax=axes[0])
fret.plot.temperature_map(found, of="flash", ax=axes[1])
