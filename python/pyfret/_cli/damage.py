"""``fret damage``: fatigue damage, or wear, of a contact by a measured load history."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret import fatigue
from pyfret._cli.parser import added
from pyfret._cli.printing import print_json, print_text
from pyfret._cli.values import FIGURES, Value, ending, pair, setting, takes
from pyfret._core import Scene, wear_of_file
from pyfret.history.load_history import LoadHistory
from pyfret.history.scene_file import read_history
from pyfret.history.table import HistoryTable
from pyfret.study.design import to_toml_value, with_values
from pyfret.wear.runs import block_of_history
from pyfret.wear.settings import read as read_wear

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
        "history",
        nargs="?",
        help="recording: a table, TDMS, MAT, HDF5, MDF or a workbook of Excel (default: the table "
        "[history] of the scene)",
    )
    command.add_argument("--material", help="name of the material; without it no damage is summed")
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
    command.add_argument(
        "--store",
        metavar="FOLDER",
        help="folder that keeps the runs; a call that was interrupted goes on from there",
    )
    command.add_argument(
        "--block",
        type=ending(".toml"),
        metavar="FILE",
        help="write a scene with the loops of the history as one cycle of its table [wear], for "
        "fret wear",
    )
    command.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Sum the damage and print it, or write the block of wear."""
    changes = dict(setting(text) for text in options.set)
    scene = with_values(options.scene, changes)
    assert isinstance(scene, Scene)
    history = read(options, changes)
    if options.block:
        write_block(options, history)
        if options.material is None:
            print_text(f"{history.count().summary()}\nwritten: {options.block}")
            return 0
    table = HistoryTable.build(scene, history, store=options.store)
    if options.material is None:
        print_text(table.summary())
        return 0
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
                "errors": damage.errors,
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


def read(options: argparse.Namespace, changes: dict[str, Any]) -> LoadHistory:
    """Read the recording, or the history of the scene."""
    if options.history is None:
        history = read_history(options.scene, changes)
        if history is None:
            raise ValueError(
                f"{options.scene}: has no table [history]: give one, or a recording: "
                "fret damage SCENE HISTORY"
            )
        return history
    return LoadHistory.from_csv(
        options.history,
        columns=dict(pair(text, "--column") for text in options.column) or None,
        units=dict(pair(text, "--unit") for text in options.unit) or None,
        frequency=options.frequency,
        residue=options.residue,
    )


def write_block(options: argparse.Namespace, history: LoadHistory) -> None:
    """Write a scene whose cycle of wear has the loops of a history."""
    scene, of_file = wear_of_file(options.scene, options.set)
    settings = read_wear(of_file)
    path, block = block_of_history(scene, history, {})
    table, _ = settings.replace(**block).document()
    lines = [f"{key} = {toml_text(value)}" for key, value in table.items()]
    text = "\n".join([scene.replace(path=path).to_toml().rstrip(), "", "[wear]", *lines, ""])
    Path(options.block).write_text(text, encoding="utf-8")


def toml_text(value: Any) -> str:
    """Write a value of TOML, tables in a line."""
    if isinstance(value, dict):
        parts = (f"{key} = {toml_text(item)}" for key, item in value.items() if item is not None)
        return f"{{ {', '.join(parts)} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(toml_text(item) for item in value)}]"
    return to_toml_value(value)
