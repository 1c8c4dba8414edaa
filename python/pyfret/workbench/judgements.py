"""First yield, life and crack of the lower body, each with its range or why there is none."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING

from pyfret._core import with_error
from pyfret._util.scene_warnings import SceneWarning
from pyfret.workbench.answers import REFUSALS, PageNumber, Recent
from pyfret.workbench.names import layer_labels, materials_of

if TYPE_CHECKING:
    from pyfret._core import Material, Scene
    from pyfret.result import Result

__all__ = ["CRITERIA", "crack_verdict", "first_yield", "life_of"]

#: Criteria that the page offers.
CRITERIA = {
    "smith_watson_topper": "Smith, Watson, Topper: cycles",
    "fatemi_socie": "Fatemi, Socie: cycles",
    "crossland": "Crossland: safety factor",
    "dang_van": "Dang Van: safety factor",
    "findley": "Findley: safety factor",
}


def has(material: Material | None, *numbers: str) -> bool:
    """Check that a material has all these numbers."""
    return material is not None and set(numbers) <= {key for key, _, _ in material.numbers()}


#: Yields by the scene and the names of its materials.
YIELDS: Recent[PageNumber] = Recent()


def first_yield(result: Result, names: dict[str, str]) -> PageNumber:
    """Return the factor of all loads at which the first layer yields, after von Mises."""
    key = f"{sorted(names.items())}\n{result.dataset.attrs['scene']}"
    return YIELDS.fetch(key, lambda: find_yield(result, names))


def find_yield(result: Result, names: dict[str, str]) -> PageNumber:
    """Search the load factor of first yield."""
    name = "first yield, times the loads"
    scene = result.scene
    layers = [m if has(m, "s_y") else None for m in materials_of(scene, names)]
    if not any(layers):
        return PageNumber(
            name, "no answer", note="no layer has a yield stress: choose its material"
        )
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SceneWarning)
            worst = result.load_factors(layers).least("von_mises")
    except REFUSALS as error:
        return PageNumber(name, "no answer", note=str(error))
    note = f"in the {layer_labels(scene, names)[worst.layer]}, depth {1e6 * worst.z:.3g} µm"
    low, high = worst.value - worst.error, worst.value + worst.error
    return PageNumber(
        name,
        with_error(worst.value, worst.error).replace("+-", "±"),
        "",
        worst.value,
        low,
        high,
        note,
    )


def life_of(result: Result, names: dict[str, str], criterion: str) -> PageNumber:
    """Return the life or the safety factor of the worst layer, with its range of 10 to 90 %."""
    cycles = criterion in ("smith_watson_topper", "fatemi_socie")
    name = "life to initiation" if cycles else "safety factor"
    scene = result.scene
    layers = []
    for material in materials_of(scene, names):
        try:
            layers.append(material if material and material.assessment(criterion) else None)
        except (ValueError, KeyError):
            layers.append(None)
    if not any(layers):
        why = "no layer has the numbers of this criterion: choose its material"
        return PageNumber(name, "no answer", note=why)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SceneWarning)
            life = result.life(layers, criterion)  # type: ignore[arg-type]
            bounds, worst = life.range, life.worst
    except REFUSALS as error:
        return PageNumber(name, "no answer", note=str(error))
    text = str(bounds).replace("+-", "±")
    note = f"in the {layer_labels(scene, names)[worst.layer]}, {criterion.replace('_', ' ')}"
    best, low, high = (
        end if math.isfinite(end) else None for end in (bounds.best, bounds.low, bounds.high)
    )
    return PageNumber(name, text, "cycles" if cycles else "", best, low, high, note)


def crack_verdict(result: Result, names: dict[str, str]) -> PageNumber:
    """Return what becomes of a crack in the substrate: it stops, grows, or never starts."""
    name = "crack from the rim"
    scene: Scene = result.scene
    substrate = materials_of(scene, names)[-1]
    if substrate is None or not has(substrate, "dK_th"):
        why = "the substrate has no threshold: choose a material with dK_th"
        return PageNumber(name, "no answer", note=why)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SceneWarning)
            arrest = result.crack().arrest(substrate)
    except REFUSALS as error:
        return PageNumber(name, "no answer", note=str(error))
    margin, spread = arrest.margin, arrest.margin_error
    low, high = (None, None) if spread is None else (margin - spread, margin + spread)
    return PageNumber(name, arrest.describe().replace("+-", "±"), "", margin, low, high)
