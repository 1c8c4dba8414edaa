"""The points of a study, and the scene of each point."""

from __future__ import annotations

import json
import math
import re
import warnings
import zlib
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from os import PathLike
from pathlib import Path
from typing import Any, Literal, Protocol, TypeAlias, runtime_checkable

import numpy as np

from pyfret import _core
from pyfret._core import InvalidSceneError, Scene
from pyfret._util.arrays import items, labels
from pyfret._util.keywords import nearest_names
from pyfret._util.lazy import xr
from pyfret._util.parameters import SHORT, in_si, opposite, single
from pyfret._util.scene_warnings import doubt_numbers, warn
from pyfret._util.text import read_text
from pyfret._util.toml import parse_toml
from pyfret.quantities import quantities
from pyfret.study.identity import code_checksum

__all__ = ["Combine", "Design", "Source", "check_source", "with_values"]

#: How the values of several parameters are combined.
Combine: TypeAlias = Literal["grid", "zip"]
#: A scene, its file, or a function that makes one of the values of the parameters.
Source: TypeAlias = "Scene | str | PathLike[str] | Callable[[dict[str, Any]], Scene]"


@runtime_checkable
class DescribesScenes(Protocol):
    """A function that describes its scenes, so that studies can be distinguished."""

    def describe(self) -> str:
        """Return a text that differs if the scenes differ."""


#: Ends of keys, which are parameters where the scene has one such key.
ENDS_OF_KEYS = ("R", "E", "nu", "thickness", "T_x", "delta_x", "sigma_B")
#: Most keys that a shortened name may mean for a message.
MOST_MEANT = 3
#: The dimension of a study whose parameters change together.
TOGETHER = "point"


def check_source(source: Source, parameter: str = "scene") -> None:
    """Refuse what is no scene, no path and no function that makes one.

    Raises
    ------
    TypeError
        It is neither; the message has the parameter.
    """
    if not (isinstance(source, Scene | str | PathLike) or callable(source)):
        raise TypeError(
            f"{parameter} = {source!r:.60}: must be a Scene, the path of a file, or a function "
            "that makes a Scene of a dict"
        )


#: A line of the text that a scene is made from.
LINE_OF_TEXT = re.compile(r"\bscene:\d+: ")


@quantities
def with_values(scene: Scene | str | PathLike[str], values: Mapping[str, Any]) -> Scene:
    """Give a scene with other values of its parameters.

    Parameters
    ----------
    scene : Scene or path
        What is varied. A scene file keeps its own measures: a thickness of ``{ a_H = 1.0 }``
        follows the radius; a :class:`Scene` has all numbers in SI units.
    values : mapping of str to value
        By the keys of a scene file, such as ``"body2.coatings.0.thickness"`` or
        ``"path.1.T_x.mu_W"``; ``"mu"`` is short for ``"friction.mu"``. ``"path.*.W"`` stands for
        every branch. Several keys with commas between get the same value, and a key after a ``-``
        the opposite one. So ``"path.1.T_x,-path.2.T_x,path.3.T_x"`` is an amplitude. Of a
        :class:`Scene` a part of a key is enough where one key alone has it, ``"body1.R"``.

    Raises
    ------
    InvalidSceneError
        A key does not exist, or a value has no meaning; the message names both.

    Examples
    --------
    >>> harder = with_values("coated.toml", {"body2.coatings.0.E": 3e11})  # doctest: +SKIP
    """
    expanded = expand_keys(values.items(), scene)
    # "friction" is short for the coefficient, and names the part as well.
    objects = {
        (name if key == SHORT.get(name) else key): item
        for key, name, item in expanded
        if is_part(item)
    }
    settings = [f"{key}={to_toml_value(item)}" for key, _, item in expanded if not is_part(item)]
    if not isinstance(scene, Scene):
        return replace_parts(Scene.from_file(scene, set=settings), objects)
    keys = {key for key, _, _ in expanded}
    text = text_of_scene(scene, keys) if settings else ""
    try:
        made = Scene.from_toml(text, set=settings) if settings else scene
    except InvalidSceneError as error:
        candidates = {name: keys_meant(name, text) for name in values}
        if "unknown key" not in str(error) or not any(candidates.values()):
            # No file was read: a line of the text is no place.
            message = LINE_OF_TEXT.sub("", str(error))
            raise type(error)(message) from None
        if all(len(names) < 2 for names in candidates.values()):
            return with_values(
                scene, {(candidates[k] or [k])[0]: value for k, value in values.items()}
            )
        hints = [" or ".join(map(repr, names)) for names in candidates.values() if names]
        raise InvalidSceneError(f"{error}; did you mean {' and '.join(hints)}?") from None
    made = replace_parts(made, objects)
    warn_single_branch(values, scene)
    if callable(scene.friction.law):
        # A function stands in no text.
        return made.replace(friction=made.friction.replace(law=scene.friction.law))
    return made


def keys_of_document(part: Any, start: str = "") -> Iterator[str]:
    """Give the keys of the values of a document, with points between their names."""
    entries = part.items() if isinstance(part, dict) else enumerate(part)
    for name, value in entries:
        key = f"{start}{name}"
        is_nested = isinstance(value, dict) or (
            isinstance(value, list) and bool(value) and isinstance(value[0], dict)
        )
        if is_nested:
            yield from keys_of_document(value, f"{key}.")
        else:
            yield key


def keys_meant(name: str, text: str) -> list[str]:
    """Return the keys of a scene that a shortened name such as ``body1.R`` may mean.

    None where the name is a key itself, or where more than three fit. The parts of the name stand
    in the key in this order, the last one at its end. A plural counts.
    """
    parts = [part.lower().rstrip("s") for part in single(name).split(".")]
    document = parse_toml(text)
    document.pop("path", None)
    fitting = []
    for key in keys_of_document(document):
        words = [word.lower().rstrip("s") for word in key.split(".")]
        remaining = iter(words)
        if words[-1] == parts[-1] and all(part in remaining for part in parts):
            fitting.append(key)
    is_known = single(name) in fitting or single(name) in SHORT
    return [] if is_known or len(fitting) > MOST_MEANT else fitting


def is_part(value: Any) -> bool:
    """Whether a value is an object of pyfret, such as a grid, a body or a coating."""
    return type(value).__module__.partition(".")[0] == "pyfret"


def replace_parts(scene: Scene, parts: Mapping[str, Any]) -> Scene:
    """Return a scene with objects at keys: ``{"grid": Grid(...), "body2.coatings.0": Coating()}``.

    Raises
    ------
    InvalidSceneError
        The scene has no such part.
    TypeError
        The object is of another class than the part.
    """

    def put(owner: Any, names: list[str], value: Any) -> Any:
        if not names:
            return value
        name, *others = names
        try:
            if isinstance(owner, (list, tuple)):
                changed = list(owner)
                changed[int(name)] = put(changed[int(name)], others, value)
                return changed
            return owner.replace(**{name: put(getattr(owner, name), others, value)})
        except (AttributeError, LookupError):
            raise InvalidSceneError(f"{key}: the scene has no such part") from None

    for key, value in parts.items():
        scene = put(scene, key.split("."), value)
    return scene


def text_of_scene(scene: Scene, keys: Collection[str]) -> str:
    """Return a scene as a file has it.

    Other numbers of cells leave the sides of the grid, and other sides the numbers of cells.
    """
    text = scene.to_toml()
    if not {"grid.n", "grid.extent"} & set(keys) or "grid.spacing" in keys:
        return text
    grid = scene.grid
    sides = f"extent = [{grid.nx * grid.dx!r}, {grid.ny * grid.dy!r}]"
    before, heading, after = text.partition("[grid]\n")
    return before + heading + re.sub("^spacing = .*$", sides, after, count=1, flags=re.MULTILINE)


def expand_key(
    key: str, value: Any, scene: Scene | str | PathLike[str]
) -> Iterator[tuple[str, Any]]:
    """Expand a key with commas, signs or ``*`` into keys with one value each."""
    for part in key.split(","):
        # The place in a list may stand in brackets, as messages write it.
        part_key = single(part)
        part_value = opposite(value) if part.strip().startswith("-") else value
        if ".*." in part_key:
            read_scene = scene if isinstance(scene, Scene) else Scene.from_file(scene)
            for n in range(len(read_scene.path.branches)):
                yield part_key.replace(".*.", f".{n}."), part_value
        else:
            yield part_key, part_value


def expand_keys(
    values: Iterable[tuple[str, Any]], scene: Scene | str | PathLike[str]
) -> list[tuple[str, str, Any]]:
    """Expand names to keys of a scene file; return key, original name and value of each.

    Raises an :exc:`InvalidSceneError` if two names set one value, or if a name sets a part of the
    value of another one.
    """
    settings: list[tuple[str, str, Any]] = []
    for name, value in values:
        for short_key, single_value in expand_key(name, value, scene):
            key = SHORT.get(short_key, short_key)
            for earlier, earlier_name, _ in settings:
                if f"{key}.".startswith(f"{earlier}.") or f"{earlier}.".startswith(f"{key}."):
                    shared = (
                        key if key == earlier else f"{min(key, earlier, key=len)} and its parts"
                    )
                    setters = (
                        f"{earlier_name} and {name} set" if earlier_name != name else f"{name} sets"
                    )
                    raise InvalidSceneError(f"{setters} {shared} twice: give it once")
            settings.append((key, name, single_value))
    return settings


def warn_single_branch(values: Mapping[str, Any], scene: Scene) -> None:
    """Warn of a normal force of one branch from which the next goes back to the old one."""
    branches = scene.path.branches
    for key in values:
        match = re.fullmatch(r"path\.(\d+)\.W", key)
        after = int(match[1]) + 1 if match else len(branches)
        if after < len(branches) and branches[after].W == branches[after - 1].W:
            warn(
                f"{key}: of this branch alone, the next goes back to W = "
                f"{branches[after].W:g}; path.*.W sets all",
            )


def to_toml_value(value: Any) -> str:
    """Write a value as in a scene file."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return json.dumps(value)


def describe_function(function: object) -> str:
    """Return the name of a function with a checksum of its code."""
    name = getattr(function, "__qualname__", type(function).__qualname__)
    return f"function {name} {code_checksum(function)}"


def to_list(values: Any, key: str) -> list[Any]:
    """Return the values of a parameter as a list.

    Raises
    ------
    TypeError
        A value is not a number, a text, a list or a table.
    ValueError
        They have no order, values are missing, or the array has several axes with names.
    """
    if isinstance(values, str | Mapping | Set) or not hasattr(values, "__len__"):
        raise ValueError(f"{key} = {values!r:.60}: must be a list of values")
    array = values
    if axes := labels(values):
        if len(axes) != 1:
            raise ValueError(f"{key} has the axes {', '.join(map(str, axes))}: must have one")
        array = np.asanyarray(values)
    if np.ma.isMaskedArray(array):
        if np.ma.is_masked(array):
            raise ValueError(f"{key} has masked values: must have a value at every point")
        array = array.filled()
    return [to_scene_value(value, key) for value in items(array, key)]


def read_quantities(values: list[Any]) -> list[Any]:
    """Convert texts with units to numbers in SI, unless one of the texts has no unit."""
    numbers = [read_quantity(value) if isinstance(value, str) else value for value in values]
    return values if any(number is None for number in numbers) else numbers


def read_quantity(text: str) -> float | None:
    """Return the number in SI of a text such as "2 um"; None of other texts."""
    number, _, name = text.strip().partition(" ")
    unit = _core.unit_of(name.strip()) if name else None
    try:
        return None if unit is None else float(number) * unit[1]
    except ValueError:
        return None


def to_scene_value(value: Any, key: str) -> Any:
    """Convert a value to a number, a text, a list or a table of a scene file."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, Decimal | Fraction):
        value = float(value)
    try:
        json.dumps(value)
    except (TypeError, ValueError):
        raise TypeError(
            f"{key} = {value!r:.60}: must be a number, a text, a list or a table"
        ) from None
    return value


@dataclass(frozen=True)
class Design:
    """The points of a study.

    Attributes
    ----------
    parameters : mapping of str to list
        Values of every parameter.
    combine : "grid" or "zip"
        Every combination, or the values in step with one another.
    given : mapping of str to list
        Values of parameters that were given with units. Scenes are made of these, so that a force
        per length is refused where the contact is no line contact.
    """

    parameters: Mapping[str, Sequence[Any]]
    combine: Combine
    given: Mapping[str, Sequence[Any]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Reject values that define no study."""
        if not self.parameters:
            raise ValueError('no parameters: give some, such as {"mu": [0.2, 0.4]}')
        for key, values in self.parameters.items():
            if len(values) == 0:
                raise ValueError(f"{key}: has no values")
            if "/" in key:
                raise ValueError(f'{key}: a "/" parts folders of the store; write "_" or "over"')
            plain = [value for value in values if isinstance(value, int | float | str)]
            if self.combine == "grid" and len(set(plain)) < len(plain):
                twice = next(value for value in plain if plain.count(value) > 1)
                raise ValueError(f"{key}: {twice!r:.60} stands twice, a grid has each value once")
        lengths = {key: len(values) for key, values in self.parameters.items()}
        if self.combine not in ("grid", "zip"):
            raise ValueError(f'combine = {self.combine!r}: must be "grid" or "zip"')
        if self.combine == "zip" and len(set(lengths.values())) > 1:
            raise ValueError(f'combine = "zip": the numbers of values must be the same: {lengths}')

    @staticmethod
    def from_values(
        parameters: Mapping[str, Any], combine: Combine, *, keys: bool = True
    ) -> Design:
        """Make a design of values in any form: lists, arrays, ranges, texts with units.

        Quantities become numbers in SI. Where the names are no `keys` of a scene file, the unit
        decides alone, and texts stay texts if one of them has no unit.
        """
        lists = {key: to_list(values, key) for key, values in parameters.items()}
        numbers = {
            key: [in_si(key, value) for value in values] if keys else read_quantities(values)
            for key, values in lists.items()
        }
        if not keys:
            lists = numbers
        for key, values in numbers.items():
            doubt_numbers("", **{SHORT.get(key, key): values})
        return Design(
            numbers, combine, {k: values for k, values in lists.items() if values != numbers[k]}
        )

    @property
    def sizes(self) -> dict[str, int]:
        """Dimensions of the study."""
        if self.combine == "zip":
            return {TOGETHER: len(next(iter(self.parameters.values())))}
        return {key: len(values) for key, values in self.parameters.items()}

    def __len__(self) -> int:
        """Number of points."""
        return math.prod(self.sizes.values())

    def place(self, n: int) -> tuple[int, ...]:
        """Indices of the n-th point along the dimensions; the last one changes first."""
        return tuple(int(i) for i in np.unravel_index(n, tuple(self.sizes.values())))

    def values(
        self, n: int, other_lists: Mapping[str, Sequence[Any]] | None = None
    ) -> dict[str, Any]:
        """Values of the parameters at the n-th point, in SI or from `other_lists`."""
        lists = self.parameters if other_lists is None else other_lists
        indices = self.place(n) if self.combine == "grid" else self.place(n) * len(self.parameters)
        return {
            key: list_of_values[i]
            for (key, list_of_values), i in zip(lists.items(), indices, strict=True)
        }

    def coords(self) -> dict[str, xr.Variable]:
        """Coordinates of the study: numbers as they are, other values as text."""
        coords = {}
        for key, values in self.parameters.items():
            numbers = all(isinstance(v, int | float) for v in values)
            data = np.array(values if numbers else [to_toml_value(v) for v in values])
            dim = TOGETHER if self.combine == "zip" else key
            coords[key] = xr.Variable((dim,), data, {"long_name": key})
        return coords

    def scene(self, source: Source, n: int) -> Scene:
        """Return the scene of the n-th point."""
        if isinstance(source, Scene | str | PathLike):
            return with_values(source, self.values(n, {**self.parameters, **self.given}))
        return source(self.values(n))

    def describe(self, source: Source, code: Mapping[str, str]) -> str:
        """Describe the origin of the points as JSON, so that studies can be distinguished.

        `code` holds checksums of the functions that measure.
        """
        files: dict[str, int] = {}
        if isinstance(source, Scene):
            text = source.to_toml()
        elif isinstance(source, str | PathLike):
            text = read_text(Path(source))
            files = self.files(Path(source), text)
        elif isinstance(source, DescribesScenes):
            text = source.describe()
        else:
            text = describe_function(source)
        design = {
            "parameters": dict(self.parameters),
            "combine": self.combine,
            "scene": text,
            "files": files,
            "code": dict(code),
        }
        if isinstance(source, Scene) and callable(source.friction.law):
            design["law"] = describe_function(source.friction.law)
        return json.dumps(design)

    def files(self, scene: Path, text: str) -> dict[str, int]:
        """Return checksums of the files named in a scene file and in parameter values."""
        file_names = {
            v for values in self.parameters.values() for v in values if isinstance(v, str)
        }
        file_names |= set(iter_texts(parse_toml(text)))
        checksums = {}
        for name in sorted(file_names):
            path = scene.parent / name
            if name and path.is_file():
                checksums[name] = zlib.crc32(path.read_bytes())
        return checksums

    def check(self, source: Source) -> None:
        """Reject parameters without any valid scene, for example a misspelt key."""
        if not isinstance(source, Scene | str | PathLike):
            return
        self.check_effects(source)
        first: InvalidSceneError | None = None
        for n in range(len(self)):
            try:
                self.scene(source, n)
            except InvalidSceneError as error:
                first = first or error
                if "unknown key" in str(error):
                    break
            except Exception:
                return
            else:
                return
        if first is not None:
            why = "; ".join(str(first).splitlines())
            raise ValueError(f"no point of the study has a scene: {why}{self.suggest_name()}")

    def check_effects(self, source: Scene | str | PathLike[str]) -> None:
        """Reject a parameter whose values have no effect, since another one sets the same key."""
        try:
            counts = {key: self.count_scenes(source, key) for key in self.parameters}
        except (InvalidSceneError, OSError, ValueError, TypeError, ArithmeticError):
            # The points report the error.
            return
        for key, (with_others, alone) in counts.items():
            if with_others == 1 < alone:
                others = ", ".join(name for name in self.parameters if name != key)
                raise ValueError(f"{key}: its values make no difference beside {others}")

    def count_scenes(self, source: Scene | str | PathLike[str], key: str) -> tuple[int, int]:
        """Count the different scenes of two values of a parameter, with other values and alone."""
        values = self.parameters[key]
        two = [values[0], next((v for v in values if v != values[0]), values[0])]
        first = {name: values[0] for name, values in self.parameters.items()}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with_others = {with_values(source, first | {key: value}).to_toml() for value in two}
            alone = {with_values(source, {key: value}).to_toml() for value in two}
        return len(with_others), len(alone)

    def suggest_name(self) -> str:
        """Suggest the nearest short name for an unknown parameter."""
        valid = [*SHORT, "friction", "grid", "body1", "body2", "path", "solver", "kernel"]
        for key in self.parameters:
            if key.split(".")[0] not in valid:
                near = nearest_names(key, (*SHORT, *ENDS_OF_KEYS), 1)
                return f"; {key:.200}: the nearest is {near[0]}" if near else ""
        return ""


def iter_texts(value: Any) -> Iterator[str]:
    """Yield the texts in the values of a scene file."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for item in value.values():
            yield from iter_texts(item)
    elif isinstance(value, list):
        for item in value:
            yield from iter_texts(item)
