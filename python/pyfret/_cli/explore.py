"""``fret workbench`` and ``fret explore``: the page that answers while parameters are changed."""

from __future__ import annotations

import webbrowser
from typing import TYPE_CHECKING, Any

from pyfret._cli.parser import added
from pyfret._util.extras import application

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "run"]

#: What each of the commands opens.
COMMANDS = {
    "explore": "open a page that answers while parameters are dragged",
    "workbench": "open the workbench: contact, answers, variants, measured files, reports",
}


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the commands and their options."""
    for name, does in COMMANDS.items():
        command = added(commands, name, does)
        command.add_argument(
            "file",
            nargs="?",
            help="scene file, store, map or recording (default: a ball on a coated flat)",
        )
        command.add_argument(
            "--port", type=int, default=0, help="port of this machine (default: any)"
        )
        command.add_argument("--no-browser", action="store_true", help="print the address alone")


def run(options: argparse.Namespace) -> int:
    """Serve the page until Ctrl-C."""
    page = application("pyfret.workbench.page").open_workbench(options.file, port=options.port)
    print(f"{page.url} (Ctrl-C ends it)", flush=True)
    if not options.no_browser:
        webbrowser.open(page.url)
    page.wait()
    return 0
