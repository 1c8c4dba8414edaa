"""Write the page "Which files can I open" from the table of the corpus.

``python tools/files_page.py`` writes `docs/files.md` from `tests/data/corpus/table.json`;
``--check`` ends with 1 if the page is another one.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
TABLE = ROOT / "tests" / "data" / "corpus" / "table.json"
PAGE = ROOT / "docs" / "files.md"
#: Sections of the page: reader, title, function, what is needed.
SECTIONS = (
    ("read_surface", "Maps of heights", "fret.read_surface(path)", "surfaces"),
    ("fit.read_loops", "Recordings of rigs", "fret.fit.read_loops(path)", "rigs,mdf"),
    ("export.bulk_stress", "Results of finite elements", "fret.export.bulk_stress(path)", "mesh"),
    ("mesh", "Meshes", 'result.export("loads.inp", mesh=path)', "mesh"),
)
HEAD = """# Which files can I open

`fret info FILE` prints what a file is: its format, what is read of it, units, axes, size, doubts.

```sh
fret info map.x3p
fret info rig.tdms
```

The tables below list files that the programs wrote. The tests of pyfret compare each of them with
its right numbers: points, units, directions, holes and values. Other files are refused by their
names, with the reason. The content of a file decides, not its ending.

The page is written by `python tools/files_page.py` from the table of the tests.
"""
TAIL = """
## Other formats

SurfaceTopography reads about forty formats of instruments, and meshio some more meshes.
`fret.read_surface` and `fret.export` take them as well, without a file in the tests.

X3P and SDF are read by [x3pio](https://pypi.org/project/x3pio/) and
[sdfio](https://pypi.org/project/sdfio/) 2.0. Both have the MIT licence and read all revisions of
ISO 25178-72 and 25178-71. They verify checksums, and need Python 3.11. SurfaceTopography reads the
first revisions only, and surfalize is under the GPL.
"""


def options_of(row: dict[str, Any]) -> str:
    """Return the arguments that a file needs."""
    texts = []
    for name, value in row["options"].items():
        shown = f"({value[0]:g}, {value[1]:g})" if isinstance(value, list) else json.dumps(value)
        texts.append(f"`{name}={shown}`")
    return ", ".join(texts)


def result_of(row: dict[str, Any]) -> str:
    """Return what comes out, in words."""
    if "refused" in row:
        return f"refused: {row['refused']}"
    return f"read, with a note: {row['note']}" if row.get("note") else "read"


def page() -> str:
    """Return the text of the page."""
    rows = json.loads(TABLE.read_text(encoding="utf-8"))
    text = HEAD
    for reader, title, call, extra in SECTIONS:
        text += f'\n## {title}\n\n`{call}`, with `pip install "fretting[{extra}]"`.\n\n'
        text += "| format | written by | arguments | what happens |\n|---|---|---|---|\n"
        for row in rows:
            if row["reader"] == reader:
                cells = (row["format"], row["program"], options_of(row), result_of(row))
                text += f"| {' | '.join(cells)} |\n"
    return text + TAIL


if __name__ == "__main__":
    if "--check" in sys.argv:
        sys.exit(PAGE.read_text(encoding="utf-8") != page())
    PAGE.write_text(page(), encoding="utf-8")
