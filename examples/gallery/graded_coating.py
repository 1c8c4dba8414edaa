"""
A graded coating in 1, 3 and 12 layers
======================================

A modulus that falls from twice that of the substrate at the surface to that of the substrate, in
steps: the stress that acts along the surface jumps at each, and the jumps vanish with the number
of layers.
"""

import matplotlib.pyplot as plt

import pyfret as fret

steel = fret.Elastic(E=210e9, nu=0.3)
W = 10.0
a = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=W).a

figure, ax = plt.subplots(layout="constrained")
for layers in (1, 3, 12):
    coating = fret.graded(
        E=fret.Profile.linear(top=420e9, bottom=210e9),
        nu=fret.Profile.constant(0.3),
        thickness=a,
        layers=layers,
    )
    scene = fret.Scene(
        body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
        body2=fret.Body(steel, coatings=coating),
        friction=0.0,
        grid=fret.Grid.centred(width=2.4 * a, n=48),
        path=fret.LoadPath.start().normal(W, increments=1),
    )
    below = fret.solve(scene, progress=False).at(-1).stress(x=0.0, y=0.0)
    ax.plot(below.s_xx / below.dataset.attrs["p_H"], below.dataset.z / a, label=f"{layers}")
ax.invert_yaxis()
ax.set(xlabel="s_xx / p_H below the middle", ylabel="z / a_H")
ax.legend(title="layers")
