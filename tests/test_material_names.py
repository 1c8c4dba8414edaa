"""A material is given by its name wherever one is meant."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any

import pytest

import pyfret as fret
from pyfret import fatigue, fracture, heat

#: Types of parameters that take a material or its name.
MATERIAL = re.compile(r"\b(Materials?|Conductors)\b")


def takes_a_material() -> Iterator[tuple[str, Callable[..., Any], str]]:
    """All public functions and constructors that take a material: name, call, parameter."""
    modules = [of for name in fret.__all__ if isinstance(of := getattr(fret, name), ModuleType)]
    for module in modules:
        if module.__name__.partition(".")[0] != "pyfret":
            continue
        for name in getattr(module, "__all__", ()):
            of = getattr(module, name)
            if getattr(of, "__module__", "").partition(".")[0] != "pyfret":
                continue
            # What a program makes of results, such as a life, is no place for a name.
            made = isinstance(of, type) and not hasattr(of.__init__, "__wrapped__")
            calls = [(name, of)] if callable(of) and not made else []
            if isinstance(of, type) and hasattr(of, "from_material"):
                calls.append((f"{name}.from_material", of.from_material))
            for called, call in calls:
                try:
                    parameters = inspect.signature(call).parameters
                except (TypeError, ValueError):
                    continue
                for key, one in parameters.items():
                    if MATERIAL.search(str(one.annotation)):
                        yield f"{module.__name__}.{called}", call, key


def test_a_misspelt_name_is_refused_with_the_nearest_everywhere() -> None:
    asked = set()
    for name, call, key in takes_a_material():
        asked.add(name.removeprefix("pyfret."))
        with pytest.raises(ValueError, match=rf"(?s){key}.*tiatnium.*titanium"):
            call(**{key: "tiatnium"})
    expected = {"fatigue.critical_distance", "fatigue.lives", "fracture.Paris.from_material"}
    assert expected | {"heat.Conductor.from_material", "fatigue.average"} <= asked


def test_a_name_is_its_material() -> None:
    steel = fatigue.Materials()["42CrMo4"]
    assert fatigue.critical_distance("42CrMo4") == fatigue.critical_distance(steel)
    assert fracture.Threshold.from_material("42CrMo4") == fracture.Threshold.from_material(steel)
    assert heat.Conductor.from_material("Ti6Al4V") == heat.Conductor.from_material(
        fatigue.Materials()["Ti6Al4V"]
    )
    with pytest.raises(TypeError, match="or its name"):
        fatigue.critical_distance(3.0)  # type: ignore[arg-type]
