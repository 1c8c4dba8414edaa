"""
The planes at the worst point
=============================

At the trailing edge of a fretting contact the stress turns as it grows. What acts on every plane
through the worst point, the critical one by Findley's criterion among them, and the path of the
point in Dang Van's plane, with the limit of the material.
"""

import matplotlib.pyplot as plt

import pyfret as fret
from pyfret import fatigue

steel = fret.Elastic(E=210e9, nu=0.3)
W, mu = 30.0, 0.6
a = fret.reference.hertz(R=5e-3, bodies=(steel, steel), W=W).a
scene = fret.Scene(
    body1=fret.Body(steel, shape=fret.Sphere(R=5e-3)),
    body2=fret.Body(steel),
    friction=mu,
    grid=fret.Grid.centred(width=2.6 * a, n=48),
)
T = 0.8 * mu * W
path = fret.LoadPath.start().normal(W, increments=2).tangential([T, -T, T], increments=24)
result = fret.solve(scene, path, save="all", progress=False)
material = fatigue.Materials()["steel_30NCD16"]
worst = result.life(material, "findley").worst
stress = fatigue.history(result, [worst.z], y=0.0).sel(x=worst.x, method="nearest").isel(depth=0)

assessed = material.assessment("findley")
fret.plot.critical_plane_rose(stress, assessed.criterion)

figure, ax = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
fret.plot.dang_van_diagram(stress, material=material, ax=ax)
