"""The command ``fret`` that comes with the package."""

from __future__ import annotations

import os
import sys

from pyfret._core import run_command

__all__ = ["NEEDS_PYTHON", "main"]

#: Commands that are written in Python; the others are compiled.
NEEDS_PYTHON = frozenset(
    (
        "study",
        "compare",
        "explore",
        "export",
        "crack",
        "damage",
        "fit",
        "threshold",
        "report",
        "verify",
        "cite",
        "info",
        "workbench",
        "table",
    )
)


def main() -> None:
    """Run the command with the arguments of this process."""
    # The commands that need Python are run by this interpreter.
    os.environ.setdefault("FRET_PYTHON", sys.executable)
    sys.exit(run_command(["fret", *sys.argv[1:]]))
