"""Fretting contact of coated elastic bodies.

Describe two bodies, each homogeneous or coated, a load history and a friction law; get the
tractions, the stick and slip zones and the fretting loop at every load increment::

    import pyfret as fret

    scene = fret.Scene.from_file("scenes/coated_fretting.toml")
    result = fret.solve(scene)
    fret.plot.fretting_loop(result)

Axes, signs and names are those of ``docs/conventions.md``; SI units everywhere.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from pyfret import (
    averages,
    fatigue,
    heat,
    interface,
    kernels,
    life,
    load_factors,
    reference,
    residual,
    studies,
    subsurface,
    sweep,
)
from pyfret._core import (
    RIGID,
    Archard,
    Body,
    Branch,
    Coating,
    Cone,
    CrownedRoller,
    Cylinder,
    DissipatedEnergy,
    Elastic,
    Ellipsoid,
    Flat,
    FlatPunch,
    FrequencyDomain,
    Friction,
    Grid,
    Hankel,
    History,
    InvalidSceneError,
    InverseFft,
    KernelInaccurateError,
    LoadPath,
    NoConvergenceError,
    OffGridError,
    PerRange,
    Preset,
    Profile,
    Rough,
    Scene,
    Settings,
    Skip,
    SlidingError,
    Spacing,
    Sphere,
    StoreError,
    Sum,
    SurfaceMap,
    SurfaceOperator,
    Waviness,
    Wedge,
    __version__,
    graded,
)
from pyfret.citing import cite
from pyfret.doubts import SceneWarning
from pyfret.notebook import show_in_notebooks
from pyfret.reporting import report
from pyfret.results import Result, Snapshot, open
from pyfret.solving import Increment, march, resume, solve
from pyfret.studies import Study, open_study, study, varied
from pyfret.surfaces import read_surface
from pyfret.verifying import Verification, verify
from pyfret.wearing import WearResult, open_wear, resume_wear, wear

if TYPE_CHECKING:
    from pyfret import plot

__all__ = [
    "RIGID",
    "Archard",
    "Body",
    "Branch",
    "Coating",
    "Cone",
    "CrownedRoller",
    "Cylinder",
    "DissipatedEnergy",
    "Elastic",
    "Ellipsoid",
    "Flat",
    "FlatPunch",
    "FrequencyDomain",
    "Friction",
    "Grid",
    "Hankel",
    "History",
    "Increment",
    "InvalidSceneError",
    "InverseFft",
    "KernelInaccurateError",
    "LoadPath",
    "NoConvergenceError",
    "OffGridError",
    "PerRange",
    "Preset",
    "Profile",
    "Result",
    "Rough",
    "Scene",
    "SceneWarning",
    "Settings",
    "Skip",
    "SlidingError",
    "Snapshot",
    "Spacing",
    "Sphere",
    "StoreError",
    "Study",
    "Sum",
    "SurfaceMap",
    "SurfaceOperator",
    "Verification",
    "Waviness",
    "WearResult",
    "Wedge",
    "__version__",
    "averages",
    "cite",
    "fatigue",
    "graded",
    "heat",
    "interface",
    "kernels",
    "life",
    "load_factors",
    "march",
    "open",
    "open_study",
    "open_wear",
    "plot",
    "read_surface",
    "reference",
    "report",
    "residual",
    "resume",
    "resume_wear",
    "solve",
    "studies",
    "study",
    "subsurface",
    "sweep",
    "varied",
    "verify",
    "wear",
]


show_in_notebooks()

#: What other programs call things.
OTHER_NAMES = {
    "load": "open",
    "run": "solve",
    "Material": "Elastic",
    "Layer": "Coating",
    "Surface": "SurfaceMap",
    "Roughness": "Rough",
}


def __getattr__(name: str) -> Any:
    """Import the figures, and with them matplotlib, when they are first asked for."""
    if name == "plot":
        try:
            return import_module("pyfret.plot")
        except ModuleNotFoundError as absent:
            if absent.name != "matplotlib":
                raise
            message = 'figures need matplotlib: pip install "fretting[plot]"'
            raise ModuleNotFoundError(message, name="matplotlib") from absent
    meant = OTHER_NAMES.get(name)
    hint = f"; it is called pyfret.{meant}" if meant else ""
    raise AttributeError(f"module 'pyfret' has no attribute {name!r}{hint}")
