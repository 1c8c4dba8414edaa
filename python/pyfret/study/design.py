"""Which points a study has, and the scene of each."""

from __future__ import annotations

import difflib
import json
import math
import re
import sys
import warnings
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from os import PathLike
from pathlib import Path
from typing import Any, Literal, Protocol, TypeAlias, runtime_checkable

import numpy as np

from pyfret._core import InvalidSceneError, Scene
from pyfret._util.arrays import items, labels
from pyfret._util.lazy import xr
from pyfret._util.parameters import SHORT, in_si, opposite, single
from pyfret._util.scene_warnings import doubt_numbers, warn
from pyfret._util.text import read_text
from pyfret.quantities import quantities
from pyfret.study.identity import identity

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

__all__ = ["Combine", "Design", "Source", "varied"]

#: How the values of several parameters are combined.
Combine: TypeAlias = Literal["grid", "zip"]
#: A scene, its file, or a function that makes one of the values of the parameters.
Source: TypeAlias = "Scene | str | PathLike[str] | Callable[[dict[str, Any]], Scene]"


@runtime_checkable
class Described(Protocol):
    """A function that says what its scenes are made of, by which studies are told apart."""

    def describe(self) -> str:
        """All that its scenes follow from."""


#: The dimension of a study whose parameters change together.
TOGETHER = "point"


@quantities
def varied(scene: Scene | str | PathLike[str], values: Mapping[str, Any]) -> Scene:
    """Give a scene with other values of its parameters.

    Parameters
    ----------
    scene : Scene or path
        What is varied. A scene file keeps its own measures: a thickness of ``{ a_H = 1.0 }``
        follows the radius; a :class:`Scene` has all numbers in SI units.
    values : mapping of str to value
        By the keys of a scene file, such as ``"body2.coatings.0.thickness"`` or
        ``"path.1.T_x.mu_W"``; ``"mu"`` is short for ``"friction.mu"``. ``"path.*.W"`` is that of
        every branch. Several keys with commas between get the same value, and a key after a ``-``
        the opposite one. So ``"path.1.T_x,-path.2.T_x,path.3.T_x"`` is an amplitude.

    Raises
    ------
    InvalidSceneError
        A key does not exist, or a value has no meaning; the message names both.

    Examples
    --------
    >>> harder = varied("coated.toml", {"body2.coatings.0.E": 3e11})  # doctest: +SKIP
    """
    settings = [f"{key}={toml(each)}" for key, _, each in once(values.items(), scene)]
    if not isinstance(scene, Scene):
        return Scene.from_file(scene, set=settings)
    made = Scene.from_toml(scene.to_toml(), set=settings)
    told_alone(values, scene)
    if callable(scene.friction.law):
        # A function stands in no text.
        return made.replace(mu=made.friction.replace(law=scene.friction.law))
    return made


def spread(key: str, value: Any, scene: Scene | str | PathLike[str]) -> Iterator[tuple[str, Any]]:
    """The keys that one stands for, each with its value."""
    for part in key.split(","):
        # The place in a list may stand in brackets, as messages write it.
        one = single(part)
        each = opposite(value) if part.strip().startswith("-") else value
        if ".*." in one:
            whole = scene if isinstance(scene, Scene) else Scene.from_file(scene)
            for n in range(len(whole.path.branches)):
                yield one.replace(".*.", f".{n}."), each
        else:
            yield one, each


def once(
    values: Iterable[tuple[str, Any]], scene: Scene | str | PathLike[str]
) -> list[tuple[str, str, Any]]:
    """Keys of a scene file, the names that they were given by, and their values.

    An :exc:`InvalidSceneError` if two names set one value, or one of them what the other is part
    of.
    """
    found: list[tuple[str, str, Any]] = []
    for name, value in values:
        for one, each in spread(name, value, scene):
            key = SHORT.get(one, one)
            for other, by, _ in found:
                if f"{key}.".startswith(f"{other}.") or f"{other}.".startswith(f"{key}."):
                    shared = (
                        key if key == other else f"{min(key, other, key=len)} and what it holds"
                    )
                    both = f"{by} and {name} set" if by != name else f"{name} sets"
                    raise InvalidSceneError(f"{both} {shared} twice: give it once")
            found.append((key, name, each))
    return found


def told_alone(values: Mapping[str, Any], scene: Scene) -> None:
    """Warn of a normal force of one branch from which the next goes back to the old one."""
    branches = scene.path.branches
    for key in values:
        found = re.fullmatch(r"path\.(\d+)\.W", key)
        after = int(found[1]) + 1 if found else len(branches)
        if after < len(branches) and branches[after].W == branches[after - 1].W:
            warn(
                f"{key}: of this branch alone, the next goes back to W = "
                f"{branches[after].W:g}; path.*.W is that of all",
            )


def toml(value: Any) -> str:
    """A value as a scene file has it."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return json.dumps(value)


def function_name(of: object) -> str:
    """How a function is told from others: by its name, and by what it does."""
    name = getattr(of, "__qualname__", type(of).__qualname__)
    return f"function {name} {identity(of)}"


def listed(values: Any, key: str) -> list[Any]:
    """The values of a parameter in a list, of arrays those of their one axis.

    Raises
    ------
    TypeError
        One of them is nothing that a scene file has.
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
    return [plain(value, key) for value in items(array, key)]


def plain(value: Any, key: str) -> Any:
    """A value as a scene file has it: a number, a text, a list or a table."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, Decimal | Fraction):
        value = float(value)
    try:
        json.dumps(value)
    except (TypeError, ValueError):
        raise TypeError(
            f"{key} = {value!r:.60}: must be a number, a text, or what else a scene file has"
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
        """Refuse what is no study."""
        if not self.parameters:
            raise ValueError('no parameters: give some, such as {"mu": [0.2, 0.4]}')
        for key, values in self.parameters.items():
            if len(values) == 0:
                raise ValueError(f"{key}: has no values")
            if "/" in key:
                raise ValueError(f'{key}: a "/" parts folders of the store; write "_" or "over"')
            plain = [one for one in values if isinstance(one, int | float | str)]
            if self.combine == "grid" and len(set(plain)) < len(plain):
                twice = next(one for one in plain if plain.count(one) > 1)
                raise ValueError(f"{key}: {twice!r:.60} stands twice, a grid has each value once")
        lengths = {key: len(values) for key, values in self.parameters.items()}
        if self.combine not in ("grid", "zip"):
            raise ValueError(f'combine = {self.combine!r}: must be "grid" or "zip"')
        if self.combine == "zip" and len(set(lengths.values())) > 1:
            raise ValueError(f'combine = "zip": the numbers of values must be the same: {lengths}')

    @staticmethod
    def of(parameters: Mapping[str, Any], combine: Combine, *, keys: bool = True) -> Design:
        """The design of values in any form: lists, arrays, ranges, texts with units.

        Quantities become numbers in SI where the names are `keys` of a scene file.
        """
        given = {key: listed(values, key) for key, values in parameters.items()}
        found = {
            key: [in_si(key, value) if keys else value for value in values]
            for key, values in given.items()
        }
        for key, values in found.items():
            doubt_numbers("", **{SHORT.get(key, key): values})
        return Design(found, combine, {k: of for k, of in given.items() if of != found[k]})

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

    def values(self, n: int, of: Mapping[str, Sequence[Any]] | None = None) -> dict[str, Any]:
        """Values of the parameters at the n-th point, in SI or as another list `of` has them."""
        lists = self.parameters if of is None else of
        place = self.place(n) if self.combine == "grid" else self.place(n) * len(self.parameters)
        return {key: each[i] for (key, each), i in zip(lists.items(), place, strict=True)}

    def coords(self) -> dict[str, xr.Variable]:
        """Coordinates of the study: numbers as they are, the rest as text."""
        coords = {}
        for key, values in self.parameters.items():
            numbers = all(isinstance(v, int | float) for v in values)
            data = np.array(values if numbers else [toml(v) for v in values])
            dim = TOGETHER if self.combine == "zip" else key
            coords[key] = xr.Variable((dim,), data, {"long_name": key})
        return coords

    def scene(self, source: Source, n: int) -> Scene:
        """The scene of the n-th point."""
        if isinstance(source, Scene | str | PathLike):
            return varied(source, self.values(n, {**self.parameters, **self.given}))
        return source(self.values(n))

    def describe(self, source: Source, code: Mapping[str, str]) -> str:
        """Tell this study from others: what makes its points, as JSON.

        `code` holds checksums of the functions that measure.
        """
        files: dict[str, int] = {}
        if isinstance(source, Scene):
            what = source.to_toml()
        elif isinstance(source, str | PathLike):
            what = read_text(Path(source))
            files = self.files(Path(source), what)
        elif isinstance(source, Described):
            what = source.describe()
        else:
            what = function_name(source)
        design = {
            "parameters": dict(self.parameters),
            "combine": self.combine,
            "scene": what,
            "files": files,
            "code": dict(code),
        }
        if isinstance(source, Scene) and callable(source.friction.law):
            design["law"] = function_name(source.friction.law)
        return json.dumps(design)

    def files(self, scene: Path, text: str) -> dict[str, int]:
        """Checksums of the files that a scene file and the values of the parameters name."""
        named = {v for of in self.parameters.values() for v in of if isinstance(v, str)}
        named |= set(texts(tomllib.loads(text)))
        found = {}
        for name in sorted(named):
            path = scene.parent / name
            if name and path.is_file():
                found[name] = zlib.crc32(path.read_bytes())
        return found

    def check(self, source: Source) -> None:
        """Refuse parameters of which no value makes a scene, such as a key that is misspelt."""
        if not isinstance(source, Scene | str | PathLike):
            return
        self.check_each_sets(source)
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
            raise ValueError(f"no point of the study has a scene: {why}{self.meant()}")

    def check_each_sets(self, source: Scene | str | PathLike[str]) -> None:
        """Refuse a parameter whose values make no difference, since another one sets the same."""
        try:
            texts_of = {key: self.texts_of(source, key) for key in self.parameters}
        except (InvalidSceneError, OSError, ValueError, TypeError, ArithmeticError):
            # What is wrong with it is said of the points.
            return
        for key, (beside, alone) in texts_of.items():
            if beside == 1 < alone:
                others = ", ".join(other for other in self.parameters if other != key)
                raise ValueError(f"{key}: its values make no difference beside {others}")

    def texts_of(self, source: Scene | str | PathLike[str], key: str) -> tuple[int, int]:
        """How many scenes two values of a parameter make, beside the others and alone."""
        of = self.parameters[key]
        two = [of[0], next((v for v in of if v != of[0]), of[0])]
        first = {name: values[0] for name, values in self.parameters.items()}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            beside = {varied(source, first | {key: value}).to_toml() for value in two}
            alone = {varied(source, {key: value}).to_toml() for value in two}
        return len(beside), len(alone)

    def meant(self) -> str:
        """What short names of parameters may have been meant."""
        known = [*SHORT, "friction", "grid", "body1", "body2", "path", "solver", "kernel"]
        for key in self.parameters:
            if key.split(".")[0] not in known:
                near = difflib.get_close_matches(key, SHORT, n=1)
                return f"; {key}: the nearest is {near[0]}" if near else ""
        return ""


def texts(value: Any) -> Iterator[str]:
    """The texts in the values of a scene file."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for one in value.values():
            yield from texts(one)
    elif isinstance(value, list):
        for one in value:
            yield from texts(one)
