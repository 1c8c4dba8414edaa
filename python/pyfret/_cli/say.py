"""What the commands write: text of others cannot act on the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pyfret._util.text import shown

if TYPE_CHECKING:
    from typing import TextIO

__all__ = ["say"]


def say(text: object, *, file: TextIO | None = None) -> None:
    """Print a line, to the standard output unless another one is given."""
    print(shown(str(text)), file=file)
