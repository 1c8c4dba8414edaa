"""pyfret beside public programs, FFTW and the paper's own iterations, in one run.

    python benches/peers.py --out out

The peers are installed from the package registry into an environment of their own; every program
solves in a process of its own. What was measured goes to OUT/peers.json, tables to OUT/peers.md and
figures beside them; with --document they go between the marks of that page too.
"""

from __future__ import annotations

import argparse
import json
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import convolution
import environment
import figures
import fretting
import runs
import side_by_side
import tables

if TYPE_CHECKING:
    from collections.abc import Iterable

    Row = dict[str, Any]

#: Figures that belong to a part, and stand below its table.
FIGURES = {"wavy": "peers_frictionless.png", "fretting": "peers_fretting.png"}
PARTS = ("hertz", "wavy", "rough", "convolution", "fretting", "runs", "large")


def collect(rows: Iterable[Row]) -> list[Row]:
    """The rows, each told as it comes."""
    kept = []
    for row in rows:
        print({k: v for k, v in row.items() if k != "version"}, flush=True)
        kept.append(row)
    return kept


def contact(peers: environment.Peers, scene: str, *, quick: bool) -> dict[str, list[Row]]:
    """A frictionless contact: tolerances on one grid, then grids under the one that suffices."""
    grids = {
        "hertz": (64, 128, 256, 512, 1024),
        "wavy": (256, 1024),
        "rough": (256, 512, 1024, 2048),
    }
    sizes = grids[scene]
    cells, sizes, seconds = (64, (64,), 0.2) if quick else (256, sizes, 4.0)
    ladder = collect(side_by_side.precision(peers, scene, cells, seconds / 8))
    on_grids = collect(side_by_side.grids(peers, scene, sizes, ladder, seconds))
    return {scene: on_grids, f"{scene}_tolerances": ladder}


def measure(part: str, peers: environment.Peers, *, quick: bool) -> dict[str, list[Row]]:
    """One part."""
    print(f"# {part}", flush=True)
    if part in ("hertz", "wavy", "rough"):
        return contact(peers, part, quick=quick)
    if part == "convolution":
        sizes, rounds = ((64, 128), 1) if quick else ((256, 512, 1024), convolution.ROUNDS)
        rows: Iterable[Row] = convolution.measure(peers, sizes, rounds)
    elif part == "fretting":
        cases = fretting.cases(quick=quick)
        rows = (row for case in cases for row in fretting.measure(case))
    elif part == "runs":
        rows = runs.command_line(quick=quick)
    else:
        rows = runs.large((128,) if quick else (1024, 4096))
    return {part: collect(rows)}


def report(found: dict[str, list[Row]], out: Path, document: Path | None) -> None:
    """Tables and figures of what there is."""
    write = {
        "hertz": tables.side_by_side,
        "wavy": tables.side_by_side,
        "rough": tables.side_by_side,
        "convolution": tables.convolution,
        "fretting": tables.fretting,
        "runs": tables.runs,
        "large": tables.large,
    }
    texts = {part: write[part](found[part]) for part in PARTS if found.get(part)}
    if found.get("hertz") and found.get("wavy"):
        ladder = found["wavy_tolerances"]
        figures.frictionless(found["hertz"], ladder, out / FIGURES["wavy"])
    if found.get("fretting"):
        figures.fretting(found["fretting"], out / FIGURES["fretting"])
    page = "\n\n".join(f"## {name}\n\n{text}" for name, text in texts.items())
    (out / "peers.md").write_text(page + "\n")
    print(page)
    if document is None:
        return
    for name in texts:
        figure = out / FIGURES.get(name, "")
        if figure.is_file():
            shutil.copy(figure, document.parent / "figures")
            texts[name] += f"\n\n![Error against time](figures/{figure.name})"
        tables.write_between_marks(document, name, texts[name])


def main() -> None:
    """Measure what is asked for; what an earlier run measured of the rest is kept."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="small grids: does it work at all?")
    parser.add_argument("--only", nargs="+", choices=PARTS, default=list(PARTS), metavar="PART")
    parser.add_argument("--document", type=Path, help="page whose tables are written anew")
    parser.add_argument(
        "--environment",
        type=Path,
        default=environment.ROOT / ".venv-peers",
        help="where the peers are installed",
    )
    options = parser.parse_args()
    out: Path = options.out
    out.mkdir(parents=True, exist_ok=True)
    peers = environment.peers(options.environment.resolve())
    for name, reason in peers.missing.items():
        print(f"{name} is not installed: {reason}")
    record = out / ("peers_quick.json" if options.quick else "peers.json")
    found = json.loads(record.read_text()) if record.exists() else {}
    for part in options.only:
        found |= measure(part, peers, quick=options.quick)
        record.write_text(json.dumps(found, indent=1))
    report(found, out, options.document)


if __name__ == "__main__":
    main()
