"""``fret explore [SCENE]``: a page that answers while parameters are dragged."""

from __future__ import annotations

import webbrowser
from typing import TYPE_CHECKING, Any

from pyfret._cli.parser import added
from pyfret._core import Body, Coating, Grid, LoadPath, Scene, Sphere
from pyfret.materials import material
from pyfret.reference import hertz
from pyfret.what_if.page import explore

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "run"]


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command and its options."""
    command = added(commands, "explore", "open a page that answers while parameters are dragged")
    command.add_argument("scene", nargs="?", help="scene file (default: a coated flat)")
    command.add_argument("--port", type=int, default=0, help="port of this machine (default: any)")
    command.add_argument("--no-browser", action="store_true", help="print the address alone")


def run(options: argparse.Namespace) -> int:
    """Serve the page until Ctrl-C."""
    scene = Scene.from_file(options.scene) if options.scene else example()
    page = explore(scene, port=options.port)
    print(f"{page.url} (Ctrl-C ends it)", flush=True)
    if not options.no_browser:
        webbrowser.open(page.url)
    page.wait()
    return 0


def example() -> Scene:
    """An alumina ball on titanium with 3 um of titanium nitride."""
    ball, alloy = material("alumina"), material("titanium_6Al4V")
    R, W = 5e-3, 10.0
    a = hertz(R=R, bodies=(ball, alloy), W=W).a
    return Scene(
        body1=Body(ball, shape=Sphere(R=R)),
        body2=Body(alloy, coatings=[Coating(material("TiN"), thickness=3e-6)]),
        friction=0.4,
        grid=Grid.centred(width=2.6 * a, n=48),
        path=LoadPath.start().normal(W).cycles(1, T_x=0.3 * W),
        title="A ball on 3 um of TiN on titanium",
    )
