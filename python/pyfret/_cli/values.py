"""Values of options: numbers that may have their unit, ``20e-6`` or ``"20 um"``, and settings."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret._core import measured_by, si_of, unit_of
from pyfret._util.toml import parse_toml

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["DEGREES", "FIGURES", "Value", "Values", "ending", "number", "pair", "setting", "takes"]

#: Endings of figures.
FIGURES = (".png", ".svg", ".pdf")
#: The unit of an angle that is a number alone.
DEGREES = "degrees"


def number(key: str, text: str) -> float:
    """Read a number in SI, alone or with a unit, by the key of its quantity.

    Raises
    ------
    ValueError
        The text is no number, or the unit is none of this quantity. The message has those allowed.
    """
    try:
        return float(text)
    except ValueError:
        pass
    if measured_by(key) is None:
        raise ValueError(f"{text!r}: must be a number: the unit of {key} is not known")
    return si_of(key, text.strip())


@dataclass(frozen=True)
class Value:
    """What makes an option a number, by the key of its quantity: the type of its argument."""

    key: str
    #: Unit of a number alone (default: the SI unit).
    own: str = ""

    @property
    def unit(self) -> str:
        """Return the unit of a number without one."""
        return self.own or (measured_by(self.key) or ("", ""))[1]

    def __call__(self, text: str) -> float:
        """The number in :attr:`unit`."""
        try:
            return float(text)
        except ValueError:
            pass
        try:
            value = number(self.key, text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None
        size = unit_of(self.own) if self.own else None
        return value if size is None else value / size[1]


class Values:
    """What makes an option several numbers, commas between them.

    One value holds for all places, several for one place each.
    """

    def __init__(self, *kinds: Value) -> None:
        self.kinds = kinds

    @property
    def unit(self) -> str:
        """Return the units of the numbers."""
        return ", ".join(part.unit for part in self.kinds if part.unit)

    def __call__(self, text: str) -> list[float]:
        """The numbers."""
        parts = text.split(",")
        if len(self.kinds) == 1:
            return [self.kinds[0](part) for part in parts]
        if len(parts) != len(self.kinds):
            raise argparse.ArgumentTypeError(f"{text!r}: must be {len(self.kinds)} values")
        return [of(part) for of, part in zip(self.kinds, parts, strict=True)]


def takes(
    command: argparse.ArgumentParser, name: str, of: Value | Values, help: str, **more: Any
) -> None:
    """Add an option that is a quantity; its help names the unit, and allows another one."""
    command.add_argument(name, type=of, help=f"{help} [{of.unit}, or with a unit]", **more)


def ending(*allowed: str) -> Callable[[str], str]:
    """Return a type of argument: the name of a file with one of some endings.

    A name that nothing can be written to is refused before anything is computed.
    """

    def named(text: str) -> str:
        """Return the name, if it has an allowed ending."""
        if Path(text).suffix.lower() not in allowed:
            raise argparse.ArgumentTypeError(f"{text!r}: must end in {', '.join(allowed)}")
        return text

    return named


def pair(text: str, option: str) -> tuple[str, str]:
    """Split ``KEY=VALUE`` into key and value."""
    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise ValueError(f"{option} {text}: must be KEY=VALUE, such as grid.n=128")
    return key, value


def setting(text: str) -> tuple[str, Any]:
    """Read a key of a scene file and its value.

    A value that is no TOML is a text.
    """
    key, value = pair(text, "--set")
    try:
        return key, parse_toml(f"value = {value}")["value"]
    except ValueError:
        return key, value
