"""Studies of a contact under many loads: running conditions, crack risk, frictional energy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import LoadPath, Scene
from pyfret._util.arrays import number, plain
from pyfret._util.bounds import SIDES
from pyfret._util.lazy import xr
from pyfret._util.numbers import format_number, in_words
from pyfret.quantities import BulkStresses, Force, Forces, Numbers, quantities
from pyfret.study.loop import run

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from pyfret.run import Run
    from pyfret.study.measures import Arrest, Cracking, Measure

__all__ = ["arrest_map", "running_conditions"]

#: Code of gross slip, and the meanings of the codes.
SLIDES = 3
STATUS = "0 no contact, 1 full stick, 2 partial slip, 3 gross slip"

#: Fields of the map from the last cycle: names in the map, and names of the measures.
MAP_FIELDS = {
    "status": "regime",
    "energy_ratio": "energy_ratio",
    "sliding_ratio": "sliding_ratio",
    "dissipated": "loop_energy",
    "T": "T",
    "delta": "delta",
    "stiffness": "stiffness",
}
#: Fields that criteria and cracks add to a map.
JUDGED_FIELDS = (
    "safety_factor",
    "life",
    "crack_depth",
    "start_margin",
    "arrest_margin",
    "arrest_length",
)
BULK = "largest bulk stress"
#: The shift to gross slip is read at (1 - ALMOST) mu W: a grid slides 3e-4 before it.
#: There a ball has 1 - ALMOST^(2/3) = 0.99 of its shift (Mindlin 1949), and is divided by this
#: factor.
ALMOST = 1e-3
#: Name of the amplitude parameter, since a measure has the name of the force or shift.
AMPLITUDE = "amplitude"


@quantities
def running_conditions(
    scene: Scene,
    *,
    W: Forces,
    T: Numbers | None = None,
    delta: Numbers | None = None,
    cycles: int = 1,
    sigma_B: BulkStresses = 0.0,
    bulk_ratio: float = 0.0,
    increments: tuple[int, int] = (20, 20),
    cracking: Cracking | None = None,
    arrest: Arrest | None = None,
    executor: Any = None,
    on_point: Callable[[int, int], object] | None = None,
) -> xr.Dataset:
    """Map the running conditions of fretting cycles over normal force and amplitude.

    Every combination is solved: indentation, first loading, then `cycles` cycles between -T and T,
    or between the shifts -delta and delta.

    Parameters
    ----------
    scene : Scene
        The contact; a grid that is too small for the largest W grows.
    W : array
        Normal forces [N].
    T : array, optional
        Amplitudes of the tangential force [N]; those above mu W slide and are marked so without
        being solved, since no static solution exists.
    delta : array, optional
        Amplitudes of the shift [m], instead of `T`: gross slip is solved as well.
    cycles : int
        Number of cycles; the map shows the last.
    sigma_B : float or array
        Largest bulk stress of body 2 [Pa], in phase with the force `T`; several make a third
        dimension, of which a figure shows one, ``table.sel(sigma_B=...)``.
    bulk_ratio : float
        Smallest over largest bulk stress.
    increments : (int, int)
        Increments of the indentation and of a full stroke.
    cracking : Cracking, optional
        A criterion of fatigue to judge the last cycle by:
        ``study.Cracking(material, "dang_van")``.
    arrest : Arrest, optional
        Whether a crack stops: ``study.Arrest(fracture.Threshold(dK_th, dS_0))``.
    executor : int, Executor or distributed.Client, optional
        The workers, as in :func:`pyfret.study.run`.
    on_point : callable, optional
        A function called with the number of points done, and of all points.

    Returns
    -------
    xarray.Dataset
        Over W and T or delta: ``status`` (0 no contact, 1 full stick, 2 partial slip, 3 gross
        slip), ``energy_ratio``, ``sliding_ratio``, ``dissipated`` [J], ``stiffness`` [N/m].
        ``delta`` [m] or ``T`` [N] is half of its range. A number with an error has its range, such
        as ``stiffness_low`` and ``stiffness_high``. With `cracking` also its ``safety_factor`` or
        ``life`` [cycles] and ``crack_depth`` [m]. With `arrest` also ``start_margin``,
        ``arrest_margin`` and ``arrest_length`` [m]. Where a force slides, all but the status are
        NaN. ``slides_from`` over W is the amplitude from which on the contact slides, where its
        friction is Coulomb's: mu W, or its shift, to 1 %.

    Raises
    ------
    RuntimeError
        A point could not be solved. The message names the point and the reason.
    """
    driven = "T" if delta is None else "delta"
    amplitudes = T if delta is None else delta
    if amplitudes is None or (T is None) == (delta is None):
        raise ValueError("give the amplitudes T or delta, one of them")
    normal, tangential = np.atleast_1d(plain(W, "W")), np.atleast_1d(plain(amplitudes, driven))
    measures: list[Measure] = [name for map_name, name in MAP_FIELDS.items() if map_name != driven]
    bulk = np.atleast_1d(plain(sigma_B, "sigma_B"))
    if driven == "delta" and bulk.any():
        raise ValueError("sigma_B: must be 0 with shifts delta; it goes with forces T")
    loads = {"W": normal, AMPLITUDE: tangential}
    if np.ndim(sigma_B):
        loads["sigma_B"] = bulk
    template = Cycles(
        scene,
        driven,
        cycles,
        increments,
        fields=bool(cracking or arrest),
        sigma_B=float(bulk[0]),
        bulk_ratio=bulk_ratio,
    )
    study = run(
        template,
        loads,
        measure=[
            *measures,
            *(measure_class for measure_class in (cracking, arrest) if measure_class),
        ],
        executor=executor,
        progress=False,
        on_point=on_point,
    )
    for point, reason in study.failed():
        if not reason.startswith(Slides.__name__):
            raise RuntimeError(
                f"W = {format_number(point['W'])}, {driven} = "
                f"{format_number(point[AMPLITUDE])}: {reason}"
            )
    table = rename_to_map(study.dataset, scene, driven)
    if (limit := sliding_limit(scene, normal, driven, increments, executor)) is not None:
        unit = table[driven].attrs["units"]
        slides_attrs = {"units": unit, "long_name": "amplitude of gross slip"}
        table["slides_from"] = ("W", limit, slides_attrs)
    if "sigma_B" in table.dims:
        table["sigma_B"] = table["sigma_B"].assign_attrs(units="Pa", long_name=BULK)
        return table
    return table.assign_attrs(sigma_B=float(bulk[0]))


@quantities
def arrest_map(
    scene: Scene,
    *,
    W: Force,
    T: Numbers,
    sigma_B: BulkStresses,
    arrest: Arrest,
    bulk_ratio: float = 0.0,
    increments: tuple[int, int] = (2, 8),
    cracking: Cracking | None = None,
    executor: Any = None,
    on_point: Callable[[int, int], object] | None = None,
) -> xr.Dataset:
    """Map the arrest of cracks in fretting fatigue over shear and bulk stress in phase.

    At every point the pad is pressed on. Then T and the bulk stress go to their largest values, to
    -T and `bulk_ratio` times the bulk stress, and back.

    Parameters
    ----------
    scene : Scene
        The contact; a grid that is too small grows.
    W : float
        Normal force [N].
    T, sigma_B : array
        Amplitudes of the tangential force [N] and largest bulk stresses of body 2 [Pa].
    arrest : Arrest
        The crack and its threshold.
    bulk_ratio : float
        Smallest over largest bulk stress.
    increments : (int, int)
        Increments of the indentation and of a full stroke.
    cracking, executor, on_point
        As in :func:`running_conditions`.

    Returns
    -------
    xarray.Dataset
        Over T and sigma_B: ``start_margin``, ``arrest_margin``, ``arrest_length`` [m] as
        :class:`pyfret.study.Arrest` gives them, with `cracking` its
        ``safety_factor`` or ``life`` [cycles] and ``crack_depth`` [m]; NaN where the force slides.

    Raises
    ------
    RuntimeError
        A point could not be solved. The message names the point and the reason.
    """
    loads = {
        "T": np.atleast_1d(plain(T, "T")),
        "sigma_B": np.atleast_1d(plain(sigma_B, "sigma_B")),
    }
    measures: list[Measure] = [arrest, *([cracking] if cracking else [])]
    normal_force = number(W, "W")
    template = BulkCycle(scene, normal_force, bulk_ratio, increments)
    study = run(
        template, loads, measure=measures, executor=executor, progress=False, on_point=on_point
    )
    for point, reason in study.failed():
        if not reason.startswith(Slides.__name__):
            raise RuntimeError(f"T = {point['T']}, sigma_B = {point['sigma_B']} Pa: {reason}")
    wanted_names = [f"{name}{side}" for name in JUDGED_FIELDS for side in SIDES]
    table = study.dataset[[name for name in wanted_names if name in study.dataset]]
    unit = scene.grid.unit_of("N")
    table["T"] = table["T"].assign_attrs(units=unit, long_name="amplitude of the force")
    table["sigma_B"] = table["sigma_B"].assign_attrs(units="Pa", long_name=BULK)
    return table.assign_attrs({"title": scene.title, "mu": scene.mu, "W": normal_force})


def rename_to_map(study_data: xr.Dataset, scene: Scene, driven: str) -> xr.Dataset:
    """Rename the study of the loads to the names of the map."""
    units = {"T": ("N", "amplitude of the force"), "delta": ("m", "amplitude of the shift")}
    names = {name: map_name for map_name, name in MAP_FIELDS.items()} | {
        name: name for name in JUDGED_FIELDS
    }
    new_names = {
        f"{name}{side}": f"{map_name}{side}"
        for name, map_name in names.items()
        for side in SIDES
        if f"{name}{side}" in study_data
    }
    table = (
        study_data[list(new_names)]
        .rename(new_names)
        .drop_vars(AMPLITUDE)
        .rename({AMPLITUDE: driven})
    )
    table["status"] = table["status"].fillna(SLIDES).assign_attrs(long_name=STATUS)
    unit, meaning = units[driven]
    unit = scene.grid.unit_of(unit)
    amplitude = study_data[AMPLITUDE].values
    table = table.assign_coords(
        {driven: (driven, amplitude, {"units": unit, "long_name": meaning})}
    )
    table["W"] = table["W"].assign_attrs(units=scene.grid.unit_of("N"), long_name="normal force")
    return table.assign_attrs({"title": scene.title, "mu": scene.mu})


def sliding_limit(
    scene: Scene, W: NDArray[np.float64], driven: str, increments: tuple[int, int], executor: Any
) -> NDArray[np.float64] | None:
    """Return the amplitude at which the contact begins to slide under each normal force."""
    if not scene.friction.is_constant or not 0.0 < scene.mu < np.inf:
        return None
    if driven == "T":
        return np.asarray(scene.mu * W)
    study = run(
        PushToSliding(scene, increments),
        {"W": W},
        measure=final_shift,
        executor=executor,
        progress=False,
    )
    return np.asarray(study.dataset[final_shift.__name__].values / (1.0 - ALMOST ** (2.0 / 3.0)))


@dataclass(frozen=True)
class PushToSliding:
    """A function that makes the scene of a contact pushed almost to gross slip."""

    scene: Scene
    increments: tuple[int, int]

    def __call__(self, point: dict[str, float]) -> Scene:
        """Return the scene under a normal force."""
        W = point["W"]
        indentation, stroke = self.increments
        path = LoadPath.start().normal(W, increments=indentation)
        path = path.force(T_x=(1.0 - ALMOST) * self.scene.mu * W, increments=max(stroke // 2, 1))
        return self.scene.replace(path=path, save=[len(path)])


def final_shift(result: Run) -> float:
    """Return the shift along x at the end of the path [m]."""
    return float(result.dataset["delta_x"].values[-1])


class Slides(Exception):
    """The force is more than friction can bear."""


def check_friction_limit(scene: Scene, T: float, W: float) -> None:
    """Raise :exc:`Slides` if friction cannot bear a force [N]."""
    # The limit of a user's law follows from the run alone.
    if scene.friction.law is None and scene.mu * W * (1 - 1e-9) < T:
        unit = scene.grid.unit_of("N")
        raise Slides(
            f"T = {in_words(T, 7)} {unit} is more than mu W = {in_words(scene.mu * W, 7)} {unit}"
        )


@dataclass(frozen=True)
class Cycles:
    """A function that makes the scene of a point: indentation, first loading, cycles."""

    scene: Scene
    driven: str
    cycles: int
    increments: tuple[int, int]
    #: Whether the fields of the last cycle are kept, or of its end alone.
    fields: bool
    #: Largest bulk stress where it is no parameter, and the smallest over the largest.
    sigma_B: float = 0.0
    bulk_ratio: float = 0.0

    def __call__(self, point: dict[str, float]) -> Scene:
        """Return the scene under the normal force and the amplitude of a point."""
        W, amplitude = point["W"], point[AMPLITUDE]
        if self.driven == "T":
            check_friction_limit(self.scene, amplitude, W)
        indentation, stroke = self.increments
        path = LoadPath.start().normal(W, increments=indentation)
        largest = point.get("sigma_B", self.sigma_B)
        for n, turn in enumerate([amplitude, *([-amplitude, amplitude] * self.cycles)]):
            part = max(stroke // 2, 1) if n == 0 else stroke
            if self.driven == "T":
                bulk = largest * (1.0 if turn > 0.0 else self.bulk_ratio)
                path = path.force(T_x=turn, sigma_B=bulk, increments=part)
            else:
                path = path.displace(delta_x=turn, increments=part)
        last = len(path)
        first = last - 2 * stroke if self.fields else last
        return self.scene.replace(path=path, save=list(range(first, last + 1)))


@dataclass(frozen=True)
class BulkCycle:
    """A function that makes the scene of a point: indentation, shear and bulk stress in phase."""

    scene: Scene
    W: float
    bulk_ratio: float
    increments: tuple[int, int]

    def __call__(self, point: dict[str, float]) -> Scene:
        """Return the scene under the force and the bulk stress of a point."""
        T, sigma_B = point["T"], point["sigma_B"]
        check_friction_limit(self.scene, T, self.W)
        indentation, stroke = self.increments
        path = LoadPath.start().normal(self.W, increments=indentation)
        turns = ((T, sigma_B), (-T, self.bulk_ratio * sigma_B), (T, sigma_B))
        for n, (force, bulk) in enumerate(turns):
            part = max(stroke // 2, 1) if n == 0 else stroke
            path = path.force(T_x=force, sigma_B=bulk, increments=part)
        last = len(path)
        return self.scene.replace(path=path, save=list(range(last - 2 * stroke, last + 1)))
