"""``fret info FILE``: what a file is, and what would be read of it."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from pyfret._cli.parser import added
from pyfret._cli.printing import print_json, print_text
from pyfret.file_info import describe_file

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "run"]


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command and its options."""
    info = added(
        commands, "info", "print what a file is: format, units, axes, size, what is read, doubts"
    )
    info.add_argument("file", help="map, recording, mesh, results of finite elements, or store")
    info.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Describe a file."""
    info = describe_file(options.file)
    if options.json:
        print_json(asdict(info), indent=2)
    else:
        print_text(info)
    return 0
