"""Scalars along the load path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret.plot.style import axes, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from pyfret._core import LoadPath
    from pyfret.results import Result


@styled
def fretting_loop(result: Result, *, ax: Axes | None = None, **line: Any) -> Axes:
    r"""Tangential force over relative shift, :math:`T_x/(\mu W_{max})` over :math:`\delta_x`.

    The shift is counted from the end of indentation and given in units of
    :math:`\mu a_H^2/R = \mu \delta_H`, the friction coefficient times the Hertz approach.
    The area of the loop is the work dissipated in a cycle.
    """
    ax = axes(ax)
    d = result.dataset
    started = np.flatnonzero(d.branch_of_increment.values == 0)[-1]
    shift = (d.delta_x - d.delta_x[started]) / (result.mu * result.delta_H)
    force = d.T_x / (result.mu * result.W_max)
    ax.plot(shift[started:], force[started:], **line)
    ax.set_xlabel(r"$\delta_1 / (\mu\, \delta_H)$")
    ax.set_ylabel(r"$T_1 / (\mu\, W_\mathrm{max})$")
    return ax


@styled
def stick_ratio(result: Result, *, ax: Axes | None = None, **line: Any) -> Axes:
    r"""Stick area over contact area along the load path, over :math:`t/\tau`."""
    ax = axes(ax)
    t = result.dataset.t
    ax.plot(t / t[-1], result.stick_ratio, **line)
    ax.set_xlabel(r"$t/\tau$")
    ax.set_ylabel(r"$A_\mathrm{st}/A_\mathrm{c}$")
    ax.set_xlim(0, 1)
    ax.set_ylim(0, 1.03)
    return ax


@styled
def load_path(path: LoadPath | Result, *, mu: float = 1.0, ax: Axes | None = None) -> Axes:
    r"""Normal and tangential force over :math:`t/\tau`.

    Both in units of the largest normal force; T over `mu` times it.
    """
    ax = axes(ax)
    loads = path.dataset if hasattr(path, "dataset") else path
    t, W, T = (np.r_[0.0, np.asarray(v)] for v in (loads.t, loads.W, loads.T_x))
    mu = getattr(path, "mu", mu)
    ax.plot(t / t[-1], W / W.max(), label=r"$W/W_\mathrm{max}$")
    ax.plot(t / t[-1], T / (mu * W.max()), label=r"$T_1/(\mu\, W_\mathrm{max})$")
    ax.set_xlabel(r"$t/\tau$")
    ax.set_xlim(0, 1)
    ax.legend(loc="lower left")
    return ax
