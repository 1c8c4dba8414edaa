"""``fret damage``: fatigue damage, or wear, of a contact by a measured load history."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret import fatigue
from pyfret._cli.parser import added
from pyfret._cli.printing import print_json, print_text
from pyfret._cli.values import FIGURES, Value, ending, pair, setting, takes
from pyfret._core import Scene
from pyfret.history.load_history import LoadHistory
from pyfret.history.table import HistoryTable
from pyfret.study.design import with_values

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "run"]

#: Endings of files of the damage.
FIELDS = (".nc", ".zarr")


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command to a command line."""
    command = added(
        commands, "damage", "sum the fatigue damage of a measured load history below a contact"
    )
    command.add_argument(
        "scene", help="scene file; the branches of its path before any shear press the bodies"
    )
    command.add_argument(
        "history", help="recording: a table, TDMS, MAT, HDF5, MDF or a workbook of Excel"
    )
    command.add_argument("--material", required=True, help="name of the material")
    command.add_argument("--materials", metavar="FILE", help="table of materials (TOML)")
    command.add_argument(
        "--criterion",
        choices=fatigue.CRITERIA,
        default="smith_watson_topper",
        help="criterion (default: smith_watson_topper)",
    )
    command.add_argument(
        "--below",
        choices=("original", "elementary", "haibach"),
        default="haibach",
        help="curve of lives below its knee (default: haibach)",
    )
    command.add_argument(
        "--knee", type=float, default=1e7, help="cycles at the knee (default: 1e7)"
    )
    command.add_argument(
        "--exponent", type=float, help="exponent of the lives, for criteria with a limit"
    )
    command.add_argument(
        "--column",
        action="append",
        default=[],
        metavar="CHANNEL=NAME",
        help="column of a channel, such as T_x=Kraft; may be repeated (default: columns that have "
        "the name of a channel)",
    )
    command.add_argument(
        "--unit",
        action="append",
        default=[],
        metavar="NAME=UNIT",
        help="unit of a column whose head has none; may be repeated",
    )
    takes(
        command, "--frequency", Value("frequency"), "samples per second, without a column of time"
    )
    command.add_argument(
        "--residue",
        choices=("half", "repeat"),
        default="repeat",
        help="ranges that do not close: half cycles, or the history repeats (default: repeat)",
    )
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="replace a value of the scene file, as fret run does; may be repeated",
    )
    command.add_argument(
        "-o",
        "--out",
        type=ending(*FIGURES, *FIELDS),
        help="map of the damage (.png, .svg, .pdf) or its numbers (.nc, .zarr)",
    )
    command.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Sum the damage and print it."""
    scene = with_values(options.scene, dict(setting(text) for text in options.set))
    assert isinstance(scene, Scene)
    history = LoadHistory.from_csv(
        options.history,
        columns=dict(pair(text, "--column") for text in options.column) or None,
        units=dict(pair(text, "--unit") for text in options.unit) or None,
        frequency=options.frequency,
        residue=options.residue,
    )
    table = HistoryTable.build(scene, history)
    material = fatigue.Materials(options.materials)[options.material]
    law = fatigue.DamageLaw(options.below, options.knee, options.exponent)
    damage = fatigue.damage(scene, history, material, options.criterion, law=law, table=table)
    if options.out and Path(options.out).suffix.lower() in FIGURES:
        damage.plot().figure.savefig(options.out)
    elif options.out:
        damage.save(options.out, overwrite=True)
    if options.json:
        x, y, z = damage.place
        print_json(
            {
                "damage": damage.worst,
                "error": damage.error,
                "repeats": damage.repeats,
                "place": {"x": x, "y": y, "z": z},
                "loops": table.loops.total,
                "largest_range": table.loops.largest_range,
                "energy": table.total_energy,
                "energy_error": table.energy_error * table.total_energy,
                "compressive": damage.compressive,
                "notes": damage.notes,
            }
        )
    else:
        print_text(f"{table.summary()}\n{damage.summary()}")
    return 0
