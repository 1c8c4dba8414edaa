"""An alumina ball on titanium with hard carbon on chromium, under a given shift."""

import pyfret as fret

alumina, titanium = fret.Elastic(E=380e9, nu=0.23), fret.Elastic(E=114e9, nu=0.34)
dlc = fret.Coating(fret.Elastic(E=200e9, nu=0.25), thickness=3e-6)
chromium = fret.Coating(fret.Elastic(E=279e9, nu=0.21), thickness=0.5e-6)
ball = fret.Body(alumina, shape=fret.Sphere(R=5e-3))
flat = fret.Body(titanium, coatings=[dlc, chromium])
hertz = fret.reference.hertz(R=5e-3, bodies=(ball, flat), W=10.0)
grid = fret.Grid.centred(width=2.4 * hertz.a, n=128)
scene = fret.Scene(body1=ball, body2=flat, friction=0.15, grid=grid, title="DLC on titanium")
path = fret.LoadPath.start().normal(10.0).cycles(1, delta_x=0.1e-6)
result = fret.solve(scene, path)
print(result.summary())  # states, energy per cycle, energy ratio, stiffness
below = result.at(-1).stress()  # depths chosen from the layers
for measure in ("von_mises", "interface_shear"):
    print(measure, below.maximum(measure))
figure = result.plot(units="SI")  # without units over a_H, p_H and the Hertz approach
figure.savefig("dlc_on_titanium.png")
