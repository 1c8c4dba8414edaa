"""Several measures of one result, which share the stress below it."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from pyfret._util.lazy import xr
from pyfret._util.numbers import in_words
from pyfret._util.scene_warnings import SceneWarning
from pyfret.quantities import quantities
from pyfret.study.measures import check_measures, evaluate_measures

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pyfret.result import Result
    from pyfret.study.measures import Measure

__all__ = ["answers"]


@quantities
def answers(result: Result, measure: Measure | Sequence[Measure]) -> xr.Dataset:
    """Evaluate several measures of one result.

    Studies and comparisons evaluate their measures in this way. Measures of the same result share
    the stress below it. The stress of a cycle serves lives and load factors, at most 192 MB. The
    sections serve largest stresses, at most 128 MB. ``fret check`` prints the memory of a scene.

    Parameters
    ----------
    result : Result
        The result. Measures of stress take the increments whose fields were kept.
    measure : str, callable, or sequence of these
        Names of :data:`pyfret.study.MEASURES`, or functions of the result, as for
        :func:`pyfret.study.run`.

    Returns
    -------
    xarray.Dataset
        The numbers by name, with their ranges, such as ``von_mises_low``. The attribute ``costs``
        is the processor time of each measure, ``reasons`` are the reasons of missing numbers.

    Raises
    ------
    ValueError
        A measure is unknown, or no measure has a number: the reason of the first.

    Examples
    --------
    >>> answers(result, ["von_mises", "s_1", Cracking(ti64, "dang_van")])  # doctest: +SKIP
    """
    measures = check_measures(measure)
    costs: dict[str, float] = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SceneWarning)
        numbers, reasons = evaluate_measures(result, measures, costs)
    times = (f"{name} {in_words(seconds, 2)} s" for name, seconds in costs.items())
    attributes = {
        "title": result.scene.title,
        "costs": ", ".join(times),
        "reasons": "\n".join(reasons),
    }
    return xr.Dataset(numbers, attrs=attributes)
