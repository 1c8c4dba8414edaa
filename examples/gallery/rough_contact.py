"""
A rough contact under fretting
==============================

A self-affine roughness of 50 nm on a ball. The contact breaks up into spots; small spots slip
first. A measured surface would take the place of ``fret.shapes.Rough``.
"""

import matplotlib.pyplot as plt

import pyfret as fret

steel = fret.Elastic(E=210e9, nu=0.3)
W, mu = 10.0, 0.3
a = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=W).a
rough = fret.shapes.Rough(rms=50e-9, hurst=0.8, longest=a, shortest=a / 6, seed=4)
scene = fret.Scene(
    body1=fret.Body(steel, shape=fret.Sphere(R=5e-3) + rough),
    body2=fret.Body(steel),
    friction=mu,
    grid=fret.Grid.centred(width=2.8 * a, n=96),
)
path = fret.LoadPath.start().normal(W, increments=1).tangential(0.6 * mu * W, increments=4)
result = fret.solve(scene, path, progress=False)

figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4.2), layout="constrained")
fret.plot.pressure_map(result, ax=left, units="SI")
fret.plot.stick_slip(result, ax=right, units="SI")
