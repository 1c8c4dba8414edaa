"""A candidate of a comparison: a body with data of its layers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, Literal

from pyfret._core import Material
from pyfret.fatigue.criteria import CriterionName
from pyfret.fatigue.factors import YieldStresses
from pyfret.fatigue.section import Materials, for_each_layer
from pyfret.fracture import Threshold
from pyfret.heat import Conductors
from pyfret.quantities import (
    FrictionCoefficient,
    InSI,
    LayerStresses,
    Strength,
    Toughness,
    by_default,
    part,
)
from pyfret.wear.settings import Law as WearLaw

if TYPE_CHECKING:
    from pyfret._core import Body


__all__ = ["Candidate", "Duty", "to_candidate"]


@part()
class Candidate:
    """A body that is compared with others, with data of its layers.

    A question whose numbers are missing has no answer; the comparison lists the missing ones.
    Layers count from the surface down, the substrate last.

    Examples
    --------
    >>> from pyfret import Body, Coating, material
    >>> titanium = material("titanium_6Al4V")
    >>> coated = Body(titanium, coatings=[Coating(material("TiN"), thickness=3e-6)])
    >>> Candidate(coated, mu=0.5, residual=(-2e9, 0.0)).mu
    0.5
    """

    #: The body, with its coatings.
    body: Body
    #: Coefficient of friction (default: the scene's own).
    mu: FrictionCoefficient | None = None
    #: Material of the substrate, or of every layer, for lives.
    materials: Materials | None = None
    #: Yield stress of the substrate, or of every layer [Pa] (default: from the materials).
    s_y: YieldStresses | None = None
    #: Residual stress of every layer, each a stress [Pa] or a table over depth (default: the one of
    #: the body).
    residual: LayerStresses | None = None
    #: Energy release rate at which a crack channels through the outermost coating [J/m^2].
    toughness: InSI[Toughness | None] = by_default(None)
    #: Strengths of the interfaces [Pa].
    peel_strength: InSI[Strength | None] = by_default(None)
    shear_strength: InSI[Strength | None] = by_default(None)
    #: Crack growth threshold of the substrate.
    threshold: Threshold | None = None
    #: How the body wears: one law, or one for every layer.
    wear: WearLaw | list[WearLaw | None] | None = None
    #: Conductors of heat, one for all layers or one for each.
    conductor: Conductors | None = None
    #: Rows of your own in the table, such as ``{"cost [EUR]": 3.2}``: numbers or texts.
    rows: Mapping[str, float | str] = field(default_factory=dict)

    @property
    def layers(self) -> int:
        """Number of layers, the substrate among them."""
        return len(self.body.coatings) + 1

    @property
    def layer_materials(self) -> list[Material | None]:
        """The material of every layer; None where it is not given."""
        if self.materials is None:
            return [None] * self.layers
        layers: list[Material | None] = for_each_layer(
            self.materials, self.layers, "material", "materials"
        )
        return layers

    @property
    def yield_stresses(self) -> list[float | Material | None]:
        """Return the yield stress of every layer; None where it is not given."""
        if self.s_y is not None:
            s_y = self.s_y
            if not isinstance(s_y, Sequence | Material):
                s_y = [*[None] * (self.layers - 1), s_y]
            layers: list[float | Material | None] = for_each_layer(
                s_y, self.layers, "yield stress", "yield stresses"
            )
            return layers
        return [
            layer if layer and has_number(layer, "s_y") else None for layer in self.layer_materials
        ]

    def describe(self) -> dict[str, Any]:
        """Return all data as text, so that comparisons can be distinguished."""
        return {item.name: repr(getattr(self, item.name)) for item in fields(self)}


@dataclass(frozen=True, kw_only=True)
class Duty:
    """The load, the questions' parameters and the other body, common to all candidates."""

    #: Which body is exchanged.
    body_number: Literal[1, 2] = 2
    #: Criterion of the lives.
    criterion: CriterionName = "smith_watson_topper"
    #: Cycles of wear.
    cycles: float | None = None
    #: As in :func:`pyfret.wear.solve`.
    cycling: Literal["auto", "march", "sliding"] = "auto"
    #: How the other body wears.
    other_wear: WearLaw | list[WearLaw | None] | None = None
    #: Conductor of the other body.
    other_conductor: Conductors | None = None
    #: Cycles per second [Hz].
    frequency: float | None = None

    def pair(self, exchanged: Any, other: Any) -> tuple[Any, Any]:
        """Order two values by body: for body 1, for body 2."""
        return (other, exchanged) if self.body_number == 2 else (exchanged, other)

    def describe(self) -> dict[str, Any]:
        """Return all data as text, so that comparisons can be distinguished."""
        return {item.name: repr(getattr(self, item.name)) for item in fields(self)}


def has_number(material: Material, name: str) -> bool:
    """Check that a material has a number."""
    return any(key == name for key, _, _ in material.numbers())


def to_candidate(body: Body | Candidate) -> Candidate:
    """Convert a body to a candidate."""
    return body if isinstance(body, Candidate) else Candidate(body)
