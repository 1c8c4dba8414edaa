"""``fret crack``: stress intensity over a cycle and arrest of a crack below a result's contact."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pyfret import fatigue
from pyfret._cli.parser import added
from pyfret._cli.printing import print_json, print_text
from pyfret._cli.values import DEGREES, FIGURES, Value, Values, ending, takes
from pyfret._core import with_error
from pyfret._util import files
from pyfret._util.numbers import in_words, um
from pyfret._util.window import format_table
from pyfret.fracture import Paris, Threshold
from pyfret.result import open_result

if TYPE_CHECKING:
    import argparse

    from pyfret.fracture import CrackArrest, CrackLife, Cracks
    from pyfret.result import Result

__all__ = ["add_crack", "add_options", "cracks_of", "run", "threshold_of"]

#: Endings of files of the fields.
FIELDS = (".nc", ".zarr")


def add_options(commands: argparse._SubParsersAction[Any]) -> None:
    """Add the command to a command line."""
    crack = added(commands, "crack", "compute whether a crack below the contact grows or stops")
    crack.add_argument("store", help="result, the increments of its cycle kept")
    add_crack(crack)
    crack.add_argument("--json", action="store_true", help="one JSON object per length and verdict")
    takes(
        crack,
        "--start",
        Value("length"),
        "length that the crack begins with (default: the shortest)",
    )
    takes(
        crack,
        "--paris",
        Values(Value("Paris.C"), Value("number")),
        "growth C and its exponent m (default: the numbers of --material)",
        metavar="C,M",
    )
    crack.add_argument(
        "-o",
        "--out",
        type=ending(*FIGURES, *FIELDS),
        help="figure (.png, .svg, .pdf) or K over the cycle (.nc, .zarr)",
    )


def add_crack(crack: argparse.ArgumentParser) -> None:
    """Add the options of the crack and the threshold."""
    length, angle = Value("length"), Value("angle", DEGREES)
    takes(crack, "--x", length, "place of the mouth (default: the worse rim of the contact)")
    takes(crack, "--angle", angle, "from the inward normal towards +x", default=0.0)
    takes(crack, "--lengths", Values(length), "lengths of the crack", metavar="L,...")
    takes(
        crack,
        "--kink",
        Values(length, angle),
        "length after which cracks go on at another angle",
        metavar="L,ANGLE",
    )
    crack.add_argument(
        "--grow",
        choices=("tangential_stress", "opening_intensity"),
        help="let the crack choose its way by the largest range of this, from the first of the "
        "lengths to the last",
    )
    takes(crack, "--azimuth", angle, "of its plane about z (default: of the largest range)")
    takes(
        crack,
        "--offset",
        length,
        "of its plane from the z axis, to the left of its direction (default: through the centre "
        "of the largest contact)",
    )
    crack.add_argument(
        "--aspect", type=float, help="depth over half-length of a semi-ellipse: an estimate"
    )
    crack.add_argument("--friction", type=float, default=0.0, help="between its faces (default: 0)")
    crack.add_argument("--body", type=int, choices=(1, 2), default=2, help="default: 2, the lower")
    crack.add_argument("--cycle", type=int, default=-1, help="which cycle (default: the last)")
    takes(
        crack,
        "--residual",
        Values(Value("residual")),
        "residual stress of each layer from the surface down, tension positive; "
        "write --residual=-1e9,0 if the first is negative",
        metavar="S,...",
    )
    takes(crack, "--dK-th", Value("dK_th"), "threshold of K", dest="dK_th")
    takes(crack, "--dS-0", Value("dS_0"), "fatigue limit, range of stress", dest="dS_0")
    crack.add_argument("--material", help="takes dK_th and s_D of a material instead")
    crack.add_argument("--materials", metavar="FILE", help="table of materials (TOML)")
    crack.add_argument("--walker", type=float, help="exponent of the load ratio (default: none)")


def run(options: argparse.Namespace) -> int:
    """Take the stress of a result to the tips of cracks and print the arrest."""
    threshold = threshold_of(options)
    if options.paris is not None and threshold is None:
        raise ValueError("--paris: needs a threshold, --dK-th or --material")
    if options.start is not None and threshold is None:
        raise ValueError("--start: needs a threshold, --dK-th or --material")
    if options.out and Path(options.out).suffix in FIGURES and threshold is None:
        raise ValueError("--out: the figure needs a threshold, --dK-th or --material")
    result = open_result(options.store)
    cracks = cracks_of(result, options)
    rows = _rows(cracks, threshold)
    if threshold is not None:
        rows.append(_verdict(cracks, cracks.arrest(threshold, start=options.start)))
    if threshold is not None:
        growth = threshold.growth if options.paris is None else Paris(*options.paris)
        if growth is not None:
            rows[-1] |= _cycles(cracks.life(threshold, growth, start=options.start))
    if options.json:
        for row in rows:
            print_json(row)
    else:
        verdict = rows.pop() if threshold is not None else None
        if verdict is not None:
            print_text(_sentence(verdict))
        print_text(_table(rows))
    if options.out and Path(options.out).suffix in FIELDS:
        files.write(cracks.dataset, options.out, otherwise="")
    elif options.out and threshold is not None:
        from pyfret import plot

        plot.crack_panels(result, cracks, threshold, start=options.start).savefig(options.out)
    return 0


def cracks_of(result: Result, options: argparse.Namespace) -> Cracks:
    """Return the cracks that the options describe, or the one that grows."""
    azimuth = None if options.azimuth is None else math.radians(options.azimuth)
    common: dict[str, Any] = {
        "angle": math.radians(options.angle),
        "azimuth": azimuth,
        "offset": options.offset,
        "friction": options.friction,
        "body_number": options.body,
        "cycle": options.cycle,
        "residual": options.residual,
    }
    if options.grow is not None:
        if options.kink is not None or options.aspect is not None:
            raise ValueError("--grow: leave out --kink and --aspect")
        if options.lengths is not None:
            common |= {"start": min(options.lengths), "end": max(options.lengths)}
        return result.grow_crack(options.x, direction=options.grow, **common)
    kink = None
    if options.kink is not None:
        kink = (options.kink[0], math.radians(options.kink[1]))
    return result.crack(
        options.x, lengths=options.lengths, kink=kink, aspect=options.aspect, **common
    )


def threshold_of(options: argparse.Namespace) -> Threshold | None:
    """Return the threshold that the options describe; None without one."""
    if options.material is not None:
        if options.dK_th is not None or options.dS_0 is not None:
            raise ValueError("--material: gives --dK-th and --dS-0 itself; leave these out")
        table = fatigue.Materials(options.materials)
        if options.material not in table:
            raise ValueError(f"--material {options.material}: must be one of {', '.join(table)}")
        return Threshold.from_material(table[options.material], walker=options.walker)
    if options.dK_th is None:
        if options.dS_0 is not None:
            raise ValueError("--dS-0: needs --dK-th")
        return None
    return Threshold(options.dK_th, options.dS_0, walker=options.walker)


def _rows(cracks: Cracks, threshold: Threshold | None) -> list[dict[str, object]]:
    """Return a row for each length: K_I and K_II over the cycle with errors, and the range."""
    columns = {
        "length": cracks.lengths,
        "K_max": cracks.K_max,
        "K_max_error": cracks.error,
        "K_min": cracks.K_min,
        "K_min_error": cracks.K_min_error,
        "dK": cracks.dK(threshold),
        "dK_error": cracks.dK_error(threshold),
    }
    values = zip(*(column.tolist() for column in columns.values()), strict=True)
    rows: list[dict[str, object]] = [dict(zip(columns, row, strict=True)) for row in values]
    if threshold is not None:
        for row, dK_th in zip(rows, threshold.range_at(cracks.lengths).tolist(), strict=True):
            row["dK_th"] = dK_th
            if threshold.estimate:
                row["estimate"] = threshold.estimate
    return rows


def _verdict(cracks: Cracks, arrest: CrackArrest) -> dict[str, object]:
    """Return the row of the arrest; a missing number has its reason."""
    row: dict[str, object] = {
        "x": cracks.dataset.attrs["x"],
        "verdict": arrest.verdict,
        "start": arrest.start,
        "length": arrest.length,
        "growing": arrest.growing,
        "at_start": arrest.at_start,
        "at_start_error": arrest.at_start_error,
        "margin": arrest.margin,
        "margin_error": arrest.margin_error,
        "margin_at": arrest.margin_at,
        "lengths": arrest.lengths,
        "verdicts": arrest.verdicts,
        "is_sure": arrest.is_sure,
        "told": arrest.describe(),
        "notes": arrest.notes(),
    }
    if arrest.length is None:
        row["length_why"] = arrest.briefly()
    return row | ({"estimate": arrest.estimate} if arrest.estimate else {})


def _cycles(life: CrackLife) -> dict[str, object]:
    """Return the cycles of crack growth with their range, as numbers and in words."""
    row: dict[str, object] = {"cycles": life.cycles, "low": life.low, "high": life.high}
    why = life.why_infinite()
    return (
        row
        | ({} if why is None else {"cycles_why": why})
        | {
            "cycles_told": life.describe(),
            "cycles_notes": life.notes(),
        }
    )


def _sentence(row: dict[str, Any]) -> str:
    """Write the verdict on a crack as a sentence."""
    notes = [*row["notes"], *row.get("cycles_notes", [])]
    # A note on estimates that both have stands once.
    return f"crack from x = {um(row['x'])} {'; '.join(dict.fromkeys(notes))}"


def _table(rows: list[dict[str, Any]]) -> str:
    """Write K over the length as a table, each number with its error."""
    unit = "[MPa m^0.5]"
    titles = ["l", f"K_I min\n{unit}", f"K_I max\n{unit}", f"dK\n{unit}"]
    cells = [
        [
            um(row["length"]),
            *(
                with_error(row[name] / 1e6, row[f"{name}_error"] / 1e6)
                for name in ("K_min", "K_max", "dK")
            ),
        ]
        for row in rows
    ]
    if "dK_th" in rows[0]:
        titles.append(f"dK_th\n{unit}{' (estimate)' * ('estimate' in rows[0])}")
        for row, line in zip(rows, cells, strict=True):
            line.append(in_words(row["dK_th"] / 1e6))
    return format_table(titles, cells)
