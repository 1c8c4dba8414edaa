"""Fretting contact of coated elastic bodies.

Describe two bodies, each homogeneous or coated, a load history and a friction law. You get the
tractions, the stick and slip zones and the fretting loop at every load increment::

    import matplotlib.pyplot as plt

    import pyfret as fret

    ball, alloy = fret.material("alumina"), fret.material("titanium_6Al4V")
    film = fret.Coating(fret.material("TiN"), thickness=3e-6)
    upper = fret.Body(ball, shape=fret.Sphere(R=5e-3))
    lower = fret.Body(alloy, coatings=[film])
    path = fret.LoadPath.start().normal(10.0).cycles(1, T_x=3.0)
    grid = fret.Grid.for_contact(upper, lower, path, error=0.02)
    scene = fret.Scene(body1=upper, body2=lower, friction=0.4, grid=grid)
    result = fret.solve(scene, path)
    print(result.summary())
    result.plot()
    plt.show()

On the command line: ``fret new coated_ball -o scene.toml``, ``fret run scene.toml``. SI units
everywhere; z points into body 2, the lower one; pressure is positive, tension is positive.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

from pyfret import (
    errors,
    fatigue,
    fracture,
    heat,
    kernels,
    reference,
    settings,
    shapes,
    subsurface,
    wear,
)
from pyfret._core import (
    RIGID,
    Body,
    Bond,
    Coating,
    Cylinder,
    Elastic,
    Friction,
    Grid,
    History,
    LoadPath,
    Plastic,
    Profile,
    Scene,
    Sphere,
    SurfaceMap,
    SurfaceOperator,
    graded,
)

# Beside the list: parts of a load path that its methods make, and the table of the materials.
from pyfret._core import Branch as Branch
from pyfret._core import PerRange as PerRange
from pyfret._core import Spacing as Spacing
from pyfret._core import __version__ as __version__
from pyfret._util.extras import application
from pyfret._util.figures import register_figures
from pyfret._util.modules import enter_public_module, name_hint
from pyfret._util.names import OTHER_NAMES, listing
from pyfret.contacts import offer as offer_contacts
from pyfret.grids import offer as offer_grids
from pyfret.history.load_history import LoadHistory as LoadHistory
from pyfret.history.load_history import register_reader
from pyfret.material_table import material
from pyfret.material_table import materials as materials
from pyfret.result import Result
from pyfret.scene.surfaces import read_surface
from pyfret.settings import Settings
from pyfret.snapshot import Snapshot
from pyfret.solution import march, resume, solve

if TYPE_CHECKING:
    from collections.abc import Callable

    from pyfret import experiments, export, fit, plot, study
    from pyfret.citation import cite
    from pyfret.opening import open
    from pyfret.study.compare import compare
    from pyfret.verification import verify
    from pyfret.workbench.page import explore

__all__ = [
    "RIGID",
    "Body",
    "Bond",
    "Coating",
    "Cylinder",
    "Elastic",
    "Friction",
    "Grid",
    "History",
    "LoadPath",
    "Plastic",
    "Profile",
    "Result",
    "Scene",
    "Settings",
    "Snapshot",
    "Sphere",
    "SurfaceMap",
    "SurfaceOperator",
    "cite",
    "compare",
    "errors",
    "experiments",
    "explore",
    "export",
    "fatigue",
    "fit",
    "fracture",
    "graded",
    "heat",
    "kernels",
    "march",
    "material",
    "open",
    "plot",
    "read_surface",
    "reference",
    "resume",
    "settings",
    "shapes",
    "solve",
    "study",
    "subsurface",
    "verify",
    "wear",
]
__dir__ = listing(__all__)

offer_grids()
offer_contacts()
for _name in __all__:
    if isinstance(globals().get(_name), ModuleType):
        enter_public_module(globals()[_name].__name__)


def _load_figures() -> ModuleType:
    """Import the figures, and with them matplotlib."""
    try:
        return import_module("pyfret.plot")
    except ModuleNotFoundError as absent:
        if absent.name != "matplotlib":
            raise
        message = 'figures need matplotlib: pip install "fretting[plot]"'
        raise ModuleNotFoundError(message, name="matplotlib") from absent


def _read_columns(*values: Any, **options: Any) -> Any:
    """Read the columns of a file, with the readers of measured data."""
    return import_module("pyfret.fit.recorders").read_columns(*values, **options)


register_figures(_load_figures)
register_reader(_read_columns)
#: Modules and functions that are imported at their first use.
_LATER: dict[str, Callable[[], Any]] = {
    "cite": lambda: import_module("pyfret.citation").cite,
    "compare": lambda: import_module("pyfret.study.compare").compare,
    "experiments": lambda: application("pyfret.experiments"),
    "explore": lambda: application("pyfret.workbench.page").explore,
    "export": lambda: import_module("pyfret.export"),
    "fit": lambda: import_module("pyfret.fit"),
    "open": lambda: import_module("pyfret.opening").open,
    "plot": _load_figures,
    "study": lambda: import_module("pyfret.study"),
    "verify": lambda: application("pyfret.verification").verify,
}


def __getattr__(name: str) -> Any:
    """Import a module or a function at its first use, the figures with matplotlib."""
    if name in _LATER:
        globals()[name] = _LATER[name]()
        if isinstance(globals()[name], ModuleType):
            enter_public_module(globals()[name].__name__)
        return globals()[name]
    public_name = OTHER_NAMES.get(name)
    hint = f"; it is called pyfret.{public_name}" if public_name else ""
    if not hint and not name.startswith("_"):
        for later in ("fit", "study"):
            __getattr__(later)
        hint = name_hint(name, __all__)
    raise AttributeError(f"module 'pyfret' has no attribute {name!r}{hint}")
