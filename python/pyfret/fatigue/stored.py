"""A life as text beside its dataset, so that it can be saved and opened again.

Worst points, ranges and materials are kept, the stress is not.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from pyfret._core import Assessment, Criterion, Material, StoreError
from pyfret.fatigue.ranges import LifeRange, Range
from pyfret.subsurface.extremum import Errors, Extremum, Place

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["KEY", "life_from_dataset", "life_to_json"]

#: The attribute of the dataset that holds it.
KEY = "found"


def life_to_json(state: dict[str, Any]) -> str:
    """Write the state of a life as text."""
    assessments = [None if a is None else assessment_fields(a) for a in state["_assessments"]]
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


def assessment_fields(assessment: Assessment) -> list[Any]:
    """Return name and numbers of a criterion, with its limit or curve."""
    return [
        assessment.criterion.name,
        assessment.criterion.numbers,
        assessment.limit,
        assessment.curve,
    ]


def life_from_dataset(dataset: xr.Dataset) -> dict[str, Any]:
    """Rebuild the state of a saved life.

    Raises
    ------
    StoreError
        The dataset holds no life.
    """
    try:
        state = json.loads(dataset.attrs[KEY])
        return {
            "_assessments": [
                None
                if a is None
                else Assessment(
                    Criterion(a[0], **a[1]),
                    **{("limit" if a[3] is None else "curve"): a[2] or a[3]},
                )
                for a in state["assessments"]
            ],
            "_materials": [
                None if m is None else Material(m[0], [(n, v, s) for n, v, s in m[1]], m[2], m[3])
                for m in state["materials"]
            ],
            "_notes": [str(note) for note in state["notes"]],
            "_worst": {int(n): worst_from_fields(w) for n, w in state["worst"].items()},
            "_order": {int(n): float(order) for n, order in state["order"].items()},
            "_ranges": {
                int(n): range_from_fields(range_fields)
                for n, range_fields in state["ranges"].items()
            },
        }
    except (LookupError, TypeError, ValueError) as error:
        raise StoreError(f"is no life: {' '.join(str(error).split())}") from error


def worst_from_fields(fields: list[Any]) -> Extremum:
    """Rebuild a worst point from its fields."""
    plain: list[Any] = [tuple(value) if isinstance(value, list) else value for value in fields]
    worst = Extremum(*plain)
    return worst._replace(
        place=Place(*worst.place), errors=None if worst.errors is None else Errors(*worst.errors)
    )


def range_from_fields(fields: list[Any]) -> LifeRange:
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
