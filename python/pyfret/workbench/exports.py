"""The contact of the page for other programs: Python, commands, a link, report, figures, table."""

from __future__ import annotations

import base64
import io
import threading
import zlib
from typing import TYPE_CHECKING, Any

from pyfret.workbench.answers import solve_in_full
from pyfret.workbench.judgements import has
from pyfret.workbench.names import OWN, materials_of, parts_of

if TYPE_CHECKING:
    from pathlib import Path

    from pyfret._core import Scene
    from pyfret.result import Result

__all__ = ["COMMANDS", "read_link", "write_file", "write_link", "write_script"]

#: The same contact on the command line.
COMMANDS = """\
fret check scene.toml
fret run scene.toml -o contact.zarr --error=coarser
fret report contact.zarr -o report.html
fret export contact.zarr -o numbers.csv
fret workbench scene.toml"""
#: Largest text of a scene in a link [bytes], packed and unpacked.
MOST_PACKED, MOST_TEXT = 1_500_000, 20_000_000
#: Matplotlib keeps its state for a whole process.
DRAWING = threading.Lock()


def quoted(text: str) -> str:
    """Return a text as a literal of Python, with its lines."""
    inner = text.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    return f'"""\n{inner}"""'


def write_script(scene: Scene, names: dict[str, str], criterion: str) -> str:
    """Write the script that computes what the page shows, by the same calls."""
    parts = [part for part in parts_of(scene) if part.startswith("body2")]
    layers = ", ".join("None" if names[p] == OWN else f'materials["{names[p]}"]' for p in parts)
    lines = [
        "import pyfret as fret",
        "",
        f"scene = fret.Scene.from_toml({quoted(scene.to_toml())})",
        'result = fret.solve(scene, save="all", error="coarser")',
        "print(result.summary())",
        "below = result.at(-1).stress()",
        *(
            f'print(below.maximum("von_mises", layer={layer}))'
            for layer in range(len(scene.body2.coatings) + 1)
        ),
    ]
    materials = materials_of(scene, names)
    yields = [m if has(m, "s_y") else None for m in materials]
    if any(materials):
        lines += ["", "materials = fret.fatigue.Materials()", f"layers = [{layers}]"]
    if any(yields):
        kept = ", ".join(f"layers[{n}]" if m else "None" for n, m in enumerate(yields))
        lines.append(f'print(result.load_factors([{kept}]).least("von_mises"))')
    judged = []
    for material in materials:
        try:
            judged.append(bool(material and material.assessment(criterion)))
        except (ValueError, KeyError):
            judged.append(False)
    if any(judged):
        kept = ", ".join(f"layers[{n}]" if ok else "None" for n, ok in enumerate(judged))
        lines.append(f'print(result.life([{kept}], "{criterion}"))')
    if has(materials[-1], "dK_th"):
        lines.append("print(result.crack().arrest(layers[-1]))")
    lines += ["", 'result.report("report.html")', 'result.plot().savefig("figures.svg")']
    lines.append('result.to_csv("numbers.csv")')
    return "\n".join(lines) + "\n"


def write_link(scene: Scene) -> str:
    """Return the whole scene as the end of an address, "" where it is too long for one."""
    packed = base64.urlsafe_b64encode(zlib.compress(scene.to_toml().encode(), 9)).decode()
    return "" if len(packed) > MOST_PACKED else f"#scene={packed.rstrip('=')}"


def read_link(text: str) -> str:
    """Return the text of the scene of a link.

    Raises
    ------
    ValueError
        It is damaged, or larger than a scene.
    """
    if len(text) > MOST_PACKED:
        raise ValueError("the link is too long for a scene")
    try:
        packed = base64.urlsafe_b64decode(text + "=" * (-len(text) % 4))
        unpacking = zlib.decompressobj()
        content = unpacking.decompress(packed, MOST_TEXT)
        if unpacking.unconsumed_tail or not unpacking.eof:
            raise ValueError("too long")
        return content.decode("utf-8")
    except (ValueError, zlib.error) as error:
        raise ValueError("the link is damaged: copy it whole") from error


def write_file(
    name: str, scene: Scene, names: dict[str, str], criterion: str, folder: Path
) -> bytes:
    """Return the content of a file of the fifth tab."""
    if name == "scene.toml":
        return scene.to_toml().encode()
    if name == "contact.py":
        return write_script(scene, names, criterion).encode()
    result = solve_in_full(scene)
    if name == "report.html":
        with DRAWING:
            result.report(folder / "report.html")
        return (folder / "report.html").read_bytes()
    if name == "numbers.csv":
        result.to_csv(folder / "numbers.csv")
        return (folder / "numbers.csv").read_bytes()
    if name in ("figures.svg", "figures.png"):
        return draw_overview(result, name.rpartition(".")[2])
    raise ValueError(f"{name}: is no file of this page")


def draw_overview(result: Result, form: str) -> bytes:
    """Return the overview of a run as a picture."""
    import matplotlib.pyplot as plt

    file = io.BytesIO()
    with DRAWING:
        figure: Any = result.plot()
        figure.savefig(file, format=form, dpi=200)
        plt.close(figure)
    return file.getvalue()
