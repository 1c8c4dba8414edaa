"""A life as text beside its dataset, so that it can be saved and opened again.

What is kept is what was found: worst points, ranges, materials. The stress is not kept.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from pyfret._core import Assessment, Criterion, Material, StoreError
from pyfret.fatigue.ranges import LifeRange, Range
from pyfret.subsurface.tensor import Errors

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["KEY", "packed", "unpacked"]

#: The attribute of the dataset that holds it.
KEY = "found"


def packed(state: dict[str, Any]) -> str:
    """The state of a life as text."""
    assessments = [None if a is None else of_assessment(a) for a in state["_assessments"]]
    materials = [
        None if m is None else [m.name, [*map(list, m.numbers())], m.title, m.also]
        for m in state["_materials"]
    ]
    return json.dumps(
        {
            "assessments": assessments,
            "materials": materials,
            "notes": state["_notes"],
            "worst": state["_worst"],
            "order": state["_order"],
            "ranges": state["_ranges"],
        }
    )


def of_assessment(of: Assessment) -> list[Any]:
    """Name and numbers of a criterion, with its limit or curve."""
    return [of.criterion.name, of.criterion.numbers, of.limit, of.curve]


def unpacked(dataset: xr.Dataset, worst: type) -> dict[str, Any]:
    """The state of a life that was saved.

    Raises
    ------
    StoreError
        The dataset holds no life.
    """
    try:
        found = json.loads(dataset.attrs[KEY])
        return {
            "_assessments": [
                None
                if a is None
                else Assessment(
                    Criterion(a[0], **a[1]),
                    **{("limit" if a[3] is None else "curve"): a[2] or a[3]},
                )
                for a in found["assessments"]
            ],
            "_materials": [
                None if m is None else Material(m[0], [(n, v, s) for n, v, s in m[1]], m[2], m[3])
                for m in found["materials"]
            ],
            "_notes": [str(note) for note in found["notes"]],
            "_worst": {int(n): worst(*of_worst(w)) for n, w in found["worst"].items()},
            "_order": {int(n): float(of) for n, of in found["order"].items()},
            "_ranges": {int(n): of_range(of) for n, of in found["ranges"].items()},
        }
    except (LookupError, TypeError, ValueError) as error:
        raise StoreError(f"is no life: {' '.join(str(error).split())}") from error


def of_worst(fields: list[Any]) -> list[Any]:
    """The fields of a worst point, nested ones as they were."""
    found = [Errors(*of) if n == ERRORS else of for n, of in enumerate(fields)]
    return [tuple(of) if isinstance(of, list) else of for of in found]


#: The place of the errors among the fields of a worst point.
ERRORS = 6


def of_range(fields: list[Any]) -> LifeRange:
    """The range of a layer."""
    low, best, high, stress, material, distance, L, notes = fields
    return LifeRange(
        low,
        best,
        high,
        stress=Range(*stress),
        material=material,
        distance=None if distance is None else Range(*distance),
        L=L,
        notes=tuple(notes),
    )
