"""Install a wheel, or a source distribution, into a bare environment and use it as a newcomer does.

    python tools/wheel_test.py out/wheels                     # the newest wheel there
    python tools/wheel_test.py out/wheels --emulate Nehalem   # on a processor without AVX2

Needs the standard library alone. The command, the first example of the README and the examples of
the folder ``examples`` that need no other run are tried; what takes how long is printed. Then the
applications are installed from ``apps``: without them their names raise an error that names the
distribution.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path

ROOT = Path(__file__).parents[1]
#: Seconds that `import pyfret` may take beyond numpy, told but not judged: machines differ.
IMPORT = 0.25


class Bare:
    """An environment with nothing in it but the package and what it asks for."""

    def __init__(self, folder: Path, emulate: str | None) -> None:
        self.folder = folder
        venv.create(folder / "venv", with_pip=True)
        self.bin = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
        self.emulated = ["qemu-x86_64", "-cpu", emulate] if emulate else []

    def python(self, *arguments: str, emulated: bool = True) -> str:
        """What Python prints."""
        python = str((self.bin / "python").resolve() if self.emulated else self.bin / "python")
        # An emulated interpreter does not find its environment by itself.
        site = next((self.folder / "venv").glob("**/site-packages"))
        environment = os.environ | {"MPLBACKEND": "Agg"}
        if self.emulated and emulated:
            environment["PYTHONPATH"] = str(site)
        else:
            python = str(self.bin / "python")
        prefix = self.emulated if emulated else []
        return told([*prefix, python, *arguments], self.folder, environment)

    def fret(self, *arguments: str) -> str:
        """What the command prints."""
        if self.emulated:
            return self.python("-c", "from pyfret._cli import main; main()", *arguments)
        return told([str(self.bin / "fret"), *arguments], self.folder, dict(os.environ))


def told(command: list[str], folder: Path, environment: dict[str, str]) -> str:
    """What a command prints; its failure ends the test."""
    run = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {run.returncode}\n{run.stdout}{run.stderr}")
    return run.stdout


def smaller(code: str) -> str:
    """An example on a coarse grid."""
    return re.sub(r"\bn=(64|128|256)\b", "n=24", code)


def newest(folder: Path) -> Path:
    """The newest wheel of a folder, or else its newest source distribution."""
    for pattern in ("fretting-[0-9]*.whl", "fretting-[0-9]*.tar.gz"):
        found = sorted(folder.glob(pattern), key=lambda path: path.stat().st_mtime)
        if found:
            return found[-1].resolve()
    sys.exit(f"{folder}: no wheel and no source distribution")


def import_time(bare: Bare) -> float:
    """Seconds that `import pyfret` takes beyond numpy, the best of five."""
    code = (
        "import time; import numpy; t = time.perf_counter(); import pyfret; "
        "print(time.perf_counter() - t)"
    )
    return min(float(bare.python("-c", code)) for _ in range(5))


def check(bare: Bare) -> None:
    """The command, the import, the README and the examples."""
    print(bare.fret("--version").strip())
    bare.fret("new", "coated_ball", "-o", "scene.toml")
    print(bare.fret("check", "scene.toml").splitlines()[0])
    bare.fret("run", "scene.toml", "--set", "grid.n=24", "-o", "out.zarr")
    bare.fret("stress", "out.zarr", "--of", "von_mises")
    lazily = "import sys, pyfret; print([m for m in ('xarray', 'matplotlib') if m in sys.modules])"
    if bare.python("-c", lazily).strip() != "[]":
        sys.exit("import pyfret imports what it does not need")
    print(f"import pyfret: {import_time(bare):.2f} s beyond numpy ({IMPORT} s allowed for)")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", readme, flags=re.DOTALL)
    (bare.folder / "readme.py").write_text(smaller(block), encoding="utf-8")
    started = time.monotonic()
    bare.python("readme.py")
    print(f"example of the README, 24 x 24 cells: {time.monotonic() - started:.0f} s")
    example = (ROOT / "examples" / "dlc_on_titanium.py").read_text(encoding="utf-8")
    (bare.folder / "example.py").write_text(smaller(example), encoding="utf-8")
    bare.python("example.py")
    if not (bare.folder / "dlc_on_titanium.png").is_file():
        sys.exit("the example draws no figure")


def check_applications(bare: Bare) -> None:
    """Use an application before and after its distribution is installed."""
    code = (
        "import pyfret as fret\ntry: print(fret.experiments.fouvry2007('TiC') is not None)\n"
        "except ModuleNotFoundError as error: print(error)"
    )
    absent = bare.python("-c", code).strip()
    if absent != "pyfret.experiments is an application: pip install fretting-apps":
        sys.exit(f"without fretting-apps: {absent}")
    quiet = ("-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps")
    bare.python(*quiet, str(ROOT / "apps"), emulated=False)
    if (present := bare.python("-c", code).strip()) != "True":
        sys.exit(f"with fretting-apps: {present}")


def main() -> None:
    """Installs and tries."""
    parser = argparse.ArgumentParser(description="Try a wheel in a bare environment.")
    parser.add_argument("folder", type=Path, help="where the wheel is")
    parser.add_argument("--emulate", metavar="CPU", help="run on this processor with qemu-x86_64")
    options = parser.parse_args()
    package = newest(options.folder)
    folder = Path(tempfile.mkdtemp(prefix="wheel-"))
    try:
        bare = Bare(folder, options.emulate)
        started = time.monotonic()
        bare.python(
            *("-m", "pip", "install", "--quiet", "--disable-pip-version-check"),
            f"{package}[plot]",
            emulated=False,
        )
        print(f"{package.name}: installed in {time.monotonic() - started:.0f} s")
        check(bare)
        check_applications(bare)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    print("all of it works")


if __name__ == "__main__":
    main()
