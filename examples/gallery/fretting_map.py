"""
The fretting map
================

Running conditions, crack risk and frictional energy of a steel ball on a steel flat over the normal
force and the stroke, in one call. In partial slip the energy is small and cracks decide; in gross
slip the energy, and with it wear, is ten times as much. Dotted: the depth at which a semicircular
crack stops (threshold and fatigue limit are to be those of your steel).
"""

import numpy as np

import pyfret as fret
from pyfret import fatigue, fracture

steel = fret.Elastic(E=210e9, nu=0.3)
ball = fret.Body(steel, shape=fret.Sphere(R=5e-3))
scene = fret.Scene(
    body1=ball,
    body2=fret.Body(steel),
    friction=0.7,
    grid=fret.Grid.centred(width=3.6e-4, n=24),
)
table = fret.study.running_conditions(
    scene,
    W=np.linspace(5.0, 20.0, 4),
    delta=np.linspace(0.15e-6, 1.2e-6, 5),
    increments=(3, 10),
    cracking=fret.study.Cracking(fatigue.Materials()["steel_42CrMo4"], "crossland"),
    arrest=fret.study.Arrest(fracture.Threshold(dK_th=3e6, dS_0=400e6), aspect=1.0),
)
ax = fret.plot.fretting_map(table)
