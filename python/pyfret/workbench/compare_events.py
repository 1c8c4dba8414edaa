"""Pins of the third tab: variants with their numbers and curves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret.workbench.answers import answer_in_full
from pyfret.workbench.judgements import first_yield
from pyfret.workbench.names import layer_labels
from pyfret.workbench.schematic import loads_in_words
from pyfret.workbench.variants import MOST, curves_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pyfret._core import Scene

__all__ = ["name_variant", "pin", "unpin"]


def name_variant(scene: Scene, names: dict[str, str], pins: Sequence[dict[str, Any]]) -> str:
    """Name a variant by its layers and loads; equal names get a number."""
    layers = [
        f"{1e6 * layer.thickness:.3g} µm {label.partition(' (')[0]}"
        for layer, label in zip(scene.body2.coatings, layer_labels(scene, names), strict=False)
    ]
    loads = [text.replace(" = ", " ") for text in list(loads_in_words(scene).values())[:2]]
    name = ", ".join([" on ".join(layers) or "uncoated", f"mu {scene.mu:.3g}", *loads])
    taken = {item["name"] for item in pins}
    return name if name not in taken else f"{name} ({len(pins) + 1})"


def pin(
    pins: Sequence[dict[str, Any]], scene: Scene, names: dict[str, str], packed: dict[str, Any]
) -> list[dict[str, Any]]:
    """Return the pins with the scene as a variant, solved in full.

    Raises
    ------
    ValueError
        There are as many as the table has.
    """
    if len(pins) >= MOST:
        raise ValueError(f"{MOST} variants are pinned: remove one of them first")
    answer = answer_in_full(scene, names)
    numbers = [number.as_row() for number in answer.numbers]
    numbers.append(first_yield(answer.result, names).as_row())
    for row in numbers:
        # Layers of one kind are compared whatever their materials.
        if row["name"].startswith("largest von Mises stress, "):
            kind = row["name"].partition("(")[2].rstrip(")") or row["name"].partition(", ")[2]
            row["name"] = f"largest von Mises stress, {kind}"
    variant = {
        "name": name_variant(scene, names, pins),
        "scene": packed,
        "numbers": numbers,
        "curves": curves_of(answer),
    }
    return [*pins, variant]


def unpin(pins: Sequence[dict[str, Any]], event: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the pins without one of them, or none."""
    if "n" not in event:
        return []
    return [item for k, item in enumerate(pins) if k != int(event["n"])]
