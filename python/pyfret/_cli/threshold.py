"""``fret threshold``: the load at which a fatigue criterion reaches its limit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret import fatigue
from pyfret._cli.parser import added
from pyfret._cli.printing import print_json, print_text
from pyfret._cli.values import Value, number, pair, setting, takes
from pyfret._core import measured_by
from pyfret._util.numbers import format_number
from pyfret._util.window import format_table
from pyfret.study.design import with_values
from pyfret.study.thresholds import Averaged, ThresholdLoad, threshold

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "run"]


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command to a command line."""
    command = added(
        commands, "threshold", "find the load at which a fatigue criterion reaches its limit"
    )
    command.add_argument("scene", help="scene file with a closed cycle")
    command.add_argument(
        "--parameter",
        required=True,
        metavar="KEY[,KEY...]",
        help="what is searched: a key of the scene file; a key with - before it gets the value "
        "with the "
        "other sign, as in path.1.T_x,-path.2.T_x,path.3.T_x",
    )
    command.add_argument(
        "--between",
        required=True,
        metavar="LOW:HIGH",
        help="range of the load, in SI units, or with a unit",
    )
    command.add_argument("--material", required=True, help="name of the material")
    command.add_argument("--materials", metavar="FILE", help="table of materials (TOML)")
    command.add_argument(
        "--criterion", choices=fatigue.CRITERIA, default="crossland", help="criterion"
    )
    command.add_argument("--value", type=float, default=1.0, help="safety factor or cycles")
    takes(command, "--distance", Value("L"), "critical distance", metavar="L")
    command.add_argument(
        "--method", choices=("point", "line", "area"), default="line", help="default: line"
    )
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="replace a value of the scene file, as fret run does; may be repeated",
    )
    command.add_argument("--over", metavar="KEY=V,V,...", help="a curve over a second parameter")
    command.add_argument("--json", action="store_true", help="one JSON object per threshold")


def run(options: argparse.Namespace) -> int:
    """Find the threshold, or the curve, and print it."""
    material = fatigue.Materials(options.materials)[options.material]
    measure = Averaged(material, options.criterion, options.distance, options.method)

    changes = dict(setting(text) for text in options.set)

    def scene(values: dict[str, Any]) -> Any:
        """Return the scene of the file with these values."""
        return with_values(options.scene, {**changes, **values, "output.save": "all"})

    searched = options.parameter.split(",")[0].lstrip("-")
    low, _, high = options.between.partition(":")
    over = None
    if options.over:
        key, values = pair(options.over, "--over")
        over = {key: [number(key, value) for value in values.split(",")]}
    load = threshold(
        scene,
        options.parameter,
        measure=measure,
        between=(number(searched, low), number(searched, high)),
        value=options.value,
        over=over,
    )
    if isinstance(load, ThresholdLoad):
        rows = [
            {
                "threshold": load.value,
                "error": load.error,
                "low": load.low,
                "high": load.high,
                "solves": load.solves,
            }
        ]
    else:
        name = next(iter(over or {}))
        rows = [
            {
                name: float(load[name][n]),
                "threshold": float(load.threshold[n]),
                "error": float(load.error[n]),
                "low": float(load.low[n]),
                "high": float(load.high[n]),
                "solves": int(load.solves[n]),
            }
            for n in range(load.sizes[name])
        ]
    note = measure.estimate
    grid = with_values(options.scene, changes).grid
    units = {
        name: grid.unit_of((measured_by(name) or ("", ""))[1]) for name in (searched, *(over or {}))
    }
    if options.json:
        for row in rows:
            print_json(row | {"unit": units[searched]} | ({"estimate": note} if note else {}))
        return 0
    units |= dict.fromkeys(("threshold", "error", "low", "high"), units[searched])
    titles = [f"{name}\n[{units[name]}]" if units.get(name) else name for name in rows[0]]
    print_text(
        format_table(titles, [[format_number(value) for value in row.values()] for row in rows])
    )
    if note:
        print_text(f"estimate: {note}")
    return 0
