"""Criteria, first yield and shakedown of stress histories, and their materials."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from pyfret import _core
from pyfret._core import Assessment, Criterion, Material
from pyfret._util.arrays import COMPONENTS, histories, number, plain
from pyfret._util.lazy import xr
from pyfret._util.material_names import find_material, list_materials
from pyfret._util.parameter import short_repr
from pyfret._util.scene_warnings import warn
from pyfret.fatigue.plastic_strain import align_plastic_strain
from pyfret.quantities import StressHistory, YieldStress, quantities

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator, Sequence

    import pandas as pd
    from numpy.typing import ArrayLike, NDArray


__all__ = [
    "COMPONENTS",
    "CRITERIA",
    "Assessment",
    "Criterion",
    "Material",
    "Materials",
    "dang_van_path",
    "evaluate_criterion",
    "evaluate_margin",
    "first_yield",
    "mean_stress_slope",
    "moving_load",
    "to_pylife",
]

#: Names of the criteria.
CriterionName = Literal[
    "crossland",
    "dang_van",
    "findley",
    "matake",
    "mcdiarmid",
    "smith_watson_topper",
    "fatemi_socie",
    "brown_miller",
]
CRITERIA: tuple[CriterionName, ...] = get_args(CriterionName)


class Materials(Mapping[str, Material]):
    """The materials that come with the package and, with precedence, the materials of a TOML file.

    Parameters
    ----------
    file : path, optional
        ``schema = 1`` and tables ``[materials.NAME]`` of numbers
        ``{ value = 207e9, source = "where it is from" }``; ``docs/fatigue.md`` lists them.
    """

    def __init__(self, file: str | os.PathLike[str] | None = None) -> None:
        self._materials = {m.name: m for m in _core.materials()}
        if file is not None:
            added = _core.materials(file)
            for doubt in (doubt for material in added for doubt in material.doubts()):
                warn(doubt)
            self._materials.update({m.name: m for m in added})

    def __getitem__(self, name: str) -> Material:
        """Give a material by its name, or by another one that it is known by: ``"Ti6Al4V"``."""
        if not isinstance(name, str):
            raise TypeError(f"key = {short_repr(name)}: must be a text, the name of a material")
        material = find_material(name, self._materials)
        if material is None:
            raise KeyError(list_materials(name, self._materials))
        return material

    def __iter__(self) -> Iterator[str]:
        """Go through the names."""
        return iter(self._materials)

    def __len__(self) -> int:
        """Count the materials."""
        return len(self._materials)

    def __repr__(self) -> str:
        """Give the names."""
        return f"Materials({', '.join(self._materials)})"


@quantities
def evaluate_criterion(
    stress: ArrayLike,
    criterion: Criterion,
    *,
    plastic_strain: ArrayLike | None = None,
    tolerance: float = 1e-3,
) -> xr.Dataset:
    """Give the value of a criterion at every point, and the critical plane.

    Parameters
    ----------
    stress : array of shape (time, ..., 6)
        Stress history [Pa]. The order of the instants does not matter. An array with labels, as
        :func:`history` gives it, is taken by the names of its dimensions and components.
    criterion : Criterion
        With its numbers, such as ``Criterion.findley(k=0.3)``.
    plastic_strain : array of the shape of the stress, optional
        Plastic strain at the same instants (default: none, or a constant one). Components are those
        of the tensor, xx + yy + zz = 0. Criteria of strain take the sum of the elastic strain of
        the stress and this strain. Criteria of stress leave it out.
    tolerance : float
        Largest part of the value by which another plane may be proved better. The plane found is
        much nearer to the best than what is proved.

    Returns
    -------
    xarray.Dataset
        Over the axes of the points, with their labels or named ``dim_0``, ``dim_1``, ...:
        ``value``, and ``missed``: no plane has more than value + missed. ``normal`` of the critical
        plane has the last dimension ``axis``, and is NaN without a plane. On this plane, in Pa:
        ``shear_amplitude`` by the smallest circle, ``shear_chord`` (half of the longest chord),
        ``normal_max``, ``normal_min``, ``normal_mean`` and ``normal_amplitude``. For Crossland's
        and Dang Van's criteria ``shear_amplitude`` is sqrt(J2,a), or the mesoscopic shear when it
        decides, and ``normal_max`` the hydrostatic stress that goes with it.

    Raises
    ------
    ValueError
        The stress is not finite, has one instant only, is zero everywhere, or its last axis is not
        6 long. The plastic strain has another shape or changes the volume. A criterion of strain is
        given the stress of a cycle in which plastic strain grows, and not that strain.
    """
    points = histories(stress)
    fields = _core.criterion_on(
        criterion,
        points.values,
        align_plastic_strain(stress, plastic_strain, criterion),
        tolerance=number(tolerance, "tolerance"),
    )
    labels = {
        "value": (criterion.unit, f"value of the criterion {criterion.name}"),
        "planes": ("1", "planes looked at"),
        "missed": (criterion.unit, "most that another plane may have more"),
        "shear_amplitude": ("Pa", "shear amplitude, radius of the smallest circle"),
        "shear_chord": ("Pa", "half of the longest chord of the shear path"),
        "normal_max": ("Pa", "largest normal stress on the critical plane"),
        "normal_min": ("Pa", "smallest normal stress on the critical plane"),
    }
    result = xr.Dataset(attrs={"criterion": criterion.name})
    for name, (unit, meaning) in labels.items():
        result[name] = points.labelled(fields[name], unit, meaning)
    upper, lower = result.normal_max, result.normal_min
    mean = {"units": "Pa", "long_name": "mean normal stress on the critical plane"}
    amplitude = {"units": "Pa", "long_name": "amplitude of the normal stress there"}
    result["normal_mean"] = ((upper + lower) / 2).assign_attrs(mean)
    result["normal_amplitude"] = ((upper - lower) / 2).assign_attrs(amplitude)
    normal = fields["normal"].reshape(-1, 3)
    result["normal"] = points.labelled(normal, "1", "normal of the critical plane", ("axis",))
    return result.assign_coords(axis=["x", "y", "z"])


@quantities
def evaluate_margin(
    stress: StressHistory,
    material: Material,
    criterion: CriterionName,
    *,
    plastic_strain: ArrayLike | None = None,
    tolerance: float = 1e-3,
) -> xr.Dataset:
    """Evaluate a criterion with the numbers of a material: safety factors and lives.

    Takes the parameters of :func:`evaluate_criterion`. Adds ``safety_factor`` (limit over
    value) for criteria with a limit, and ``life`` [cycles] for those with a strain-life curve.
    A life of more than 1e7 cycles, where no curve has tests, is infinite, as in
    :class:`pyfret.fatigue.Life`; ``material.assessment(criterion).life(value)`` follows the curve.

    Raises
    ------
    ValueError
        As :func:`evaluate_criterion`, and if the material lacks a number. The message names it.
    """
    assessment = material.assessment(criterion)
    result = evaluate_criterion(
        stress, assessment.criterion, plastic_strain=plastic_strain, tolerance=tolerance
    )
    result.attrs["material"] = material.title
    name, unit, meaning = (
        ("life", "1", "cycles until a crack has started, infinite: more than 1e7")
        if assessment.limit is None
        else ("safety_factor", "1", "limit over value")
    )
    margin = assessment.life if assessment.limit is None else assessment.safety_factor
    values = np.array([margin(float(v)) for v in result.value.values.ravel()])
    if assessment.limit is None:
        values[values > _core.LONGEST_LIFE] = np.inf
    attrs = {"units": unit, "long_name": meaning}
    result[name] = (result.value.dims, values.reshape(result.value.shape), attrs)
    return result


@quantities
def first_yield(
    stress: ArrayLike, *, s_y: YieldStress, constant: Sequence[float] = (0, 0, 0, 0, 0, 0)
) -> xr.Dataset:
    """Give load factors of first yield and of elastic shakedown.

    Parameters
    ----------
    stress : array of shape (time, ..., 6)
        Stress that grows with the load [Pa].
    s_y : float
        Yield stress [Pa].
    constant : six numbers
        Stress that does not grow with the load, such as a residual stress [Pa].

    Returns
    -------
    xarray.Dataset
        Factors ``von_mises`` and ``tresca`` at which yield begins, and ``shakedown`` up to which
        Melan's theorem finds elastic cycles at the point (an upper bound for the body, since it is
        not asked that the ``residual`` stress of neighbouring points balances); infinite without
        stress.
    """
    points = histories(stress)
    xx, yy, zz, xy, xz, yz = plain(constant, "constant").tolist()
    yields = number(s_y, "s_y")
    factors = _core.yielding_on(points.values, s_y=yields, constant=(xx, yy, zz, xy, xz, yz))
    labels = {
        "von_mises": "load factor of first yield, von Mises",
        "tresca": "load factor of first yield, Tresca",
        "shakedown": "load factor of elastic shakedown, upper bound",
    }
    result = xr.Dataset(coords={"component": list(COMPONENTS)})
    for name, meaning in labels.items():
        result[name] = points.labelled(factors[name], "1", meaning)
    about = "deviatoric residual stress that serves best"
    residual = factors["residual"].reshape(-1, len(COMPONENTS))
    result["residual"] = points.labelled(residual, "Pa", about, ("component",))
    return result


@quantities
def moving_load(stress: ArrayLike, *, s_y: YieldStress) -> NDArray[np.float64]:
    """Give the load factor of elastic shakedown under a load that moves along the surface.

    A load that passes again and again leaves a residual stress that depends on depth alone. Its
    balance leaves s_xx, s_yy and s_xy, and no stress on planes parallel to the surface. Melan's
    theorem with these alone gives the limits of K. L. Johnson, Contact Mechanics (1985), section
    9.2. A cylinder has p_0 = 4 k without friction, k being s_y/sqrt 3. For mu > 0.367 the surface
    decides, and p_0 = k/mu. A history and its mirror image in the surface, which turns s_xz and
    s_yz round, have a smallest sphere whose centre is such a stress.

    Parameters
    ----------
    stress : array of shape (time, ..., 6)
        Stress at a place of every depth as the load passes [Pa].
    s_y : float
        Yield stress [Pa], by von Mises' condition.

    Returns
    -------
    array of shape (...)
        Load factor of every place.
    """
    stress = histories(stress).whole()
    mirrored = stress * np.array([1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
    with_mirror = np.concatenate([stress, mirrored])
    return np.asarray(first_yield(with_mirror, s_y=s_y).shakedown)


@quantities
def dang_van_path(stress: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Give the path of one point in Dang Van's plane.

    Parameters
    ----------
    stress : array of shape (time, 6)
        Stress history [Pa].

    Returns
    -------
    tau, p_h : arrays of shape (time,)
        Mesoscopic shear and hydrostatic stress, tension positive [Pa].
    """
    points = histories(stress)
    if points.shape:
        raise ValueError(f"stress has points of the shape {points.shape}: must be one point")
    path = _core.dang_van_path(np.ascontiguousarray(points.whole()))
    return path[:, 0], path[:, 1]


@quantities
def mean_stress_slope(material: Material) -> tuple[float, str]:
    """Give how much amplitude of uniaxial stress a mean stress costs, and after whom.

    The limit is amplitude = s_D - slope mean. Where the strength ``s_u`` has a source, slope =
    s_D/s_u (J. Goodman, Mechanics Applied to Engineering, 1899). Else ``t_D`` gives it by Dang
    Van's criterion, s_a/2 + alpha (s_a + s_m)/3 = t_D. There slope = 1 - s_D/(2 t_D), with alpha =
    3 t_D/s_D - 3/2. A ValueError names a missing number.
    """
    s_D = material.number("s_D")
    if any(name == "s_u" and "recalled" not in source for name, _, source in material.numbers()):
        return s_D / material.number("s_u"), "Goodman"
    return 1.0 - s_D / (2.0 * material.number("t_D")), "Dang Van"


@quantities
def to_pylife(stress: ArrayLike) -> pd.DataFrame:
    """Give a history as pyLife takes it: columns S11, S22, S33, S12, S13, S23, a row per instant.

    Rows are indexed by ``element_id`` (the points in C order) and ``load_step``. Needs pandas.
    """
    import pandas as pd

    points = histories(stress).values
    time, count, _ = points.shape
    index = pd.MultiIndex.from_product(
        [range(count), range(time)], names=["element_id", "load_step"]
    )
    rows = points.transpose(1, 0, 2).reshape(-1, 6)
    return pd.DataFrame(rows, index=index, columns=["S11", "S22", "S33", "S12", "S13", "S23"])
