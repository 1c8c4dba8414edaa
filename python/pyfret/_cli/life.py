"""``fret life``: a fatigue criterion over the cycle of a result, from the command line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pyfret import _core, fatigue
from pyfret._util import files
from pyfret.result import open

if TYPE_CHECKING:
    import argparse

    import xarray as xr

    from pyfret._core import Material
    from pyfret.fatigue.lives import Life
    from pyfret.fatigue.section import SectionOptions
    from pyfret.result import Result

__all__ = ["add_options", "run"]

#: Endings of figures, and of files of the fields.
FIGURES, FIELDS = (".png", ".svg", ".pdf"), (".nc", ".zarr")


def add_options(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to a command line."""
    life = commands.add_parser(
        "life", help="judge the stress below the contact over a cycle by a fatigue criterion"
    )
    life.add_argument("store", help="result, the increments of its cycle kept")
    life.add_argument(
        "--material",
        metavar="NAMES",
        help="name of the material, or one for each layer from the surface down, with commas; "
        "'none' leaves a layer out (default: the only one of --materials)",
    )
    life.add_argument("--materials", metavar="FILE", help="table of materials (TOML)")
    life.add_argument("--criterion", required=True, choices=fatigue.CRITERIA)
    life.add_argument("--body", type=int, choices=(1, 2), default=2, help="default: 2, the lower")
    where = life.add_mutually_exclusive_group()
    where.add_argument(
        "--along-x", type=float, metavar="Y", help="section along x at this y [m] (default: 0)"
    )
    where.add_argument("--along-y", type=float, metavar="X", help="section along y at this x [m]")
    life.add_argument(
        "--depths", type=numbers, metavar="Z,...", help="depths [m] (default: as the layers ask)"
    )
    life.add_argument("--cycle", type=int, default=-1, help="which cycle (default: the last)")
    life.add_argument(
        "--residual",
        type=numbers,
        metavar="S,...",
        help="residual stress of each layer from the surface down [Pa], tension positive; "
        "write --residual=-1e9,0 if the first is negative",
    )
    life.add_argument(
        "--distance",
        type=float,
        metavar="L",
        help="judge the mean stress from the surface to the depth 2 L [m]",
    )
    life.add_argument("--json", action="store_true", help="one JSON object per layer")
    life.add_argument("-o", "--out", help="figure (.png, .svg, .pdf) or fields (.nc)")


def numbers(text: str) -> list[float]:
    """Numbers with commas between them."""
    return [float(part) for part in text.split(",")]


def run(options: argparse.Namespace) -> int:
    """Judge a result and say what came out."""
    _check_ending(options)
    result = open(options.store)
    materials = _materials(options, result)
    section: SectionOptions = {
        "x": options.along_y,
        "y": options.along_x,
        "body_number": options.body,
        "cycle": options.cycle,
        "residual": options.residual,
    }
    if options.distance is not None:
        L, criterion = options.distance, options.criterion
        # The distance belongs to the outermost layer.
        outermost = materials[0]
        if outermost is None:
            raise ValueError("--distance: the outermost layer has no material")
        mean = fatigue.average(result, outermost, criterion, L=L, **section)
        found, dataset = [_worst_mean(mean)], mean
    else:
        life = result.life(materials, options.criterion, options.depths, **section)
        found, dataset = _worst(life), life.dataset
        if options.out and Path(options.out).suffix in FIGURES:
            _draw(life, options.out)
    for row in found:
        print(json.dumps(row) if options.json else _line(row))
    if options.out and Path(options.out).suffix in FIELDS:
        files.write(dataset, options.out)
    return 0


def _check_ending(options: argparse.Namespace) -> None:
    if options.out is None:
        return
    ending = Path(options.out).suffix
    allowed = FIELDS if options.distance is not None else (*FIGURES, *FIELDS)
    if ending not in allowed:
        means = ": means over a distance have no figure" if ending in FIGURES else ""
        raise ValueError(f"--out {options.out}: must end in {', '.join(allowed)}{means}")


def _materials(options: argparse.Namespace, result: Result) -> list[Material | None]:
    """The material of every layer of the body, from the surface down."""
    table = fatigue.Materials(options.materials)
    if options.material is None:
        own = [m.name for m in _core.materials(options.materials)] if options.materials else []
        if len(own) != 1:
            raise ValueError(f"--material is missing: one of {', '.join(own or table)}")
        names = own
    else:
        names = options.material.split(",")
    unknown = [name for name in names if name != "none" and name not in table]
    if unknown:
        raise ValueError(f"--material {unknown[0]}: must be one of {', '.join(table)}, or none")
    scene = result.scene
    body = scene.body1 if options.body == 1 else scene.body2
    if len(names) == 1:
        names = names * (len(body.coatings) + 1)
    return [None if name == "none" else table[name] for name in names]


def _worst(life: Life) -> list[dict[str, object]]:
    """The worst point of every layer that is judged, the one that decides marked."""
    worst, name = life.worst, str(life.margin.name)
    rows = []
    for layer in life.layers:
        w = life.worst_of(layer)
        rows.append(
            {
                "criterion": life.dataset.attrs["criterion"],
                name: w.margin,
                "value": w.value,
                "unit": life.dataset.value.attrs["units"],
                "error": w.error,
                "x": w.x,
                "y": w.y,
                "z": w.z,
                "layer": layer,
                "normal": w.normal,
                "decides": layer == worst.layer,
            }
        )
    return rows


def _worst_mean(mean: xr.Dataset) -> dict[str, object]:
    """The worst place of a mean over a critical distance."""
    along = str(mean.value.dims[0])
    worst = mean.isel({along: int(np.nanargmax(mean.value))})
    name = "life" if "life" in mean else "safety_factor"
    return {
        "criterion": mean.attrs["criterion"],
        name: float(worst[name]),
        "value": float(worst.value),
        "unit": mean.value.attrs["units"],
        "L": mean.attrs["L"],
        along: float(worst[along]),
        "layer": 0,
    }


def _line(row: dict[str, object]) -> str:
    """A row for people."""
    name = "life" if "life" in row else "safety_factor"
    margin = f"{row[name]:.4g} cycles" if name == "life" else f"safety factor {row[name]:.4g}"
    error = f" (depths +- {row['error']:.2g})" if "error" in row else ""
    places = ", ".join(f"{axis} = {row[axis]:.4e} m" for axis in "xyz" if axis in row)
    line = f"layer {row['layer']}: {margin}, {row['criterion']} {row['value']:.5e} {row['unit']}"
    line += f"{error} at {places}"
    if isinstance(row.get("normal"), tuple):
        line += ", plane normal ({:.3f}, {:.3f}, {:.3f})".format(*row["normal"])  # type: ignore[misc]
    if "L" in row:
        line += f", mean down to {2 * row['L']:.3e} m"  # type: ignore[operator]
    return line + (", decides" if row.get("decides") else "")


def _draw(life: Life, out: str) -> None:
    """Write the map of the criterion."""
    from pyfret import plot

    ax = plot.criterion_map(life)
    ax.get_figure().savefig(out, bbox_inches="tight")  # type: ignore[union-attr]
