"""The stub of the compiled module, from the module itself.

    python tools/stub.py          # write python/pyfret/_core.pyi
    python tools/stub.py --check  # fail if it would change

PyO3 knows the types of most arguments; those of the others stand in the signatures of the Rust
functions. What this adds: the imports that these names need, the exceptions, and the
static methods that are not written one by one: those of the criteria, and what Python gives.
"""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from pyfret import _core, contacts, quantities
from pyfret.grids import for_contact

ROOT = Path(__file__).parents[1]
STUB = ROOT / "python" / "pyfret" / "_core.pyi"
BIN = Path(sys.executable).parent
NAMES = ", ".join(name for name in quantities.__all__ if name[0].isupper())
IMPORTS = f"""\
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal
from typing_extensions import Self
from pyfret._util.types import FrictionFunction, Variable
from pyfret.quantities import {NAMES}
import os
from pyfret.scene.maps import Form, Statistics
from matplotlib.axes import Axes
import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray
"""


def generated() -> str:
    """The stub that the introspection of PyO3 makes."""
    with tempfile.TemporaryDirectory() as folder:
        maturin = [str(BIN / "maturin"), "generate-stubs", "--quiet", "--locked"]
        command = [*maturin, "--profile", "release", "--out", folder]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(done.stderr)
        return (Path(folder) / "pyfret" / "_core.pyi").read_text(encoding="utf-8")


def quoted(doc: str | None, indent: str) -> str:
    """A docstring of the stub."""
    return indent + f"\n{indent}".join(f'"""{doc}"""'.splitlines()) + "\n"


def criteria() -> str:
    """The methods of the class that make one criterion each."""
    return "".join(
        f"    @staticmethod\n    def {name}(**numbers: float | Material | str) -> Criterion:\n"
        + quoted(getattr(_core.Criterion, name).__doc__, " " * 8)
        for name, _ in _core.criteria()
    )


def grids() -> str:
    """The method of the grid that Python gives."""
    doc = inspect.cleandoc(for_contact.__doc__ or "")
    head = f"    @staticmethod\n    def for_contact{inspect.signature(for_contact)}:\n"
    return head + quoted(doc, " " * 8)


def scenes() -> str:
    """The methods of the scene that Python gives."""
    methods = ""
    for name in contacts.__all__:
        make = getattr(contacts, name)
        if name != "offer":
            doc = inspect.cleandoc(make.__doc__ or "")
            head = str(inspect.signature(make)).replace("Part", "Body | Elastic | str")
            methods += f"    @staticmethod\n    def {name}{head}:\n" + quoted(doc, " " * 8)
    return methods


def within(text: str, name: str, members: str) -> str:
    """The text with more members of a class."""
    begin = text.index(f"\nclass {name}:\n")
    end = text.index("\n\n@final\nclass ", begin)
    return f"{text[:end]}\n{members}{text[end:]}"


def exceptions() -> str:
    """The exceptions, those that others are made of first."""
    found = [getattr(_core, name) for name in _core.__all__ if name.endswith("Error")]
    return "".join(
        f"class {each.__name__}({each.__base__.__name__}):\n{quoted(each.__doc__, ' ' * 4)}"
        for each in sorted(found, key=lambda each: (len(each.__mro__), each.__name__))
    )


def exports() -> str:
    """What the module exports."""
    return f"__all__ = {sorted(_core.__all__)}\n"


def formatted(text: str) -> str:
    """The text as the formatter and the order of imports have it."""
    ruff = [str(BIN / "ruff")]
    named = ["--stdin-filename", str(STUB), "-"]
    fixed = [*ruff, "check", "--quiet", "--exit-zero", "--fix", "--unsafe-fixes", *named]
    for command in (fixed, [*ruff, "format", "--quiet", *named]):
        done = subprocess.run(command, input=text, capture_output=True, text=True, check=True)
        text = done.stdout
    return text


def stub() -> str:
    """The whole stub."""
    text = generated()
    # PyO3 knows no types of the entries of a dict.
    text = re.sub(r"\bdict\b(?!\[)(?=[\]\s,:|)])", "dict[str, Any]", text)
    text = re.sub(r"\btuple\b(?!\[)(?=[\]\s,:|)])", "tuple[Any, ...]", text)
    # CPython gives a class with __add__ the other one.
    text = re.sub(r"( *def )__add__(.*\n)", r"\1__add__\2\1__radd__\2", text)
    # What a class does not have is refused there.
    text = re.sub(r" *def __getattr__\(.*\n", "", text)
    for owner, members in (("Criterion", criteria()), ("Grid", grids()), ("Scene", scenes())):
        text = within(text, owner, members)
    return formatted(IMPORTS + text + exceptions() + exports())


def main() -> int:
    """Write the stub, or say whether it is as it should be."""
    new = stub()
    if "--check" in sys.argv[1:]:
        stale = new != STUB.read_text(encoding="utf-8")
        if stale:
            print(f"{STUB}: run tools/stub.py")
        return int(stale)
    STUB.write_text(new, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
