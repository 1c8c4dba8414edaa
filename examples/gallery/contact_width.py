"""
The width of a contact under a bulk stress
==========================================

Cylinders of an aluminium-copper alloy on a flat that is pulled to and fro, all with the same peak
pressure, shear and bulk stress, so that the stress at their surfaces is the same: only the size of
the field differs. Below a critical width such specimens had infinite lives (D. Nowell, D. A. Hills,
Wear 136 (1990) 329-343).

The Smith-Watson-Topper parameter at the surface knows nothing of the width. Its mean over a
critical distance does: with L = (dK_th/(2 s_D))^2/pi it passes the limit of a smooth specimen,
s_D^2/E, at a half-width of 0.44 mm.

Where the numbers are from: the abstract of the paper tells the alloy, that the width alone was
varied, and that lives were infinite below a critical one, which is the trend shown here. The loads,
p_0 = 157 MPa, bulk stress 92.7 MPa, T = 0.45 mu W, mu = 0.75, the threshold dK_th = 4.2 MPa m^0.5
and the limit s_D = 124 MPa are those under which these tests are quoted (J. A. Araujo, D. Nowell,
Int. J. Fatigue 24 (2002) 763-775); they were not read again in the papers, nor was the critical
width, some tenths of a millimetre. Lives do not follow: they would need a strain-life curve of this
alloy.
"""

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret
from pyfret import fatigue

mu, p_0, bulk = 0.75, 157e6, 92.7e6
alloy = fret.Elastic(E=74e9, nu=0.33)
E_star = alloy.E / (2 * (1 - alloy.nu**2))
s_D = 124e6
L = (4.2e6 / (2 * s_D)) ** 2 / np.pi
swt = fatigue.Criterion.smith_watson_topper(E=alloy.E, nu=alloy.nu)
half_widths = np.array([0.1, 0.19, 0.28, 0.38, 0.57, 0.76, 0.95, 1.14]) * 1e-3


def largest(a: float) -> tuple[float, float]:
    """SWT at the surface, and of the mean stress down to 2 L, the largest of all places [Pa]."""
    W = np.pi * a * p_0 / 2
    cylinder = fret.Body(alloy, shape=fret.Cylinder(R=E_star * a / (2 * p_0)))
    grid = fret.Grid.strip(extent=5 * a, n=192)
    scene = fret.Scene(body1=cylinder, body2=fret.Body(alloy), friction=mu, grid=grid)
    path = fret.LoadPath.start().normal(W, increments=1)
    for way, increments in ((1, 4), (-1, 6), (1, 6)):
        path = path.force(T_x=way * 0.45 * mu * W, sigma_B=way * bulk, increments=increments)
    result = fret.solve(scene, path, save="all", progress=False)
    depths = (np.arange(40) + 0.5) / 40 * 2 * L
    stress = fatigue.history(result, [0.0, *depths], y=0.0)
    surface = fatigue.evaluate_criterion(stress.isel(depth=[0]), swt).value.max()
    mean = fatigue.evaluate_criterion(
        stress.isel(depth=slice(1, None)).mean("depth"), swt
    ).value.max()
    return float(surface), float(mean)


found = np.array([largest(a) for a in half_widths])
figure, ax = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
for values, label in zip(
    found.T, ("at the surface", f"mean down to 2 L = {2e3 * L:.2f} mm"), strict=True
):
    ax.plot(1e3 * half_widths, values / 1e6, "o-", markersize=4, label=label)
limit = s_D**2 / alloy.E / 1e6
ax.axhline(limit, color="0.4", linestyle="--", linewidth=1, label="limit of a smooth specimen")
ax.set(xlabel="half-width of the contact [mm]", ylabel="Smith-Watson-Topper [MPa]", ylim=(0, None))
ax.legend(loc="center right", bbox_to_anchor=(1.0, 0.7))
