"""``fret fit``: unknowns of a scene from a measured table, from the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret import fit
from pyfret._cli.parser import added
from pyfret._cli.printing import print_json, print_text
from pyfret._cli.values import FIGURES, ending, number, pair, setting
from pyfret.study.design import with_values

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "run"]


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command to a command line."""
    command = added(
        commands, "fit", "find unknowns of a scene (mu, a rig, a coating) from a measured table"
    )
    command.add_argument("data", help="table with units in its head, such as delta [um];T [N]")
    command.add_argument("scene", help="scene file with all that is known")
    command.add_argument(
        "--unknown",
        action="append",
        required=True,
        metavar="KEY=LOW:HIGH",
        help="an unknown by its key, and its range, such as mu=0.1:1.5, rig.stiffness=1e6:1e8",
    )
    command.add_argument(
        "--kind", choices=("loops", "indentation"), default="loops", help="default: loops"
    )
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="replace a value of the scene file",
    )
    command.add_argument("--x", metavar="NAME", help="column of the shift or the approach")
    command.add_argument("--force", metavar="NAME", help="column of the force")
    command.add_argument(
        "--unit", action="append", default=[], metavar="NAME=UNIT", help="unit of a column"
    )
    command.add_argument(
        "--posterior",
        type=int,
        default=0,
        metavar="SAMPLES",
        help="that many samples of the posterior, too: its 95 %% intervals",
    )
    command.add_argument("--json", action="store_true", help="values and confidence as JSON")
    command.add_argument("-o", "--out", type=ending(*FIGURES), help="figure (.png, .svg, .pdf)")


def run(options: argparse.Namespace) -> int:
    """Fit, and print the result."""
    unknown = dict(range_of(text) for text in options.unknown)
    units = dict(pair(text, "--unit") for text in options.unit)
    settings = dict(setting(text) for text in options.set)
    scene = with_values(options.scene, settings)
    data: fit.Loops | fit.Indentation
    if options.kind == "loops":
        data = fit.read_loops(options.data, delta=options.x, T=options.force, units=units)
    else:
        data = fit.read_indentation(options.data, delta_z=options.x, W=options.force, units=units)
    fitted = fit.fit(scene, data, unknown=unknown, posterior=options.posterior)
    if options.json:
        answer: dict[str, Any] = {
            "unknown": {
                key: {"value": k.value, "low": k.low, "high": k.high, "solver": k.solver}
                for key, k in fitted.known.items()
            },
            "offsets": fitted.offsets,
            "correlation": fitted.correlation.tolist(),
            "noise": fitted.noise,
            "solves": fitted.solves,
            "doubts": fitted.doubts,
        }
        if fitted.posterior is not None:
            answer["posterior"] = {key: fitted.posterior.interval(key) for key in fitted.known}
        print_json(answer)
    else:
        print_text(fitted.summary())
    if options.out:
        import matplotlib.pyplot as plt

        figure, (above, below) = plt.subplots(2, 1, layout="constrained", figsize=(6.4, 7.2))
        fitted.plot(ax=above)
        fitted.plot_residuals(ax=below)
        figure.savefig(options.out)
    return 0


def range_of(text: str) -> tuple[str, tuple[float, ...]]:
    """Parse ``KEY=LOW:HIGH`` or ``KEY=LOW:START:HIGH``: the key and its numbers."""
    key, value = pair(text, "--unknown")
    try:
        return key, tuple(number(key, part) for part in value.split(":"))
    except ValueError as error:
        raise ValueError(f"--unknown {text}: must be KEY=LOW:HIGH; {error}") from None
