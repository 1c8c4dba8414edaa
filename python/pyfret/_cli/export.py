"""``fret export``: a result for another program."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import export
from pyfret._cli.parser import added
from pyfret._cli.printing import print_data, print_json
from pyfret._cli.values import Value
from pyfret.result import open_result as open_result

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["add_options", "run", "three"]


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command and its options."""
    command = added(
        commands,
        "export",
        "write tractions, forces on a mesh or stress at points for another program",
    )
    command.add_argument("store", help="result")
    command.add_argument("-o", "--out", required=True, help="file to write; .vti, .vts: an image")
    command.add_argument(
        "--increment",
        "--at",
        dest="at",
        type=int,
        default=-1,
        metavar="INCREMENT",
        help="increment, or -1 for the last kept",
    )
    command.add_argument("--body", type=int, choices=(1, 2), default=2, help="the body (default 2)")
    command.add_argument(
        "--form", choices=("csv", "abaqus", "aster"), default="csv", help="of the file"
    )
    command.add_argument("--of", choices=("p", "q_x", "q_y"), default="p", help="for abaqus")
    command.add_argument("--mesh", help="forces on the nodes of this mesh (.inp, or by meshio)")
    command.add_argument("--points", help="CSV file of places x,y,z: the stress there")
    command.add_argument(
        "--origin",
        default="0,0,0",
        help="middle of the grid in the model [in the unit of --unit, or with a unit]",
    )
    command.add_argument("--axis-x", default="1,0,0", help="the contact's x in the model")
    command.add_argument("--axis-z", default="0,0,1", help="the contact's z, into body 2")
    command.add_argument("--unit", choices=("m", "mm"), default="m", help="length of the model")
    command.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Write the file."""
    frame = export.Frame(
        origin=three(options.origin, "--origin", Value("length", options.unit)),
        x=three(options.axis_x, "--axis-x"),
        z=three(options.axis_z, "--axis-z"),
        unit=options.unit,
    )
    points = None
    if options.points:
        points = np.loadtxt(options.points, delimiter=",", ndmin=2)
    open_result(options.store).export(
        options.out,
        at=options.at,
        frame=frame,
        body_number=options.body,
        form=options.form,
        of=options.of,
        mesh=options.mesh,
        points=points,
    )
    if options.json:
        about = {"file": options.out, "body": options.body, "unit": options.unit}
        print_json(about | {"bytes": Path(options.out).stat().st_size}, indent=2)
    else:
        print_data(options.out)
    return 0


def three(text: str, option: str, of: Callable[[str], float] = float) -> tuple[float, float, float]:
    """Parse three numbers with commas between them; `option` is named in the error."""
    try:
        x, y, z = (of(part) for part in text.split(","))
    except argparse.ArgumentTypeError as error:
        raise ValueError(f"{option}: {error}") from error
    except ValueError as error:
        raise ValueError(f"{option} {text}: must be three numbers such as 0,0,1") from error
    return x, y, z
