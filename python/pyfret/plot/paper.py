"""The figures of the paper, in one call.

S. Spinu, Numerical Study on the Influence of the Coating in the Fretting Contact, Tribology in
Industry 42 (2020) 131-145, doi:10.24874/ti.2020.42.01.13.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np

from pyfret._core import CattaneoMindlin
from pyfret._util.theme import CATEGORIES, REFERENCE
from pyfret.plot.histories import fretting_loop, load_path, stick_ratio
from pyfret.plot.maps import label_scale, shear_streamlines
from pyfret.plot.profiles import pressure_profile, shear_profile, shear_profiles
from pyfret.plot.stresses import stress_maps
from pyfret.plot.style import style
from pyfret.quantities import quantities

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from pyfret.run import Run, State

#: Line of each ratio E1/E2 wherever several share the axes.
RATIO_COLOURS = dict(zip((0.5, 2.0, 4.0, 1.0), (*CATEGORIES[:3], CATEGORIES[-1]), strict=True))


def name(ratio: float) -> str:
    """Label the ratio of the moduli."""
    return f"$E_1/E_2 = {ratio:g}$"


def loading_history(result: Run, jump: Run) -> Figure:
    """Draw figure 5: tractions after indentation, with and without the load path."""
    figure, (left_axes, right) = plt.subplots(1, 2, figsize=(7.6, 3.2))
    ends = result.dataset.branch_of_increment.values
    indented = int(np.flatnonzero(ends == ends[0])[-1]) + 1
    curves: list[tuple[State, str, dict[str, Any]]] = [
        (result.at(indented), f"{indented} increments", {"color": RATIO_COLOURS[2.0]}),
        (jump.at(-1), "history left out", {"color": "0.25", "linestyle": "--"}),
    ]
    for run, label, line in curves:
        pressure_profile(run, ax=left_axes, label=label, **line)
        shear_profile(run, ax=right, label=label, **line)
    left_axes.set_title("(a)  pressure")
    right.set_title("(b)  shear")
    left_axes.legend(loc="lower center")
    return figure


def similar_bodies(result: Run) -> Figure:
    """Draw figure 6: shear along the loop of similar bodies over the closed form, in grey."""
    figure, ax = plt.subplots(figsize=(6.4, 4.2))
    r = np.linspace(-1.1, 1.1, 1101)
    for increment in result.dataset.saved_increment.values:
        q = mindlin_shear(result, int(increment), np.abs(r) * result.a_H)
        ax.plot(r, q / (result.mu * result.p_H), color=REFERENCE, linewidth=3.5, alpha=0.5)
    ax.lines[0].set_label("closed form")
    shear_profiles(result, ax=ax)
    return figure


def mindlin_shear(result: Run, increment: int, r: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return q_x in closed form at the distance `r` after an increment of a cycle of +-T_m."""
    scene = result.scene
    hertz = scene.hertz
    T = result.dataset.T_x.values[:increment]
    turns = np.flatnonzero(np.diff(np.sign(np.diff(T, prepend=0.0))[T != 0.0]))
    if hertz is None or not T.any():
        return np.zeros_like(r)
    bodies = (scene.body1.substrate, scene.body2.substrate)
    contact = CattaneoMindlin(hertz, bodies=bodies, mu=scene.mu)
    if turns.size == 0:
        return contact.q_loading(r, T=T[-1])
    back = contact.q_unloading if turns.size % 2 else contact.q_reloading
    return back(r, T=T[-1], T_m=np.abs(T).max())


def profiles(result: Run, ratio: float) -> Figure:
    """Draw figure 7: shear along the fretting loop."""
    figure, ax = plt.subplots(figsize=(6.4, 4.2))
    shear_profiles(result, ax=ax)
    ax.set_title(name(ratio))
    return figure


def streamlines(results: Mapping[float, Run], times: tuple[float, ...]) -> Figure:
    r"""Draw figures 8 to 10: directions of the shear at the given :math:`t/\tau`."""
    shown = [
        (ratio, results[ratio].at(t * tau(results[ratio])), t) for ratio in results for t in times
    ]
    n = len(shown)
    figure, row = plt.subplots(1, n, figsize=(0.9 + 3.0 * n, 3.4), sharey=True, squeeze=False)
    largest = max(float(snapshot.q_max) / (snapshot.mu * snapshot.p_H) for _, snapshot, _ in shown)
    for ax, letter, (ratio, snapshot, t) in zip(row[0], "abcdef", shown, strict=False):
        shear_streamlines(snapshot, ax=ax, largest=largest, colorbar=False)
        ax.set_title(rf"({letter})  {name(ratio)},  $t = {t:g}\,\tau$")
        ax.label_outer()
        # One for all panels, which keep the line for their titles.
        if (legend := ax.get_legend()) is not None:
            legend.remove()
    entries = {
        text: line
        for ax in row[0]
        for line, text in zip(*ax.get_legend_handles_labels(), strict=True)
    }
    if entries:
        figure.legend(list(entries.values()), list(entries), loc="outside lower center")
    label_scale(row[0][0].images[0], row[0][-1], r"$|q|/(\mu\, p_H)$")
    return figure


def tau(result: Run) -> float:
    """Path time at the end of the load history."""
    return float(result.dataset.t[-1])


def stick_areas(results: Mapping[float, Run]) -> Figure:
    """Draw figure 11: the stick area of every ratio, and its difference to the ratio 1."""
    if 1.0 not in results or len(results) == 1:
        return compare(stick_ratio, results, loc="lower center", ncols=4, columnspacing=1.2)
    figure, (whole, apart) = plt.subplots(1, 2, figsize=(7.6, 3.4))
    same = results[1.0]
    for ratio, result in sorted(results.items()):
        colour = RATIO_COLOURS.get(ratio)
        stick_ratio(result, ax=whole, label=name(ratio), color=colour, linewidth=1.0)
        t = result.dataset.t.values / tau(result)
        reference_ratio = np.interp(t, same.dataset.t.values / tau(same), same.stick_ratio.values)
        apart.plot(t, result.stick_ratio.values - reference_ratio, color=colour, linewidth=1.0)
    whole.legend(loc="lower center", ncols=2, columnspacing=1.2)
    whole.set_title("(a)")
    apart.set_title("(b) difference from $E_1/E_2 = 1$")
    apart.set_xlabel(r"$t/\tau$")
    apart.set_xlim(0, 1)
    apart.set_ylabel(r"$\Delta(A_\mathrm{st}/A_\mathrm{c})$")
    return figure


def compare(draw: Callable[..., Axes], results: Mapping[float, Run], **legend: Any) -> Figure:
    """Draw figure 12: the same curve of every ratio."""
    figure, ax = plt.subplots()
    for ratio, result in sorted(results.items()):
        draw(result, ax=ax, label=name(ratio), color=RATIO_COLOURS.get(ratio))
    ax.legend(**legend)
    return figure


@quantities
def paper_figures(
    results: Mapping[float, Run],
    out: str | os.PathLike[str],
    *,
    jump: Run | None = None,
) -> list[Path]:
    """Draw figures 4 to 13 of the paper into the folder `out`; give the files written.

    Parameters
    ----------
    results : mapping of float to Result
        The run of each ratio E1/E2 of the moduli of coating and substrate. A figure is drawn if
        the ratios it shows are there.
    out : path
        Folder of the figures, made if need be.
    jump : Result, optional
        The indentation of E1/E2 = 2 in one single increment, for figure 5.
    """
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    figures: dict[str, Figure] = {}
    with style():
        first = next(iter(results.values()))
        figures["04"], ax = plt.subplots()
        load_path(first, ax=ax)
        if jump is not None and 2.0 in results:
            figures["05"] = loading_history(results[2.0], jump)
        if 1.0 in results:
            figures["06"] = similar_bodies(results[1.0])
        for letter, ratio in zip("abc", (0.5, 2.0, 4.0), strict=True):
            if ratio in results:
                figures[f"07{letter}"] = profiles(results[ratio], ratio)
        if 0.5 in results and 2.0 in results:
            figures["08"] = streamlines({r: results[r] for r in (0.5, 2.0)}, (0.1,))
        for number, ratio in (("09", 0.5), ("10", 2.0)):
            if ratio in results:
                figures[number] = streamlines({ratio: results[ratio]}, (0.8, 0.9, 1.0))
        figures["11"] = stick_areas(results)
        figures["12"] = compare(fretting_loop, results, loc="upper left")
        coated = {r: results[r] for r in (0.5, 2.0, 4.0) if r in results}
        if coated:
            figures["13"] = stress_maps(coated)
        paths = []
        for number, figure in figures.items():
            paths.append(folder / f"figure_{number}.png")
            figure.savefig(paths[-1])
            plt.close(figure)
    return paths
