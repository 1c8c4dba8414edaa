"""Will it yield, and will it go on? First yield and elastic shakedown below a contact.

A load factor is the ratio by which the stresses of the loads may grow until the body yields. A
contact grows with its load. Without coatings p_H may grow by the factor. W then grows by its cube
below a sphere and by its square below a cylinder, with a constant ratio of other forces to W. ::

    factors = result.load_factors(900e6)
    factors.least("von_mises")  # factor and place of first yield
    fret.plot.load_factor_map(factors, of="shakedown")
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from pyfret._core import Material, with_error
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.numbers import layer_index
from pyfret._util.numbers import place as describe_place
from pyfret._util.window import wrap
from pyfret.fatigue.cycle_section import (
    choose_depths,
    concat_sections,
    cycle_section,
    label_fields,
    section_body,
    sections_of_cycle,
)
from pyfret.fatigue.section import Section, SectionOptions, for_each_layer
from pyfret.quantities import Lengths, YieldStress, quantities
from pyfret.subsurface.extremum import Errors, Extremum, Place

if TYPE_CHECKING:
    import xarray as xr
    from typing_extensions import Unpack

    from pyfret._core import YieldBelow
    from pyfret.run import Run

__all__ = ["Factor", "LoadFactors", "YieldStresses", "load_factors"]

#: First yield by von Mises' or Tresca's condition, or the end of elastic shakedown.
Factor = Literal["von_mises", "tresca", "shakedown"]
#: A yield stress [Pa] for all layers, a material that has one for the substrate, or one for each
#: layer from the surface down, the substrate's last; layers of ``None`` are not judged.
YieldStresses = YieldStress | Material | Sequence[YieldStress | Material | None]
#: Load over limit below this part is rounding: the stress does not change, the factor is infinite.
ROUNDING = 1e-12


class LoadFactors(Labelled, Figured):
    """Load factors of first yield and shakedown on a section below the contact, or on several.

    :attr:`dataset` has ``von_mises``, ``tresca`` and ``shakedown`` over (depth, x) or (depth, y),
    for several sections over (depth, x, y) or (depth, y, x); NaN in layers that are not judged,
    infinite without stress.
    """

    figure = "load_factor_map"

    def __init__(
        self, dataset: xr.Dataset, layers: Sequence[int], sections: Sequence[YieldBelow]
    ) -> None:
        super().__init__(dataset)
        self._sections = list(sections)
        self._least: dict[tuple[int, Factor], Extremum] = {}
        #: The layers that are judged, from the surface down.
        self.layers = list(layers)

    def _check(self, of: object) -> None:
        """Refuse a text that is no name of a factor."""
        if not isinstance(of, str) or of not in get_args(Factor):
            shown = repr(of) if isinstance(of, str) else f"<{type(of).__name__}>"
            raise ValueError(f"of = {shown}: must be one of {', '.join(get_args(Factor))}")

    def utilisation(self, of: Factor) -> xr.DataArray:
        """Return load over limit, the inverse of a factor: 1 where the limit is reached."""
        self._check(of)
        return 1.0 / self.dataset[of]

    def least_of(self, layer: int | str, of: Factor = "von_mises") -> Extremum:
        """Return the least factor of a layer and its place; a ValueError if it is not judged."""
        self._check(of)
        if isinstance(layer, str):
            coatings = len(self.dataset.attrs.get("interfaces", ()))
            layer = layer_index(layer, coatings, range(coatings + 1))
        if (layer, of) not in self._least:
            self._least[layer, of] = self._search_least(layer, of)
        return self._least[layer, of]

    def _search_least(self, layer: int, of: Factor) -> Extremum:
        """Search the least factor of a layer, below the section and between its samples."""
        use_of_layer = self.utilisation(of).isel(depth=self.dataset.layer.values == layer)
        values = use_of_layer.values.reshape(
            -1, use_of_layer.shape[2] if use_of_layer.ndim > 2 else 1
        )
        if values.size == 0 or not np.isfinite(values).any():
            raise ValueError(f"layer {layer} is not judged: it has no yield stress or no depth")
        n = int(np.nanmax(np.where(np.isfinite(values), values, -np.inf), axis=0).argmax())
        n_sections = use_of_layer.shape[2] if use_of_layer.ndim > 2 else 1
        searched = [self._sections[n], *self._sections[n_sections:]]
        best = max(
            filter(None, (section.least(layer, of) for section in searched)),
            key=lambda least: least["score"],
            default=None,
        )
        if best is None:
            raise ValueError("the section holds no number")
        use, error = best["score"], Errors(*best["errors"]).sum
        if use < ROUNDING:
            use, error = 0.0, 0.0
        return Extremum(
            1.0 / use if use > 0.0 else np.inf,
            _error_of_inverse(use, error),
            Place(best["x"], best["y"], best["z"]),
            best["layer"],
            coatings=len(self.dataset.attrs.get("interfaces", ())),
        )

    def least(self, of: Factor = "von_mises") -> Extremum:
        """Return the least factor of all layers and its place."""
        return min(
            (self.least_of(layer, of) for layer in self.layers), key=lambda least: least.value
        )

    def summary(self) -> str:
        """Give the least factor of each limit, with its error and place."""
        lines = []
        for factor in get_args(Factor):
            with suppress(ValueError):
                least = self.least(factor)
                number = with_error(least.value, least.error)
                lines.append(f"{factor}: {number} at {describe_place(least, least.coatings)}")
        return wrap("\n".join(lines))

    def __eq__(self, other: object) -> bool:
        """Whether dataset and layers are the same."""
        if not isinstance(other, LoadFactors):
            return NotImplemented
        return super().__eq__(other) is True and other.layers == self.layers

    def __getstate__(self) -> dict[str, object]:
        """Return the state to pickle: the least factors, without the sections."""
        for layer in self.layers:
            for limit in get_args(Factor):
                # A layer without a number is refused when it is asked for.
                with suppress(ValueError):
                    self.least_of(layer, limit)
        return {**self.__dict__, "_sections": []}

    def __repr__(self) -> str:
        """Give the least factor of every limit, and its layer."""
        least = {limit: self.least(limit) for limit in get_args(Factor)}
        texts = (
            f"{limit} {with_error(factor.value, factor.error)} in {factor.layer_name}"
            for limit, factor in least.items()
        )
        return f"LoadFactors({', '.join(texts)})"


def _error_of_inverse(use: float, error: float) -> float:
    """The error of 1/use, on the side where it is larger; infinite if ``use`` may be 0."""
    if error == 0.0:
        return 0.0
    return 1.0 / (use - error) - 1.0 / use if use > error else np.inf


def _yield_stresses(s_y: YieldStresses, layers: int) -> list[float | None]:
    """Return the yield stress of every layer [Pa]."""
    yield_stresses = for_each_layer(s_y, layers, "yield stress", "yield stresses")
    return [
        layer_stress.number("s_y") if isinstance(layer_stress, Material) else layer_stress
        for layer_stress in yield_stresses
    ]


@quantities
def load_factors(
    result: Run,
    s_y: YieldStresses,
    z: Lengths | None = None,
    **section: Unpack[SectionOptions],
) -> LoadFactors:
    """Give load factors of first yield and shakedown below the contact over a closed cycle.

    Parameters
    ----------
    result : Result
        Solved with ``save="all"``, or with the increments of the cycle.
    s_y : float, Material, or sequence of them or None
        Yield stress [Pa] of all layers, or one for each from the surface down, the substrate's
        last; layers of ``None`` are not judged. A material alone belongs to the substrate.
    z : array, optional
        Depths [m] (default: chosen by layer, both sides of every interface).
    **section
        ``x`` or ``y`` (several for a volume), ``azimuth``, ``body_number``, ``cycle`` (None: all
        kept increments of the path), ``residual``: the fields of :class:`pyfret.fatigue.Section`.
        The default place is the one of :func:`pyfret.fatigue.life`. The residual stress counts for
        first yield and does not grow with the load; shakedown finds its own.

    Returns
    -------
    LoadFactors
        As :func:`pyfret.fatigue.first_yield` at every place.

    Raises
    ------
    ValueError
        As :func:`pyfret.fatigue.life`; a yield stress is not positive, the residual stress alone is
        beyond it, or the run has yielded.

    Examples
    --------
    >>> result.load_factors(900e6).least("shakedown")  # doctest: +SKIP
    """
    first, *extra = sections_of_cycle(result, Section(**section))
    body = section_body(result, first)
    if body.yields and float(result.largest_plastic_strain.max()) > 0.0:
        raise ValueError(
            f"body{first.body_number}.plastic: must be left out for load factors, which hold "
            "for elastic bodies; result.cyclic_response() classifies bodies that yield"
        )
    limits = _yield_stresses(s_y, len(body.coatings) + 1)
    depths = choose_depths(result, first, z, limits, "yield stress")
    meanings = {
        "von_mises": "load factor of first yield, von Mises",
        "tresca": "load factor of first yield, Tresca",
        "shakedown": "load factor of elastic shakedown, upper bound",
    }
    sections, labelled_sections = [], []
    for section_at_place in [*first.split(), *extra]:
        judged = cycle_section(result, section_at_place).by_yield(*depths, limits)
        if section_at_place in extra:
            sections.append(judged)
            continue
        fields = judged.fields()
        labels = {
            name: (fields[name], {"units": "1", "long_name": meaning})
            for name, meaning in meanings.items()
        }
        sections.append(judged)
        labelled_sections.append(label_fields(result, section_at_place, depths, labels))
    whole = concat_sections(result, first, labelled_sections).drop_vars("axis")
    present = np.unique(whole.layer.values).tolist()
    return LoadFactors(whole, [n for n in present if limits[n] is not None], sections)
