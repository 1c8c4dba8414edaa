"""Laws, cycles and settings of wear: the table ``[wear]`` of a scene file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import TYPE_CHECKING, Any, Literal

from pyfret._util.arrays import items, plain
from pyfret._util.keywords import refuse_unknown
from pyfret._util.toml import parse_toml
from pyfret.quantities import (
    EnergyWearCoefficient,
    Frequency,
    InSI,
    Length,
    Stiffness,
    WearCoefficient,
    YieldStress,
    by_default,
    part,
    quantities,
)
from pyfret.scene.parts import Replaceable
from pyfret.wear import third_body
from pyfret.wear.third_body import Air, DebrisBed

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray


__all__ = ["Archard", "DissipatedEnergy", "Wear"]

#: What a coefficient changes with, and pairs of that and its factor.
Factor = tuple[str, "Sequence[tuple[float, float]]"]


@part()
class Archard(Replaceable):
    """Archard's law: the worn depth is k times pressure times sliding distance.

    Parameters
    ----------
    k : float
        Worn depth over pressure times sliding distance [m^2/N].
    threshold : float
        Sliding distance in a cycle below which nothing wears [m].
    factor : (str, list of pairs), optional
        What the coefficient changes with ("cycles", "pressure", "power_density" or "energy"), and
        pairs of that and its factor.
    starved : float, optional
        Coefficient where no oxygen arrives [m^2/N] (default: the same); see :class:`Air`.
    """

    k: InSI[WearCoefficient]
    threshold: InSI[Length] = by_default(0.0)
    factor: Factor | None = None
    starved: InSI[WearCoefficient | None] = by_default(None)

    def __post_init__(self) -> None:
        """Make the pairs of the factor a value, as the law is."""
        fix(self)


@part()
class DissipatedEnergy(Replaceable):
    """Wear by the energy dissipated: the worn volume is alpha times the energy.

    Parameters
    ----------
    alpha : float
        Worn volume over dissipated energy [m^3/J].
    threshold : float
        Energy per area in a cycle below which nothing wears [J/m^2].
    factor : (str, list of pairs), optional
        What the coefficient changes with ("cycles", "pressure", "power_density" or "energy"), and
        pairs of that and its factor.
    starved : float, optional
        Coefficient where no oxygen arrives [m^3/J] (default: the same); see :class:`Air`.
    """

    alpha: InSI[EnergyWearCoefficient]
    threshold: float = 0.0
    factor: Factor | None = None
    starved: InSI[EnergyWearCoefficient | None] = by_default(None)

    def __post_init__(self) -> None:
        """Make the pairs of the factor a value, as the law is."""
        fix(self)


#: Depth [m] that a cycle takes from each cell, of its pressed way [Pa m], way [m], energy [J/m^2],
#: depth so far [m] and the cycles so far.
Function = Callable[..., "NDArray[Any]"]
Law = Archard | DissipatedEnergy | Function


@part()
class Wear(Replaceable):
    """Laws, cycles and settings of a run of wear.

    Parameters
    ----------
    cycles : float
        Number of cycles.
    body1, body2 : Archard, DissipatedEnergy, callable, or list of these, optional
        How a body wears: one law, or one for each coating from the outermost on and one for the
        substrate. None: the body or the layer does not wear. A callable takes arrays over the
        cells, of one cycle, and gives the depth that the cycle takes, m. The arrays are
        ``pressure_times_slip`` (pressure integrated over the slip, Pa m), ``slip_distance`` (m),
        ``dissipated`` (energy per area, J/m^2) and ``worn`` (depth so far, m). It also takes the
        number ``cycles`` so far.
    share1, share2 : float, optional
        Share of the depth of its law that a body loses (default 1).
    debris_kept : float
        Part of what both bodies lose that stays in the contact, 0 to 1: the gap grows by the rest.
        Debris lies where it was made and is as stiff as the body that it was.
    air : Air, optional
        Oxygen in the contact; it needs a `frequency`. Without it, oxygen is everywhere.
    bed : DebrisBed, optional
        A bed of debris that spreads and leaves, in place of `debris_kept`.
    closed_below : float
        Gap below which the region between the bodies is closed to the air [m].
    yield_stress : float, optional
        Yield stress of the softer body [Pa]. A largest pressure above it is doubted: a starved core
        that hardly wears would yield.
    first_branch : int, optional
        First branch of the path that belongs to the cycle, counted from 0 (default: the first in
        the last closed cycle); the cycle ends where it begins.
    branch_counts : sequence of float, optional
        How often a cycle passes each of its branches (default: each once). :func:`solve` sets them
        for a load history, whose cycle is a block of loops.
    cycling : "auto", "march" or "sliding"
        "march" solves the increments of the cycle, with stick and slip. The worn surfaces stay in
        place, so the stroke must be small against the contact: beyond its half-width "march" is
        refused. "sliding" is for gross slip along x under given shifts, whatever the stroke. It
        solves the normal contact alone at each place. "auto" (default) takes "sliding" for given
        shifts above 0.2 half-widths of a spot of the contact that are gross slip.
    frequency : float, optional
        Cycles per second [Hz], for coefficients that are functions of the power density.
    rig_stiffness : float, optional
        Stiffness of a spring through which the shifts are given [N/m] (default: the path's own).
    tolerance : float, optional
        Error that a jump may leave of the worn depth (default 0.01); jumps are as long as that
        lets.
    jumps, explicit_jumps : int, optional
        That many jumps of equal length instead, implicit or explicit.
    worn_through : "stop" or "go_on"
        What happens when a coating is worn through.
    event_depth_fraction : float
        Part of the coatings' thickness from which a worn depth is an event.
    """

    cycles: float
    body1: Law | Sequence[Law | None] | None = None
    body2: Law | Sequence[Law | None] | None = None
    share1: float | None = None
    share2: float | None = None
    debris_kept: float = 0.0
    air: Air | None = None
    bed: DebrisBed | None = None
    closed_below: InSI[Length] = by_default(1e-6)
    yield_stress: InSI[YieldStress | None] = by_default(None)
    first_branch: int | None = None
    branch_counts: Sequence[float] | None = None
    cycling: Literal["auto", "march", "sliding"] = "auto"
    frequency: InSI[Frequency | None] = by_default(None)
    rig_stiffness: InSI[Stiffness | None] = by_default(None)
    tolerance: float | None = None
    jumps: int | None = None
    explicit_jumps: int | None = None
    worn_through: Literal["stop", "go_on"] = "stop"
    event_depth_fraction: float = 0.1

    @classmethod
    @quantities
    def from_settings(cls, wear: Wear | None, settings: Mapping[str, Any]) -> Wear:
        """Return the settings of `wear` with some replaced, or made of `settings` alone.

        Raises
        ------
        TypeError
            One of them is no setting of wear; the message offers the nearest name.
        """
        if settings is None or not all(isinstance(name, str) for name in settings):
            raise TypeError(f"settings = {settings!r:.60}: must be a mapping of names")
        refuse_unknown("wear.Wear", settings, [field.name for field in fields(cls)])
        if wear is not None:
            return wear.replace(**settings)
        if "cycles" not in settings:
            raise TypeError("cycles: must be given, the number of cycles")
        return cls(**settings)

    def document(self) -> tuple[dict[str, Any], list[list[Function]]]:
        """Return the table of a scene file, and the functions of each body beside it."""
        table = {name: value for name, value in vars(self).items() if value is not None}
        if self.branch_counts is not None:
            counts = items(self.branch_counts, "branch_counts")
            table["branch_counts"] = plain(counts, "branch_counts").tolist()
        for name, kind in (("air", Air), ("bed", DebrisBed)):
            if name in table:
                if not isinstance(table[name], kind):
                    raise TypeError(f"{name} = {table[name]!r:.60}: must be a {kind.__name__}")
                table[name] = third_body.written(table[name])
        functions: list[list[Function]] = []
        for body in ("body1", "body2"):
            laws_of_body, share = table.pop(body, None), table.pop(f"share{body[-1]}", None)
            laws = listed(laws_of_body)
            functions.append(own(laws_of_body))
            if share is not None and not laws:
                raise ValueError(f"share{body[-1]} = {share}: must come with a law, {body}")
            if laws:
                table[body] = {"laws": [written(law) for law in laws]}
                table[body] |= {} if share is None else {"share": share}
        return table, functions


def fix(law: Archard | DissipatedEnergy) -> None:
    """Convert the pairs of a factor to tuples of numbers.

    Raises
    ------
    TypeError, ValueError
        They are no pairs of finite numbers.
    """
    if law.factor is None:
        return
    try:
        variable, value = law.factor
    except (TypeError, ValueError):
        raise TypeError(
            f"factor = {law.factor!r:.60}: must be what it changes with and its table, as in "
            '("cycles", [(0.0, 1.0), (1e4, 0.5)])'
        ) from None
    name = f"factor over {variable}"
    array = hasattr(value, "__array__")
    table = plain(value if array else items(value, name), name)
    if table.ndim != 2 or table.shape[1] != 2:
        raise ValueError(f"{name} has the shape {table.shape}: must be pairs")
    object.__setattr__(law, "factor", (variable, tuple(map(tuple, table.tolist()))))


def listed(laws: Law | Sequence[Law | None] | None) -> list[Law | None]:
    """Return the laws of a body as a list: none, one or several."""
    if laws is None:
        return []
    return items(laws, "laws") if isinstance(laws, list | tuple) else [laws]  # type: ignore[list-item]


def check_laws(laws: Law | Sequence[Law | None] | None, name: str) -> None:
    """Refuse a value that is no law of wear; `name` is the name of the argument.

    Raises
    ------
    TypeError
        It is of another class.
    """
    for law in listed(laws):
        if (
            law is not None
            and not isinstance(law, Archard | DissipatedEnergy)
            and not callable(law)
        ):
            raise TypeError(
                f"{name} = {law!r:.60}: must be an Archard, a DissipatedEnergy, a function or None"
            )


def own(laws: Law | Sequence[Law | None] | None) -> list[Function]:
    """The functions among the laws of a body."""
    return [law for law in listed(laws) if callable(law)]


def read(text: str) -> Wear:
    """Read the settings of a table ``[wear]`` of a scene file or a store.

    Raises
    ------
    ValueError
        A law is a function, which no file can hold.
    """
    table = dict(parse_toml(text)["wear"])
    for name, kind in (("air", Air), ("bed", DebrisBed)):
        if name in table:
            table[name] = kind(**table[name])
    for body in ("body1", "body2"):
        body_table = table.pop(body, {})
        if "share" in body_table:
            table[f"share{body[-1]}"] = body_table["share"]
        if body_table.get("laws"):
            table[body] = [law_of(law) for law in body_table["laws"]]
    return Wear(**table)


def law_of(table: dict[str, Any]) -> Archard | DissipatedEnergy:
    """Make the law of a table of a scene file."""
    law = dict(table)
    if "factor" in law:
        law["factor"] = (law["factor"]["of"], [tuple(pair) for pair in law["factor"]["table"]])
    if "own" in law:
        raise ValueError("own: a law of your own is in no file, it must be given again")
    return Archard(**law) if "k" in law else DissipatedEnergy(**law)


def written(law: Law | None) -> dict[str, Any]:
    """Write a law as the table of a scene file."""
    if law is None:
        # A layer that does not wear.
        return {"k": 0.0}
    if isinstance(law, Archard | DissipatedEnergy):
        numbers = {name: value for name, value in vars(law).items() if value is not None}
        if law.factor is not None:
            numbers["factor"] = dict(zip(("of", "table"), law.factor, strict=True))
        return numbers
    if callable(law):
        return {"own": True}
    raise TypeError(
        "a wear law must be an Archard, a DissipatedEnergy, a function, or None for what does "
        f"not wear, not {law}"
    )
