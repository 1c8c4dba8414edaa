"""
Film, interface or substrate?
=============================

A nitride film on titanium under a fretting pad with bulk stress: which of the three goes first over
the thickness of the film and the friction of the contact. Friction pulls the film apart behind the
pad and shears the interface, and a thicker film keeps the stress away from the substrate.
"""

import pyfret as fret
from pyfret import fracture

titanium, nitride = fret.Elastic(E=117e9, nu=0.31), fret.Elastic(E=450e9, nu=0.25)
path = fret.LoadPath.start().force(W=4e5, increments=1)
for T, sigma_B in ((1e5, 1.6e8), (-1e5, 0.0), (1e5, 1.6e8)):
    path = path.force(T_x=T, sigma_B=sigma_B, increments=3)
scene = fret.Scene(
    body1=fret.Body(titanium, shape=fret.Cylinder(R=0.05)),
    body2=fret.Body(titanium, coatings=[fret.Coating(nitride, thickness=2e-5)]),
    friction=0.6,
    grid=fret.Grid.strip(extent=1.7e-3, n=64),
    path=path,
).replace(save="all")
study = fret.study.run(
    scene,
    {
        "friction.mu": [0.3, 0.5, 0.7, 0.9],
        "body2.coatings.0.thickness": [1e-5, 2e-5, 4e-5, 6e-5],
    },
    measure=fret.study.FirstToFail(
        toughness=90.0,
        peel_strength=80e6,
        shear_strength=120e6,
        threshold=fracture.Threshold(dK_th=4.5e6, dS_0=540e6),
        residual=[-5e8, 0.0],
        x=-6.3e-4,  # the rim that trails when the bulk stress pulls
    ),
    progress=False,
)
ax = fret.plot.design_chart(study.dataset, "friction.mu", "body2.coatings.0.thickness")
