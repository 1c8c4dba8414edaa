"""Fields of a criterion at points: names, units and meanings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pyfret._core import Assessment

__all__ = ["label_criterion_fields", "margin_name"]


def margin_name(assessments: Sequence[Assessment | None]) -> tuple[str, str]:
    """Return name and meaning of the margin: a life if any layer has a strain-life curve."""
    lives = any(a is not None and a.limit is None for a in assessments)
    if lives:
        return "life", "cycles until a crack has started"
    return "safety_factor", "limit over value"


#: Unit and meaning of each field; the unit of the value is the criterion's.
CRITERION_FIELDS = {
    "value": ("", "value of the criterion"),
    "planes": ("1", "planes looked at"),
    "missed": ("", "most that another plane may have more"),
    "shear_amplitude": ("Pa", "shear amplitude, radius of the smallest circle"),
    "shear_chord": ("Pa", "half of the longest chord of the shear path"),
    "normal_max": ("Pa", "largest normal stress on the critical plane"),
    "normal_min": ("Pa", "smallest normal stress on the critical plane"),
    "normal": ("1", "normal of the critical plane"),
}


def label_criterion_fields(
    fields: dict[str, NDArray[np.float64]], assessments: Sequence[Assessment | None]
) -> dict[str, tuple[NDArray[np.float64], dict[str, str]]]:
    """Add units and meanings to the fields of a criterion."""
    unit = next(a.criterion.unit for a in assessments if a is not None)
    labelled = {
        name: (fields[name], {"units": field_unit or unit, "long_name": meaning})
        for name, (field_unit, meaning) in CRITERION_FIELDS.items()
    }
    upper, lower = fields["normal_max"], fields["normal_min"]
    mean = {"units": "Pa", "long_name": "mean normal stress on the critical plane"}
    labelled["normal_mean"] = ((upper + lower) / 2, mean)
    amplitude = {"units": "Pa", "long_name": "amplitude of the normal stress there"}
    labelled["normal_amplitude"] = ((upper - lower) / 2, amplitude)
    name, meaning = margin_name(assessments)
    unit = "cycles" if name == "life" else "1"
    labelled[name] = (fields["margin"], {"units": unit, "long_name": meaning})
    return labelled
