"""
Does the crack stop?
====================

Normal cracks at the rim of a titanium pad under half of the sliding force, without and with a bulk
stress in phase: range of K over the length, its threshold, and Kitagawa and Takahashi's diagram.
"""

import matplotlib.pyplot as plt

import pyfret as fret
from pyfret import fracture

titanium = fret.Elastic(E=117e9, nu=0.31)
threshold = fracture.Threshold(dK_th=2.5e6, dS_0=300e6)
scene = fret.Scene(
    body1=fret.Body(titanium, shape=fret.Cylinder(R=0.05)),
    body2=fret.Body(titanium),
    friction=0.6,
    grid=fret.Grid.strip(extent=1.6e-3, n=128),
)
figure, axes = plt.subplots(2, 2, figsize=(7.2, 6.0), layout="constrained")
for (left, right), bulk in zip(axes, (0.0, 300e6), strict=True):
    path = fret.LoadPath.start().force(W=4e5, increments=2)
    for T, sigma_B in ((1.2e5, bulk), (-1.2e5, 0.0), (1.2e5, bulk)):
        path = path.force(T_x=T, sigma_B=sigma_B, increments=12)
    cracks = fret.solve(scene, path, save="all", progress=False).crack()
    fret.plot.crack_arrest(cracks, threshold, ax=left)
    fret.plot.kitagawa(cracks, threshold, ax=right)
    left.set_title(f"bulk stress {bulk / 1e6:.0f} MPa")
