"""Public modules: a wrong name or a call of the module is answered with the right name."""

from __future__ import annotations

import sys
from types import ModuleType
from typing import TYPE_CHECKING, Any

from pyfret._util.attributes import PUBLIC_MODULES
from pyfret._util.keywords import nearest_names

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["PublicModule", "enter_public_module", "name_hint"]

#: Functions that calls of a module mean: ``fret.fit(...)`` is ``fret.fit.fit(...)``.
MAIN_FUNCTIONS = {"fit": "fit", "study": "run"}

#: Public names by the words that others have for them, for modules.
SYNONYMS = {
    "hertz_line": "reference.line_contact",
    "line_hertz": "reference.line_contact",
    "cylinder_contact": "reference.line_contact",
    "coefficient": "fit.read_scar",
    "wear_coefficient": "fit.read_scar",
    "friction": "fit.fit",
    "friction_coefficient": "fit.fit",
    "mu": "fit.fit",
    "grid": "study.run",
    "list_materials": "materials",
    "sphere_on_flat": "Scene.ball_on_flat",
    "ball_on_flat": "Scene.ball_on_flat",
    "cylinder_on_flat": "Scene.cylinder_on_flat",
    "read_topography": "read_surface",
    "load_surface": "read_surface",
    "peening": "Body",
    "criteria": "fatigue.Criterion",
    "sweep": "study.run",
    "parametric": "study.run",
    "parameter_study": "study.run",
    "loop": "plot.fretting_loop",
    "read_csv": "read_surface",
    "from_csv": "read_surface",
    "roughness": "SurfaceMap",
    "crack": "fracture.over_cycle",
}


def name_hint(name: str, own: Sequence[str], module: str = "") -> str:
    """Return a clause with the public name that a wrong one means; empty where none is near.

    Parameters
    ----------
    name : str
        The wrong name.
    own : sequence of str
        Public names of the module that was asked for it.
    module : str
        That module, such as "study"; empty for the package.
    """
    elsewhere = [
        f"{key}.{name}"
        for key, public in sorted(PUBLIC_MODULES.items())
        if name in getattr(public, "__all__", ())
    ]
    near = [f"{module}.{word}" if module else word for word in nearest_names(name, own, 2)]
    others = [
        f"{key}.{word}"
        for key, public in sorted(PUBLIC_MODULES.items())
        for word in nearest_names(name, getattr(public, "__all__", ()), 1)
    ]
    synonym = [SYNONYMS[name]] if name in SYNONYMS else []
    begun = [f"{module}.{word}" for word in own if module and word.startswith(f"{name}_")][:3]
    for names in (begun, elsewhere, synonym, near, others[:2] if not module else []):
        if names:
            return "; did you mean " + " or ".join(f"fret.{word}" for word in names) + "?"
    return f"; it has {', '.join(own)}"


class PublicModule(ModuleType):
    """A module of the public face."""

    def __getattr__(self, name: str) -> Any:
        """Refuse a name that the module does not have, with the nearest public one."""
        message = f"module {self.__name__!r} has no {name!r}"
        if name.startswith("_"):
            raise AttributeError(message)
        short_name = self.__name__.rpartition(".")[2]
        raise AttributeError(message + name_hint(name, self.__all__, short_name))

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        """Call the main function of the module, or refuse with the functions that it has."""
        short_name = self.__name__.rpartition(".")[2]
        if short_name in MAIN_FUNCTIONS:
            return getattr(self, MAIN_FUNCTIONS[short_name])(*arguments, **keywords)
        functions = [
            f"fret.{short_name}.{name}(...)"
            for name in self.__all__
            if callable(getattr(self, name)) and not isinstance(getattr(self, name), type)
        ]
        raise TypeError(f"{self.__name__} is a module; it has {', '.join(functions[:12])}")


def enter_public_module(name: str) -> None:
    """Make a loaded module of the package, such as "pyfret.fit", a module of the public face."""
    module = sys.modules[name]
    module.__class__ = PublicModule
    PUBLIC_MODULES[name.rpartition(".")[2]] = module
