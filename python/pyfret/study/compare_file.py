"""The file of a comparison: TOML that says which bodies run in which scene, and what is asked."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret._core import Scene
from pyfret.fatigue.criteria import Materials
from pyfret.fracture import Threshold
from pyfret.heat import Conductor
from pyfret.study.candidate import Candidate
from pyfret.study.compare import compare
from pyfret.study.design import toml
from pyfret.study.keys import known, place_of, read
from pyfret.wear import Archard, DissipatedEnergy

if TYPE_CHECKING:
    from pyfret.study.comparison import Comparison

__all__ = ["run_file"]

#: Keys of the file, of a candidate, and those that are handed on as they are.
GIVEN = ("questions", "body_number", "criterion", "cycles", "cycling", "frequency")
KEYS = ("scene", "candidates", "out", "materials", "other_wear", "other_conductor", *GIVEN)
PLAIN = ("mu", "residual", "toughness", "peel_strength", "shear_strength")
CANDIDATE = ("coatings", "E", "nu", "material", "s_y", "threshold", "wear", "conductor", *PLAIN)
#: Keys of a law of wear, of a conductor and of a threshold, and what is made of them.
LAWS: dict[str, Any] = {"k": Archard, "alpha": DissipatedEnergy}
LAW = ("k", "alpha", "threshold")
CONDUCTOR = ("conductivity", "heat_capacity")
THRESHOLD = ("dK_th", "dS_0")


def run_file(
    path: str | PathLike[str],
    *,
    out: str | PathLike[str] | None = None,
    executor: Any = None,
    again: bool = False,
) -> tuple[Comparison, Path]:
    """Run the comparison of a file, or go on with it; what came out, and its store.

    Parameters
    ----------
    path : path
        The file; names in it are relative to its folder.
    out : path, optional
        Store (default: that of the file, or the file's own name with the ending ``.zarr``).
    executor, again
        As in :func:`pyfret.compare`.

    Raises
    ------
    ValueError
        The file is no comparison; the message names the key and what is allowed.
    """
    file = Path(path)
    says = read(file, KEYS, ("scene", "candidates"))
    table = says["candidates"]
    if not (isinstance(table, dict) and table and all(isinstance(v, dict) for v in table.values())):
        raise ValueError(f"{file}: `candidates`: must be tables, such as [candidates.TiN]")
    scene, which = file.parent / says["scene"], says.get("body_number", 2)
    materials = Materials(file.parent / says["materials"] if "materials" in says else None)
    bodies = {
        name: read_candidate(of, scene, which, materials, f"{file}: candidates.{name}")
        for name, of in table.items()
    }
    others = {
        f"other_{name}": made(says[f"other_{name}"], f"{file}: other_{name}", materials)
        for name, made in (("wear", wear_of), ("conductor", conductor_of))
        if f"other_{name}" in says
    }
    place = place_of(file, says, out)
    given = {key: says[key] for key in GIVEN if key in says}
    found = compare(
        bodies, Scene.from_file(scene), executor=executor, out=place, again=again, **given, **others
    )
    return found, place


def read_candidate(
    says: Mapping[str, Any], scene: Path, body_number: int, materials: Materials, where: str
) -> Candidate:
    """A candidate of its table: the body of the scene with other keys, and what is known of it."""
    for key in says:
        known(key, CANDIDATE, where)
    made = {key: says[key] for key in ("coatings", "E", "nu") if key in says}
    settings = [f"body{body_number}.{key}={inline(value)}" for key, value in made.items()]
    try:
        whole = Scene.from_file(scene, set=settings)
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from error
    body = whole.body2 if body_number == 2 else whole.body1
    more: dict[str, Any] = {key: says[key] for key in PLAIN if key in says}
    if "material" in says:
        more["materials"] = of_layers(says["material"], lambda name: materials[name])
    if "s_y" in says:
        more["s_y"] = says["s_y"]
    if "wear" in says:
        more["wear"] = wear_of(says["wear"], f"{where}.wear", materials)
    if "conductor" in says:
        more["conductor"] = conductor_of(says["conductor"], f"{where}.conductor", materials)
    if "threshold" in says:
        numbers = checked(says["threshold"], THRESHOLD, f"{where}.threshold")
        more["threshold"] = Threshold(**numbers)
    return Candidate(body, **more)


def of_layers(says: Any, make: Any) -> Any:
    """One thing, or one for each layer; an empty text where nothing is known of a layer."""
    if isinstance(says, list):
        return [make(of) if of else None for of in says]
    return make(says)


def wear_of(says: Any, where: str, materials: Materials) -> Any:
    """Laws of wear: ``{ k = .. }`` or ``{ alpha = .. }``, one or one for each layer."""

    def law(of: Any) -> Any:
        numbers = checked(of, LAW, where)
        kind = [name for name in LAWS if name in numbers]
        if len(kind) != 1:
            raise ValueError(f"{where} = {of!r}: must have k or alpha, one of them")
        coefficient = numbers.pop(kind[0])
        return LAWS[kind[0]](coefficient, **numbers)

    return of_layers(says, law)


def conductor_of(says: Any, where: str, materials: Materials) -> Any:
    """Conductors: the name of a material, or its numbers, one or one for each layer."""

    def conductor(of: Any) -> Conductor:
        if isinstance(of, str):
            return Conductor.of(materials[of])
        return Conductor(**checked(of, CONDUCTOR, where))

    return of_layers(says, conductor)


def checked(says: Any, keys: tuple[str, ...], where: str) -> dict[str, Any]:
    """A table whose keys are known."""
    if not isinstance(says, dict):
        raise ValueError(f"{where} = {says!r}: must be a table of {', '.join(keys)}")
    for key in says:
        known(key, keys, where)
    return dict(says)


def inline(value: Any) -> str:
    """A value on one line of TOML."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {inline(of)}" for key, of in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(inline, value)) + "]"
    return toml(value)
