"""How a scene is solved: the numerical methods, and what may be left out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Any, Literal, TypeVar

from pyfret import _core
from pyfret._util.arrays import items
from pyfret._util.names import listing
from pyfret.quantities import part
from pyfret.scene.parts import Replaceable

__all__ = ["FrequencyDomain", "Hankel", "InverseFft", "Preset", "Settings", "Skip"]
__dir__ = listing(__all__)

T = TypeVar("T")


class Preset(Enum):
    """Families of algorithms.

    ``FAST``: preconditioned solvers; sets and fields carried over and extrapolated.
    ``SPINU2020``: the paper's, plain conjugate gradients in both directions, plain alternation.
    """

    FAST = "fast"
    SPINU2020 = "spinu2020"

    def __repr__(self) -> str:
        """Return the constructor call as text."""
        return f"Preset.{self.name}"


@part(kw_only=True)
class Hankel(Replaceable):
    """Influence coefficients by Hankel integrals: exact to round-off."""

    def written(self) -> str:
        """Return the value in a scene file."""
        return "hankel"


@part(kw_only=True)
class InverseFft(Replaceable):
    """Influence coefficients by the paper's inverse FFT, eq. (9)-(13).

    Parameters
    ----------
    enlargement : int
        How many times larger the domain is, the paper's lambda, 1 to 12 (default 8).
    aliases : int
        Order of the alias sums (default 0, as in the paper).
    """

    enlargement: int = 8
    aliases: int = 0

    def written(self) -> dict[str, Any]:
        """Return the value in a scene file."""
        return {"inverse_fft": {"lambda": self.enlargement, "aliases": self.aliases}}


@part(kw_only=True)
class FrequencyDomain(Replaceable):
    """No coefficients: every convolution with the frequency response on an enlarged domain.

    Parameters
    ----------
    enlargement : int
        How many times larger the domain is, 1 to 12 (default 8).
    """

    enlargement: int = 8

    def written(self) -> dict[str, Any]:
        """Return the value in a scene file."""
        return {"frequency_domain": {"lambda": self.enlargement}}


#: Conversions by the texts that a scene file has for them.
KERNELS: dict[str, type[Hankel] | type[InverseFft] | type[FrequencyDomain]] = {
    "hankel": Hankel,
    "inverse_fft": InverseFft,
    "frequency_domain": FrequencyDomain,
}


def chosen(name: str, text: str, choices: Mapping[str, T]) -> T:
    """Return a choice by its text, whatever its case.

    Raises
    ------
    ValueError
        There is no such choice; the message has those that there are.
    """
    if text.lower() not in choices:
        listed = ", ".join(f'"{choice}"' for choice in choices)
        raise ValueError(f"{name} = {text!r:.60}: must be one of {listed}")
    return choices[text.lower()]


@part(kw_only=True)
class Skip(Replaceable):
    """Parts of the solution that are skipped if the scene does not need them, with the same result.

    Parameters
    ----------
    equal_layers : bool
        Treat a body whose layers all equal its substrate as homogeneous (default True).
    coupling : bool
        Leave out the normal-tangential kernels where they vanish (default True).
    mirror : bool
        Solve on half of a mirror-symmetric scene (default True).
    single_precision : bool
        Compute responses to changes of the tractions in single precision where the tolerance is
        1e-6 or more (default True).
    contact_window : bool
        Solve in a window around the contact, where no cell beyond it can touch (default True).
    path_independent_branches : bool
        Leave out the increments of branches whose end does not depend on the path
        (default False: results have a row for every increment asked for). They are solved if
        their fields are to be kept.
    """

    equal_layers: bool = True
    coupling: bool = True
    mirror: bool = True
    single_precision: bool = True
    contact_window: bool = True
    path_independent_branches: bool = False


@part(kw_only=True)
class Settings(Replaceable):
    """How a scene is solved; the defaults are what most users want.

    Parameters
    ----------
    preset : Preset, "fast" or "spinu2020"
        Which algorithms (default ``Preset.FAST``).
    tolerance : float, optional
        Relative tolerance of the solution [1]. It holds for the gap error over the Hertz approach h
        and the tangential misfit over mu h. It holds for the last change of the tractions, too.
        Default 1e-6. Where increments are chosen it is 1/125 of ``path_tolerance`` if that is more,
        1/2500 where loads only press.
    cell_entry_correction : bool
        Compute the slip of cells that come into contact from their entry (default True). It takes
        far fewer increments, with one more solution in each in which the contact grows.
    path_tolerance : float
        Largest error of the shear at the ends of branches that ``increments="auto"`` leaves, over
        the largest shear of the path [1] (L2, default 5e-3).
    path_grid : "auto", "same" or int
        Cells along x of the grid for increments that are solved for the path alone, a half or a
        quarter of the grid's cells. Their fields are not kept, they end no branch, and normal
        force and tilting moments are constant. ``"same"``: the grid itself. ``"auto"`` (default):
        chosen with the increments, such that ``path_tolerance`` holds; ``"same"`` where these are
        given. The error that a number leaves is in ``path_error``, in the bars and in the doubts of
        a result.
    slip_rotation_correction : bool
        Let the direction of slip follow the shear within an increment (default True): the path
        becomes of second order.
    max_alternations : int
        Most passes of the intermediate loop per increment (default 60).
    max_iterations : int
        Most iterations of an inner loop (default 1000).
    kernel : Hankel, InverseFft, FrequencyDomain, or text
        Conversion of the frequency response of coated bodies (default ``Hankel()``). The texts
        ``"hankel"``, ``"inverse_fft"`` and ``"frequency_domain"`` mean these with their defaults.
    kernel_tolerance : float
        Largest error of the influence coefficients over C33(0, 0) [1] (default 1e-10).
    skip : Skip
        What may be left out (default: all that the scene does not need).
    save : "branches", "all" or sequence of int
        Which increments keep their fields (default ``"branches"``: the last of each branch).
        Increments count from 1; the last of the path is always kept.

    Raises
    ------
    InvalidSceneError
        A number is out of its range; the message names the key, the value and what is allowed.
    """

    preset: Preset | Literal["fast", "spinu2020"] = Preset.FAST
    tolerance: float | None = None
    cell_entry_correction: bool = True
    slip_rotation_correction: bool = True
    path_tolerance: float = 5e-3
    path_grid: Literal["auto", "same"] | int = "auto"
    max_alternations: int = 60
    max_iterations: int = 1000
    kernel: (
        Hankel | InverseFft | FrequencyDomain | Literal["hankel", "inverse_fft", "frequency_domain"]
    ) = Hankel()
    kernel_tolerance: float = 1e-10
    skip: Skip = Skip()
    save: Literal["branches", "all"] | Sequence[int] = "branches"

    def __post_init__(self) -> None:
        """Find choices by their texts, and refuse what has no meaning."""
        if isinstance(self.preset, str):
            presets = {preset.value: preset for preset in Preset}
            object.__setattr__(self, "preset", chosen("preset", self.preset, presets))
        elif not isinstance(self.preset, Preset):
            raise TypeError(f"preset = {self.preset!r:.60}: must be a Preset, or its text")
        if isinstance(self.kernel, str):
            object.__setattr__(self, "kernel", chosen("kernel", self.kernel, KERNELS)())
        elif not isinstance(self.kernel, tuple(KERNELS.values())):
            raise TypeError(f"kernel = {self.kernel!r:.60}: must be a kernel, or its text")
        if not isinstance(self.save, str):
            object.__setattr__(self, "save", tuple(items(self.save, "save")))
        _core.check_settings(self)

    def document(self) -> dict[str, Any]:
        """Return the tables of a scene file."""
        solver = dict(vars(self))
        kernel = {
            "method": solver.pop("kernel").written(),
            "tolerance": solver.pop("kernel_tolerance"),
        }
        skip, output = vars(solver.pop("skip")), {"save": solver.pop("save")}
        solver["preset"] = Preset(self.preset).value
        solver_values = {name: value for name, value in solver.items() if value is not None}
        return {"kernel": kernel, "solver": solver_values, "skip": skip, "output": output}

    @classmethod
    def of(cls, document: dict[str, Any]) -> Settings:
        """Make the settings of the tables of a scene file."""
        kernel, solver = document["kernel"], document["solver"]
        method: Hankel | InverseFft | FrequencyDomain = Hankel()
        if isinstance(kernel["method"], dict):
            ((name, numbers),) = kernel["method"].items()
            numbers = {"enlargement": numbers.pop("lambda"), **numbers}
            method = (InverseFft if name == "inverse_fft" else FrequencyDomain)(**numbers)
        return cls(
            **{**solver, "preset": Preset(solver["preset"])},
            kernel=method,
            kernel_tolerance=kernel["tolerance"],
            skip=Skip(**document["skip"]),
            save=document["output"]["save"],
        )
