"""Names of the materials of a scene, and the sources of their numbers."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from pyfret.fatigue import Materials
from pyfret.material_table import NU
from pyfret.workbench.edits import material_names

if TYPE_CHECKING:
    from pyfret._core import Elastic, Material, Scene

__all__ = ["layer_labels", "materials_of", "name_of", "names_of", "parts_of", "source_of"]

#: The name of a material whose numbers are the user's.
OWN = "own numbers"


@cache
def table() -> Materials:
    """Read the table of materials once."""
    return Materials()


def parts_of(scene: Scene) -> list[str]:
    """Return the keys of all parts with a material: layers from the surface down, substrates."""
    parts = []
    for body, whole in (("body1", scene.body1), ("body2", scene.body2)):
        parts += [f"{body}.coatings.{n}" for n in range(len(whole.coatings))]
        parts.append(body)
    return parts


def elastic_of(scene: Scene, part: str) -> Elastic:
    """Return the elastic constants of a part."""
    body, _, layer = part.partition(".coatings.")
    whole = scene.body1 if body == "body1" else scene.body2
    return whole.coatings[int(layer)].material if layer else whole.substrate


def name_of(elastic: Elastic, preferred: str | None = None) -> str:
    """Return the name of the material with these constants: `preferred`, else the first one."""
    constants = material_names()

    def matches(name: str) -> bool:
        """Return whether a material has these constants."""
        E, nu = constants.get(name, (0.0, None))
        return elastic.E == E and elastic.nu == (NU if nu is None else nu)

    if preferred and matches(preferred):
        return preferred
    return next((name for name in constants if matches(name)), OWN)


def names_of(scene: Scene, preferred: dict[str, str] | None = None) -> dict[str, str]:
    """Return the material of every part by its name; `preferred` decides between equal ones."""
    preferred = preferred or {}
    return {part: name_of(elastic_of(scene, part), preferred.get(part)) for part in parts_of(scene)}


def source_of(name: str) -> str:
    """Describe a material: its title, and the source of its modulus."""
    if name == OWN:
        return "Your own numbers: no strength, no life, no crack."
    chosen = table()[name]
    sources = {key: source for key, _, source in chosen.numbers()}
    return f"{chosen.title}. E: {sources.get('E', 'no source')}."


def materials_of(
    scene: Scene, names: dict[str, str], body_number: int = 2
) -> list[Material | None]:
    """Return the materials of the layers of a body, from the surface down, the substrate last."""
    body = f"body{body_number}"
    parts = [part for part in parts_of(scene) if part.partition(".")[0] == body]
    return [None if names[part] == OWN else table()[names[part]] for part in parts]


def layer_labels(scene: Scene, names: dict[str, str], body_number: int = 2) -> list[str]:
    """Return the labels of the layers of a body, from the surface down: coating and material."""
    body = f"body{body_number}"
    parts = [part for part in parts_of(scene) if part.partition(".")[0] == body]
    labels = []
    for n, part in enumerate(parts):
        kind = "substrate" if part == body else "coating" if len(parts) == 2 else f"coating {n + 1}"
        name = names[part]
        labels.append(kind if name == OWN else f"{name} ({kind})")
    return labels
