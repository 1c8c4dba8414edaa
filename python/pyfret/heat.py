"""How hot does it get? Surface temperature under the frictional heat of a cycle.

Both bodies are half-spaces with insulated surfaces outside the contact, and the cycle has repeated
itself until every one is like the last. ::

    steel = fret.heat.Conductor(conductivity=45.0, heat_capacity=3.6e6)
    found = result.temperature(steel, steel, frequency=50.0, bulk=293.0)
    found.attrs["maximum"], found.attrs["maximum_x"]
    fret.plot.temperature(found)

``docs/heat.md`` has the equations and their sources.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from pyfret import _core
from pyfret._core import Grid, Material
from pyfret._util.arrays import items
from pyfret._util.lazy import xr
from pyfret._util.material_names import as_material
from pyfret._util.names import listing
from pyfret._util.scene_warnings import doubts_of
from pyfret.fatigue.cycles import cycle_increments
from pyfret.quantities import Conductivity, Frequency, HeatCapacity, InSI, part, quantities

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pyfret.run import Run

__all__ = ["Conductor", "Conductors", "temperature"]
__dir__ = listing(__all__)

#: Largest default number of harmonics.
HARMONICS = 32


@part(kw_only=True)
class Conductor:
    """A material that conducts heat.

    Examples
    --------
    >>> Conductor(conductivity=45.0, heat_capacity=7800.0 * 460.0)
    Conductor(conductivity=45.0, heat_capacity=3588000.0)
    """

    #: Thermal conductivity [W/(m K)].
    conductivity: InSI[Conductivity]
    #: Heat capacity of the volume, density times specific heat [J/(m^3 K)].
    heat_capacity: InSI[HeatCapacity]

    @property
    def doubts(self) -> list[str]:
        """Numbers that are hardly meant, one sentence each."""
        return doubts_of("Conductor", **vars(self))

    @classmethod
    @quantities
    def from_material(cls, material: Material | str) -> Conductor:
        """Give what a material has as ``conductivity``, ``density`` and ``specific_heat``.

        A ValueError names the missing one.
        """
        table_material = as_material(material)
        conductivity = table_material.number("conductivity")
        heat_capacity = table_material.number("density") * table_material.number("specific_heat")
        return cls(conductivity=conductivity, heat_capacity=heat_capacity)


#: A material for all layers, or one for each from the surface down, the substrate's last.
Conductors = Conductor | Material | Sequence[Conductor | Material]


def _conductors_of_layers(conductors: Conductors, layers: int, name: str) -> list[Conductor]:
    """Return a conductor for each layer, the substrate last."""
    layers_or_one: Any = conductors
    several = isinstance(layers_or_one, list | tuple)
    conductor_list: list[Any] = items(layers_or_one, name) if several else [layers_or_one] * layers
    for conductor in conductor_list:
        if not isinstance(conductor, Conductor | Material):
            raise TypeError(
                f"{name} = {conductor!r:.60}: must be a Conductor or a Material, "
                "or one for each layer"
            )
    return [Conductor.from_material(c) if isinstance(c, Material) else c for c in conductor_list]


def _numbers(layers: list[Conductor]) -> list[tuple[float, float]]:
    """Return the numbers of the conductors as the core takes them."""
    return [(c.conductivity, c.heat_capacity) for c in layers]


def _ends(result: Run, kept: NDArray[np.int64], wave: str) -> NDArray[np.float64]:
    """Return the ends of the kept increments of a cycle as fractions of its period."""
    if wave not in ("sine", "linear"):
        raise ValueError(f'wave = {wave!r}: must be "sine" or "linear"')
    branch = result.dataset.branch_of_increment
    t = result.dataset.t
    parts = []
    period = 0.0
    for number in np.unique(branch.sel(increment=kept).values):
        before = t.values[branch.values < number]
        start = before[-1] if before.size else 0.0
        length = float(t.values[branch.values == number][-1]) - start
        in_branch = kept[branch.sel(increment=kept).values == number]
        along = (t.sel(increment=in_branch).values - start) / length
        if wave == "sine":
            along = np.arccos(np.clip(1.0 - 2.0 * along, -1.0, 1.0)) / np.pi
        parts.append(period + length * along)
        period += length
    return np.concatenate(parts) / period


def _heat(result: Run, kept: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return the work of every kept increment of a cycle [J/m^2], and the cells in contact."""
    branch = result.dataset.branch_of_increment
    whole = branch.increment.values[np.isin(branch.values, branch.sel(increment=kept).values)]
    before, last = int(whole[0]) - 1, int(whole[-1])
    saved = result.dataset.saved_increment.values
    missing = [n for n in (before, last) if n > 0 and n not in saved]
    if missing:
        raise ValueError(
            f"the fields of increment {missing[0]} were not kept: the heat of a cycle needs "
            "those at both of its ends; solve with save='all'"
        )
    works = [result.at(int(n)).dissipated_density.values for n in kept]
    start = result.at(before).dissipated_density.values if before else np.zeros_like(works[0])
    contact = np.any([result.at(int(n)).contact.values.astype(bool) for n in kept], axis=0)
    return np.diff(np.stack([start, *works]), axis=0), contact


def _maximum(table: xr.Dataset, bulk: tuple[float, float]) -> dict[str, Any]:
    """Return the largest temperature, its place and its body."""
    body, i, j = np.unravel_index(int(np.argmax(table.largest.values)), table.largest.shape)
    hottest = table.largest.values[body, i, j]
    return {
        "maximum": float(hottest),
        "maximum_x": float(table.x[i]),
        "maximum_y": float(table.y[j]),
        "maximum_body": int(body) + 1,
        "bulk": [float(temperature) for temperature in bulk],
    }


@quantities
def temperature(
    result: Run,
    conductor1: Conductors,
    conductor2: Conductors,
    *,
    frequency: Frequency,
    bulk: float | tuple[float, float] = 0.0,
    wave: Literal["sine", "linear"] = "sine",
    harmonics: int | None = None,
    cycle: int = -1,
) -> xr.Dataset:
    """Give the surface temperature of both bodies under the frictional heat of a closed cycle.

    The heat of each increment is set free at a constant rate. It rests on the cells that are in
    contact at any time of the cycle: slip is taken as small against the contact.

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle and the one before it.
    conductor1, conductor2 : Conductor, Material, or sequence of them
        Of each body one for all layers, or one for each from the surface down, the substrate's
        last; materials as in :meth:`Conductor.from_material`. The thicknesses are taken from the
        scene.
    frequency : float
        Cycles per second [Hz].
    bulk : float or two floats
        Temperature far from the contact, of both bodies or of each [K]; with 0 the result is the
        rise above it.
    wave : "sine" or "linear"
        How loads go in time along a branch: as half a period of a sine, or at a constant rate.
        Branches share the period as they share the path time t.
    harmonics : int, optional
        Harmonics of the heat in time; 0 for the mean alone (default: half the kept increments of
        the cycle, the most that these resolve, up to 32).
    cycle : int
        Which of the closed cycles; the last by default.

    Returns
    -------
    xarray.Dataset
        ``steady`` and ``largest`` over (body, x, y), mean and largest temperature of the cycle, and
        ``flash``, their difference. ``heat`` over (x, y), mean frictional heat [W/m^2]. ``share``
        is the part of it that flows into body 1, NaN where there is no heat. It is outside 0 to 1
        where heat that rises elsewhere crosses the contact. ``peak`` over ``time``, the largest
        temperature of the surfaces at each part of the period. Attributes: ``maximum`` with
        ``maximum_x``, ``maximum_y`` [m] and ``maximum_body``. ``maximum_error`` is its change on
        half of the harmonics and cells twice as wide, without the error of the heat itself. Further
        ones are ``heat_into_body1`` and ``heat_into_body2`` [W], ``bulk`` and ``frequency``.
        ``doubts`` has a line for each number of a conductor that is hardly meant.

    Raises
    ------
    ValueError
        There is no closed cycle, its increments were not kept, the contact is in plane strain, or a
        number is out of its range.

    Examples
    --------
    >>> steel = Conductor(conductivity=45.0, heat_capacity=3.6e6)
    >>> found = temperature(result, steel, steel, frequency=50.0)  # doctest: +SKIP
    """
    scene = result.scene
    for name, body in (("body1", scene.body1), ("body2", scene.body2)):
        if body.yields:
            raise ValueError(
                f"{name}.plastic: must be left out: the heat of plastic work is not computed; "
                "for the heat of friction solve the scene without plastic"
            )
    kept = cycle_increments(result, cycle)
    heat, contact = _heat(result, kept)
    body1, body2 = scene.body1, scene.body2
    ends = _ends(result, kept, wave).tolist()
    bulk = (bulk[0], bulk[1]) if isinstance(bulk, Sequence) else (bulk, bulk)
    if harmonics is None:
        harmonics = min(kept.size // 2, HARMONICS)
    if harmonics < 0:
        raise ValueError(f"harmonics = {harmonics}: must be 0 or more")
    layers1 = _conductors_of_layers(conductor1, len(body1.coatings) + 1, "conductor1")
    layers2 = _conductors_of_layers(conductor2, len(body2.coatings) + 1, "conductor2")
    doubts = [doubt for layer in (*layers1, *layers2) for doubt in layer.doubts]

    def solved(grid: Grid, heat: NDArray[np.float64], contact: NDArray[np.bool_]) -> dict[str, Any]:
        """Solve the temperature on a grid."""
        return _core.cycle_temperature(
            _numbers(layers1),
            _numbers(layers2),
            body1=body1,
            body2=body2,
            grid=grid,
            bulk=bulk,
            frequency=frequency,
            ends=ends,
            heat=heat,
            contact=contact,
            harmonics=harmonics,
            jumps=wave == "linear",
        )

    fine = solved(scene.grid, heat, contact)
    coarse = solved(*_on_coarser_cells(scene.grid, heat, contact))
    of_cells = float(fine["largest"].max() - coarse["largest"].max())
    table = _table(result, fine)
    area = scene.grid.dx * scene.grid.dy
    into1 = float(fine["flux"].sum() * area)
    yardsticks = {k: v for k, v in result.dataset.attrs.items() if k in ("a_H", "p_H")}
    return table.assign_attrs(
        yardsticks,
        **({"doubts": "\n".join(dict.fromkeys(doubts))} if doubts else {}),
        frequency=frequency,
        heat_into_body1=into1,
        heat_into_body2=float(fine["heat"].sum() * area) - into1,
        **_maximum(table, bulk),
        maximum_error=float(np.hypot(fine["error"], of_cells)),
    )


def _on_coarser_cells(
    grid: Grid, heat: NDArray[np.float64], contact: NDArray[np.bool_]
) -> tuple[Grid, NDArray[np.float64], NDArray[np.bool_]]:
    """Average the heat of a cycle onto cells twice as wide; odd numbers get a row of zeros."""
    odd_x, odd_y = grid.nx % 2, grid.ny % 2
    heat = np.pad(heat, ((0, 0), (0, odd_x), (0, odd_y)))
    contact = np.pad(contact, ((0, odd_x), (0, odd_y)))
    count, nx, ny = heat.shape
    wide = grid.replace(nx=nx // 2, ny=ny // 2, dx=2 * grid.dx, dy=2 * grid.dy)
    blocks = heat.reshape(count, nx // 2, 2, ny // 2, 2).mean(axis=(2, 4))
    touches = np.asarray(contact.reshape(nx // 2, 2, ny // 2, 2).any(axis=(1, 3)))
    return wide, blocks, touches


def _table(result: Run, columns: dict[str, Any]) -> xr.Dataset:
    """Make a dataset with coordinates, units and meanings of the temperature."""
    coords = {"body": [1, 2], "x": result.dataset.x, "y": result.dataset.y}
    table = xr.Dataset(coords={**coords, "time": columns["instants"]})
    heat = columns["heat"]
    share = np.divide(columns["flux"], heat, out=np.full_like(heat, np.nan), where=heat > 0.0)
    flash = columns["largest"] - columns["mean"]
    field, over_bodies = ("x", "y"), ("body", "x", "y")
    for name, dims, values, unit, meaning in (
        ("steady", over_bodies, columns["mean"], "K", "mean temperature over the cycle"),
        ("largest", over_bodies, columns["largest"], "K", "largest temperature of the cycle"),
        ("flash", over_bodies, flash, "K", "largest temperature less the mean"),
        ("heat", field, heat, "W/m^2", "mean frictional heat"),
        ("share", field, share, "1", "part of the mean heat that flows into body 1"),
        ("peak", ("time",), columns["peaks"], "K", "largest temperature of the surfaces"),
    ):
        table[name] = (dims, values, {"units": unit, "long_name": meaning})
    table.time.attrs.update(units="1", long_name="time over the period")
    return table
