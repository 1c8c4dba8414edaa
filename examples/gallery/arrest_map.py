"""
Where fretting cracks stop
==========================

Titanium pads of 50 mm radius under 400 N/mm: shear over bulk stress. Initiation (Smith, Watson and
Topper, full lines) begins long before failure: between them cracks start and stop.
"""

import numpy as np

import pyfret as fret
from pyfret import fatigue, fracture

titanium = fret.Elastic(E=117e9, nu=0.31)
scene = fret.Scene(
    body1=fret.Body(titanium, shape=fret.Cylinder(R=0.05)),
    body2=fret.Body(titanium),
    friction=0.6,
    grid=fret.Grid.strip(extent=1.7e-3, n=96),
)
table = fret.study.arrest_map(
    scene,
    W=4e5,
    T=np.linspace(2e4, 2.2e5, 6),
    sigma_B=np.linspace(0.0, 3.5e8, 6),
    arrest=fret.study.Arrest(fracture.Threshold(dK_th=2.5e6, dS_0=300e6)),
    cracking=fret.study.Cracking(fatigue.Materials()["titanium_6Al4V"], "smith_watson_topper"),
)
ax = fret.plot.arrest_map(table)
