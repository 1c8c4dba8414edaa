"""What a criterion finds at points: names, units and meanings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pyfret._core import Assessment

__all__ = ["described", "margin_name"]


def margin_name(assessments: Sequence[Assessment | None]) -> tuple[str, str]:
    """Name and meaning of the margin: a life as soon as one layer has a strain-life curve."""
    lives = any(a is not None and a.limit is None for a in assessments)
    if lives:
        return "life", "cycles until a crack has started"
    return "safety_factor", "limit over value"


#: What is found at every point: unit and meaning; that of the value is the criterion's.
FOUND = {
    "value": ("", "value of the criterion"),
    "planes": ("1", "planes looked at"),
    "missed": ("", "most that another plane may have more"),
    "shear_amplitude": ("Pa", "shear amplitude, radius of the smallest circle"),
    "shear_chord": ("Pa", "half of the longest chord of the shear path"),
    "normal_max": ("Pa", "largest normal stress on the critical plane"),
    "normal_min": ("Pa", "smallest normal stress on the critical plane"),
    "normal": ("1", "normal of the critical plane"),
}


def described(
    found: dict[str, NDArray[np.float64]], assessments: Sequence[Assessment | None]
) -> dict[str, tuple[NDArray[np.float64], dict[str, str]]]:
    """What the core found at points, with names and units."""
    unit = next(a.criterion.unit for a in assessments if a is not None)
    shown = {
        name: (found[name], {"units": of or unit, "long_name": meaning})
        for name, (of, meaning) in FOUND.items()
    }
    most, least = found["normal_max"], found["normal_min"]
    mean = {"units": "Pa", "long_name": "mean normal stress on the critical plane"}
    shown["normal_mean"] = ((most + least) / 2, mean)
    amplitude = {"units": "Pa", "long_name": "amplitude of the normal stress there"}
    shown["normal_amplitude"] = ((most - least) / 2, amplitude)
    name, meaning = margin_name(assessments)
    unit = "cycles" if name == "life" else "1"
    shown[name] = (found["margin"], {"units": unit, "long_name": meaning})
    return shown
