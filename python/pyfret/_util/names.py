"""Names of modules: what ``dir`` lists, and where names that are elsewhere are found."""

from __future__ import annotations

import sys
import warnings
from importlib import import_module
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["MODULES", "MOVED", "OTHER_NAMES", "called", "listing", "moved"]

#: What other programs call things of ``pyfret``.
OTHER_NAMES = {
    "load": "open",
    "Material": "Elastic",
    "Layer": "Coating",
    "Surface": "SurfaceMap",
    "Roughness": "shapes.Rough",
}
#: Deprecated names of ``pyfret``, and where they are.
MOVED = {
    **dict.fromkeys(
        (
            "InvalidSceneError",
            "KernelInaccurateError",
            "NoConvergenceError",
            "OffGridError",
            "SceneWarning",
            "SlidingError",
            "StoreError",
        ),
        "errors",
    ),
    **dict.fromkeys(
        (
            "Cone",
            "CrownedRoller",
            "Ellipsoid",
            "Flat",
            "FlatPunch",
            "Rough",
            "Sum",
            "Waviness",
            "Wedge",
        ),
        "shapes",
    ),
    **dict.fromkeys(("FrequencyDomain", "Hankel", "InverseFft", "Preset", "Skip"), "settings"),
    **dict.fromkeys(("Archard", "DissipatedEnergy", "WearResult"), "wear"),
    **dict.fromkeys(("Study", "varied"), "study"),
    "Increment": "solution",
    "Verification": "verification",
    "open_study": "study.open",
    "open_wear": "wear.open",
    "resume_wear": "wear.resume",
}


#: Deprecated modules of ``pyfret``, where their names are, and those that have another one there.
MODULES: dict[str, tuple[str, dict[str, str]]] = {
    "averages": ("fatigue", {}),
    "life": ("fatigue", {}),
    "load_factors": ("fatigue", {}),
    "interface": ("fracture", {}),
    "residual": ("subsurface", {"thermal": "thermal_stress"}),
    "studies": ("study", {}),
    "sweep": ("study", {"running_map": "running_conditions"}),
    "results": ("result", {}),
    "doubts": ("scene.warnings", {}),
}


def listing(names: Sequence[str]) -> Callable[[], list[str]]:
    """Give the ``__dir__`` of a module: its public names and no others."""
    return lambda: list(names)


def moved(name: str) -> Any:
    """Give what a deprecated name of ``pyfret`` stands for, and warn of where it is."""
    if name in MODULES:
        place, others = MODULES[name]
        warnings.warn(f"pyfret.{name} is pyfret.{place}", DeprecationWarning, stacklevel=3)
        module_there = import_module(f"pyfret.{place}")
        named = {old: getattr(module_there, new) for old, new in others.items()}
        return SimpleNamespace(**vars(module_there), **named) if named else module_there
    module, _, renamed = MOVED[name].partition(".")
    place = f"pyfret.{module}.{renamed or name}"
    warnings.warn(f"pyfret.{name} is {place}", DeprecationWarning, stacklevel=3)
    return getattr(import_module(f"pyfret.{module}"), renamed or name)


class _Called(ModuleType):
    """A module whose call, which is deprecated, goes to its verb."""

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        """Call the verb of the module, with a warning that names it."""
        name = f"{self.__name__}.{VERBS[self.__name__]}"
        warnings.warn(f"{self.__name__}(...) is {name}(...)", DeprecationWarning, stacklevel=2)
        return getattr(self, VERBS[self.__name__])(*arguments, **keywords)


#: Modules that are called as a function by deprecated programs, and what they mean by it.
VERBS = {"pyfret.report": "report", "pyfret.study": "solve", "pyfret.wear": "solve"}


def called(module: str) -> None:
    """Let a deprecated call of a module go to its verb."""
    sys.modules[module].__class__ = _Called
