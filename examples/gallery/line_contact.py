"""
A cylinder with a bulk stress
=============================

Cattaneo's cylinder in partial slip. A bulk stress in the flat shifts the stick zone to one side
(D. Nowell, D. A. Hills, Int. J. Mech. Sci. 29 (1987) 355-365). Lines are the closed form, circles
the solution.
"""

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

steel = fret.Elastic(E=210e9, nu=0.3)
R, W, mu = 0.05, 2e5, 0.5
T = 0.5 * mu * W
line = fret.reference.line_contact(R=R, bodies=(steel, steel), W=W)
scene = fret.Scene(
    body1=fret.Body(steel, shape=fret.Cylinder(R=R)),
    body2=fret.Body(steel),
    friction=mu,
    grid=fret.Grid.strip(extent=2.4 * line.a, n=120),
)

figure, ax = plt.subplots(layout="constrained")
x = np.linspace(-line.a, line.a, 401)
for sigma_B in (0.0, 60e6):
    pressed = fret.LoadPath.start().normal(W, increments=1)
    path = pressed.force(T_x=T, sigma_B=sigma_B, increments=1)
    result = fret.solve(scene, path, progress=False)
    q = result.at(-1).q_x.values[:, 0]
    middle = line.stick_middle(eps_x=sigma_B * (1 - 0.3**2) / 210e9, mu=mu)
    (drawn,) = ax.plot(x / line.a, line.q(x, T=T, mu=mu, middle=middle) / (mu * line.p0))
    cells = scene.grid.x / line.a
    ax.plot(
        cells[::3],
        q[::3] / (mu * line.p0),
        "o",
        ms=3.5,
        color=drawn.get_color(),
        label=f"{sigma_B / 1e6:g} MPa",
    )
ax.set(xlabel="x / a", ylabel="q_x / (mu p_0)")
ax.legend(title="bulk stress")
