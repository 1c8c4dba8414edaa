"""
Coefficients from a frequency response
======================================

The conversion by an inverse transform on an enlarged domain, with and without alias sums, against
the closed form of a half-space: the cut-off of the response at the wave number of the cells makes
ripples and an error at the loaded cell.
"""

import matplotlib.pyplot as plt
import numpy as np

import pyfret as fret

grid = fret.Grid.from_spacing((24, 24), (1e-5, 1e-5))
body = fret.Body(fret.Elastic(E=210e9, nu=0.3))
exact = fret.kernels.influence_coefficients(body, grid)[2, 2, 23:, 23]

figure, ax = plt.subplots(layout="constrained")
for aliases in (0, 2):
    mine = fret.kernels.convert(
        lambda k_x, k_y: fret.kernels.surface_frf(body, k_x, k_y),
        grid,
        enlargement=16,
        aliases=aliases,
    )[2, 2, 23:, 23]
    ax.semilogy(np.abs(mine / exact - 1), "o-", label=f"{aliases}")
ax.set(xlabel="distance [cells]", ylabel="relative error of u_z under p")
ax.legend(title="order of alias sums")
