"""Materials by their names, and the table of all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret._core import Elastic, Material, Plastic, material_quantities, quantity_in_si
from pyfret._util.compiled import register_materials
from pyfret._util.material_names import find_material
from pyfret._util.scene_warnings import warn
from pyfret.fatigue import Materials
from pyfret.fatigue.ranges import known_as
from pyfret.quantities import YieldStress, quantities

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator

    import pandas as pd

__all__ = ["elastic_from", "hardness_from", "list_table", "material", "materials"]

#: Poisson's ratio of what none is known of: hard nitrides and carbon films have 0.2 to 0.3, which
#: moves E/(1 - nu^2) by 3 % to either side.
NU = 0.25
#: Hardness over yield stress: mean pressure of a fully plastic contact (D. Tabor, The Hardness
#: of Metals, 1951).
HARDNESS_RATIO = 2.8


#: How a number is known, in the words of the table.
KNOWN = {"known": "measured", "estimate": "estimated", "recalled": "recalled"}


@quantities
def list_table(
    file: str | os.PathLike[str] | None = None, *, sources: bool = False
) -> pd.DataFrame:
    """List the materials as a table of pandas, by the names that :func:`material` takes.

    Parameters
    ----------
    file : path, optional
        A table of your own (TOML), whose materials are listed as well.
    sources : bool
        Whether the table has a row for every number: its value, unit and source. The column
        ``known`` is ``"measured"``, ``"estimated"`` by a published rule or ``"recalled"`` from
        memory. Default False: a row for every material, units in the names of the columns.

    Returns
    -------
    pandas.DataFrame
        Indexed by the name; ``kind`` is steel, metal, ceramic, coating or polymer.

    Examples
    --------
    >>> fret.materials().loc["chromium", "E [Pa]"]
    279000000000.0
    """
    from pyfret._util.frame import Frame

    if isinstance(file, str) and find_material(file, Materials()) is not None:
        raise ValueError(
            f"file = {file!r}: is the name of a material, fret.material({file!r}); must be a file"
        )
    table = Materials(file)
    units = {name: unit for name, unit, _ in material_quantities()}
    if sources:
        rows = [
            (entry.name, name, value, units[name], KNOWN[known_as(source)], source)
            for entry in table.values()
            for name, value, source in entry.numbers()
        ]
        heads = ["name", "quantity", "value", "unit", "known", "source"]
        return Frame(rows, columns=heads).set_index("name")
    listed = []
    for entry in table.values():
        values = {name: value for name, value, _ in entry.numbers()}
        numbers = {
            f"{name} [{unit}]" if unit != "1" else name: values.get(name, float("nan"))
            for name, unit in units.items()
        }
        about = {"also": ", ".join(entry.also), "title": entry.title}
        usual = {head: numbers[head] for head in USUAL}
        entries = ({"name": entry.name, "kind": entry.kind}, usual, numbers, about)
        listed.append({head: value for part in entries for head, value in part.items()})
    return Frame(listed).set_index("name")


#: First columns of the list.
USUAL = ("E [Pa]", "nu", "s_y [Pa]", "hardness [Pa]")


@quantities
def material(
    name: str,
    file: str | os.PathLike[str] | None = None,
    *,
    nu: float | None = None,
    plastic: bool = False,
) -> Elastic:
    """Give a material of the table that comes with the package by its name, for bodies and layers.

    Its modulus and its Poisson's ratio with their sources, and what else is known of it, are in
    :class:`pyfret.fatigue.Materials`. Moduli of coatings depend on how they were made: take your
    own where there are any.

    Parameters
    ----------
    name : str
        Key of the material, such as ``"TiN"``, ``"steel_42CrMo4"``, or another name of it, such as
        ``"steel"``, ``"316L"``, ``"Ti6Al4V"``, ``"7075"``, ``"Al2O3"``.
    file : path, optional
        A table of your own (TOML), which takes precedence over the package's table.
    nu : float, optional
        Poisson's ratio in place of the value in the table.
    plastic : bool
        Whether it yields at the yield stress of the table, without hardening (default False).

    Raises
    ------
    KeyError
        There is no such material; the message lists those that there are.
    ValueError
        The table has no modulus of it, or, with ``plastic``, no yield stress.

    Warns
    -----
    SceneWarning
        The table has no Poisson's ratio of the material, as of most coatings: 0.25 is taken. Or its
        modulus is from memory, without a source. With ``plastic`` the same holds for its yield
        stress.

    Examples
    --------
    >>> material("titanium_6Al4V").E > 1e11
    True
    """
    chosen = Materials(file)[name]
    sources = {key: source for key, _, source in chosen.numbers()}
    if known_as(sources.get("E", "")) == "recalled":
        warn(
            f"{chosen.name}: its modulus of {chosen.number('E') / 1e9:g} GPa is from memory, "
            "without a source; give your own, Elastic(E=..., nu=...)",
        )
    if nu is None and "nu" not in sources:
        warn(
            f"{name}: the table has no Poisson's ratio of it, {NU:g} is taken; give nu=",
        )
        nu = NU
    law = None
    if plastic:
        if "s_y" not in sources:
            raise ValueError(
                f"{name}: the table has no yield stress of it; give your own, "
                "Elastic(E=..., nu=..., plastic=Plastic(s_y=...))"
            )
        if known_as(sources["s_y"]) == "recalled":
            warn(
                f"{chosen.name} ({chosen.title}): its yield stress of "
                f"{chosen.number('s_y') / 1e6:g} MPa is from memory ({sources['s_y']}); give your "
                "own, Elastic(E=..., nu=..., plastic=Plastic(s_y=...))",
            )
        law = Plastic(s_y=chosen.number("s_y"))
    nu = chosen.number("nu") if nu is None else nu
    return Elastic(E=chosen.number("E"), nu=nu, plastic=law)


def elastic_from(value: Any, parameter: str) -> Any:
    """Return the elastic material of a name or of a row of the table; other values unchanged.

    Raises
    ------
    ValueError
        There is no such material, or the table has no modulus of it.
    """
    if isinstance(value, Material):
        numbers = {name: number for name, number, _ in value.numbers()}
        return Elastic(E=value.number("E"), nu=numbers.get("nu", NU))
    if not isinstance(value, str):
        return value
    try:
        return material(value)
    except KeyError as error:
        raise ValueError(f"{parameter}: {error.args[0]}") from None


@quantities
def hardness_from(hardness: YieldStress | Material | str) -> float:
    """Return a hardness [Pa]: a number, with or without a unit, or 2.8 times a yield stress."""
    is_text = isinstance(hardness, str) and hardness.strip()[:1].isdigit()
    if is_text or isinstance(hardness, (int, float)):
        return quantity_in_si("material stress", hardness)
    chosen = Materials()[hardness] if isinstance(hardness, str) else hardness
    if not isinstance(chosen, Material):
        raise TypeError(f"hardness = {hardness!r}: must be a pressure in Pa or a material")
    if "s_y" not in {key for key, _, _ in chosen.numbers()}:
        raise ValueError(
            f"hardness: the table has no yield stress of {chosen.name}; give a pressure in Pa"
        )
    return HARDNESS_RATIO * chosen.number("s_y")


class MaterialTable:
    """The table of materials: called, it lists them; by a name it gives a material.

    ``fret.materials()`` is a table of pandas, see :func:`list_table`. ``fret.materials["TiN"]`` is
    the elastic material :func:`material` with that name.
    """

    __name__ = "materials"

    def __call__(
        self, file: str | os.PathLike[str] | None = None, *, sources: bool = False
    ) -> pd.DataFrame:
        """List the materials: :func:`list_table`."""
        return list_table(file, sources=sources)

    def __getitem__(self, name: str) -> Elastic:
        """Return the material of a name: :func:`material`."""
        return material(name)

    def __iter__(self) -> Iterator[str]:
        """Go through the names."""
        return iter(Materials())

    def __len__(self) -> int:
        """Count the materials."""
        return len(Materials())

    def __contains__(self, name: object) -> bool:
        """Whether there is a material of a name."""
        return isinstance(name, str) and find_material(name, Materials()) is not None

    def __repr__(self) -> str:
        """Give the names."""
        return f"materials: {', '.join(self)}"


#: The table of materials.
materials = MaterialTable()

register_materials(elastic_from)
