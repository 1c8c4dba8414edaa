"""The file of a comparison in TOML: bodies, scene and questions."""

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
from pyfret.study.design import to_toml_value
from pyfret.study.keys import check_key, read_document, store_path
from pyfret.wear import Archard, DissipatedEnergy

if TYPE_CHECKING:
    from pyfret.study.comparison import Comparison

__all__ = ["run_compare_file"]

#: Keys of the file and of a candidate. GIVEN and PLAIN are handed on as they are.
GIVEN = ("questions", "body_number", "criterion", "cycles", "cycling", "frequency")
KEYS = ("scene", "candidates", "out", "materials", "other_wear", "other_conductor", *GIVEN)
PLAIN = ("mu", "residual", "toughness", "peel_strength", "shear_strength", "rows")
CANDIDATE = ("coatings", "E", "nu", "material", "s_y", "threshold", "wear", "conductor", *PLAIN)
#: Keys of a law of wear, of a conductor and of a threshold, with the classes of the laws.
LAWS: dict[str, Any] = {"k": Archard, "alpha": DissipatedEnergy}
LAW = ("k", "alpha", "threshold")
CONDUCTOR = ("conductivity", "heat_capacity")
THRESHOLD = ("dK_th", "dS_0")


def run_compare_file(
    path: str | PathLike[str],
    *,
    out: str | PathLike[str] | None = None,
    executor: Any = None,
    again: bool = False,
) -> tuple[Comparison, Path]:
    """Run the comparison of a file, or continue it; return the comparison and its store.

    Parameters
    ----------
    path : path
        The file; names in it are relative to its folder.
    out : path, optional
        Store (default: `out` of the file, or the file's own name with the ending ``.zarr``).
    executor, again
        As in :func:`pyfret.compare`.

    Raises
    ------
    ValueError
        The file is no comparison; the message names the key and what is allowed.
    """
    file = Path(path)
    document = read_document(file, KEYS, ("scene", "candidates"))
    table = document["candidates"]
    if not (isinstance(table, dict) and table and all(isinstance(v, dict) for v in table.values())):
        raise ValueError(f"{file}: `candidates`: must be tables, such as [candidates.TiN]")
    scene, which = file.parent / document["scene"], document.get("body_number", 2)
    materials = Materials(file.parent / document["materials"] if "materials" in document else None)
    bodies = {
        name: read_candidate(candidate_table, scene, which, materials, f"{file}: candidates.{name}")
        for name, candidate_table in table.items()
    }
    other_body = {
        f"other_{name}": make(document[f"other_{name}"], f"{file}: other_{name}", materials)
        for name, make in (("wear", read_wear), ("conductor", read_conductor))
        if f"other_{name}" in document
    }
    store = store_path(file, document, out)
    settings = {key: document[key] for key in GIVEN if key in document}
    comparison = compare(
        bodies,
        Scene.from_file(scene),
        executor=executor,
        out=store,
        again=again,
        **settings,
        **other_body,
    )
    return comparison, store


def read_candidate(
    table: Mapping[str, Any], scene: Path, body_number: int, materials: Materials, where: str
) -> Candidate:
    """Make a candidate from its table: the body of the scene with other keys, and its data."""
    for key in table:
        check_key(key, CANDIDATE, where)
    body_values = {key: table[key] for key in ("coatings", "E", "nu") if key in table}
    settings = [
        f"body{body_number}.{key}={to_inline_toml(value)}" for key, value in body_values.items()
    ]
    try:
        whole = Scene.from_file(scene, set=settings)
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from error
    body = whole.body2 if body_number == 2 else whole.body1
    data: dict[str, Any] = {key: table[key] for key in PLAIN if key in table}
    if "material" in table:
        data["materials"] = map_layers(table["material"], lambda name: materials[name])
    if "s_y" in table:
        data["s_y"] = table["s_y"]
    if "wear" in table:
        data["wear"] = read_wear(table["wear"], f"{where}.wear", materials)
    if "conductor" in table:
        data["conductor"] = read_conductor(table["conductor"], f"{where}.conductor", materials)
    if "threshold" in table:
        numbers = check_table(table["threshold"], THRESHOLD, f"{where}.threshold")
        data["threshold"] = Threshold(**numbers)
    return Candidate(body, **data)


def map_layers(values: Any, make: Any) -> Any:
    """Convert one value, or one for each layer; an empty text for a layer without a value."""
    if isinstance(values, list):
        return [make(value) if value else None for value in values]
    return make(values)


def read_wear(value: Any, where: str, materials: Materials) -> Any:
    """Read laws of wear: ``{ k = .. }`` or ``{ alpha = .. }``, one or one for each layer."""

    def law(table: Any) -> Any:
        """Read one law."""
        numbers = check_table(table, LAW, where)
        kind = [name for name in LAWS if name in numbers]
        if len(kind) != 1:
            raise ValueError(f"{where} = {table!r}: must have k or alpha, one of them")
        coefficient = numbers.pop(kind[0])
        return LAWS[kind[0]](coefficient, **numbers)

    return map_layers(value, law)


def read_conductor(value: Any, where: str, materials: Materials) -> Any:
    """Read conductors: the name of a material, or its numbers, one or one for each layer."""

    def conductor(entry: Any) -> Conductor:
        """Read one conductor."""
        if isinstance(entry, str):
            return Conductor.from_material(materials[entry])
        return Conductor(**check_table(entry, CONDUCTOR, where))

    return map_layers(value, conductor)


def check_table(table: Any, keys: tuple[str, ...], where: str) -> dict[str, Any]:
    """Check that a table has valid keys only, and return it."""
    if not isinstance(table, dict):
        raise ValueError(f"{where} = {table!r}: must be a table of {', '.join(keys)}")
    for key in table:
        check_key(key, keys, where)
    return dict(table)


def to_inline_toml(value: Any) -> str:
    """Write a value on one line of TOML."""
    if isinstance(value, dict):
        return (
            "{" + ", ".join(f"{key} = {to_inline_toml(item)}" for key, item in value.items()) + "}"
        )
    if isinstance(value, list):
        return "[" + ", ".join(map(to_inline_toml, value)) + "]"
    return to_toml_value(value)
