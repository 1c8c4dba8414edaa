"""A damage is printed with its error, or with a bound where the error exceeds it."""

from __future__ import annotations

import pytest
import xarray as xr

from pyfret import fatigue


def damage(value: float, error: float) -> fatigue.Damage:
    """Return a damage of one loop at one point."""
    loop = ("loop", [1.0])
    fields = {"damage": (("depth", "x"), [[value]])}
    attrs = {"place": [0.0, 0.0, 1e-5], "error_sources": "cells", "errors": [error], "notes": ""}
    loops = {"range": loop, "part": loop, "compressive": loop}
    return fatigue.Damage(xr.Dataset(fields | loops, attrs=attrs))


@pytest.mark.parametrize(
    ("error", "text"),
    [(1e-9, "(3.10 +- 0.10)e-8"), (4.5e-5, "3.1e-8, at most 4.5e-5"), (0.0, "3.100e-8")],
)
def test_an_error_above_the_damage_is_an_upper_bound(error: float, text: str) -> None:
    """The text "0.0 +- 4.5" would hide its size."""
    printed = damage(3.1e-8, error)
    assert printed.worst_text == text
    assert f"damage {text} in one pass" in printed.summary()
    assert ("passes, at least 22000, until" in printed.summary()) == (error > 3.1e-8)
