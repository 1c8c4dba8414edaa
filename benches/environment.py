"""A virtual environment of the peers' own, and programs run in processes of their own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, NamedTuple

BENCHES = Path(__file__).parent
ROOT = BENCHES.parent
PINS = BENCHES / "peers.txt"


class Peers(NamedTuple):
    """The interpreter of the peers, and why those that are missing are."""

    python: Path
    missing: dict[str, str]


class Refused(Exception):
    """A program ended without a result; the message is the last that it said."""


def peers(folder: Path) -> Peers:
    """Make the environment in `folder`, or take it if it holds what is pinned."""
    python = folder / "bin" / "python"
    record = folder / "peers.json"
    pins = [line.split() for line in PINS.read_text().splitlines() if not line.startswith("#")]
    if record.exists():
        known = json.loads(record.read_text())
        if known["pins"] == pins:
            return Peers(python, known["missing"])
    if not python.exists():
        subprocess.run([ROOT / "tools" / "venv.sh", folder], check=True)
    missing = {}
    for name, *more in pins:
        print(f"installing {name}", flush=True)
        options = ["--quiet", "--disable-pip-version-check", "--prefer-binary"]
        command: list[str | Path] = [python, "-m", "pip", "install", *options, name, *more]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            said = [line for line in done.stderr.splitlines() if line.strip()]
            missing[name.split("==")[0]] = said[-1] if said else f"pip ended with {done.returncode}"
    record.write_text(json.dumps({"pins": pins, "missing": missing}))
    return Peers(python, missing)


def run(command: list[str | Path], *, threads: int = 2, limit: float = 900) -> str:
    """What a program says; it may use so many threads and take so many seconds."""
    count = str(threads)
    names = ["RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"]
    environment = os.environ | dict.fromkeys(names, count)
    try:
        done = subprocess.run(
            command,
            cwd=ROOT,
            env=environment,
            capture_output=True,
            text=True,
            timeout=limit,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise Refused(f"took more than {limit:.0f} s") from None
    if done.returncode != 0:
        said = [line for line in done.stderr.splitlines() if line.strip()]
        raise Refused(said[-1] if said else f"ended with {done.returncode}")
    return done.stdout


def run_python(
    python: Path, name: str, arguments: list[str], **limits: Any
) -> list[dict[str, Any]]:
    """The lines of JSON that a program of this folder prints."""
    said = run([python, BENCHES / name, *arguments], **limits)
    return [json.loads(line) for line in said.splitlines() if line.startswith("{")]


def run_example(name: str, arguments: list[str], **limits: Any) -> str:
    """What an example of contact-core prints."""
    build = ["cargo", "build", "--release", "--locked", "--quiet", "--package", "contact-core"]
    run([*build, "--example", name])
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return run([target / "release" / "examples" / name, *arguments], **limits)


def product() -> Path:
    """The interpreter that has pyfret: the one that runs this."""
    return Path(sys.executable)


def now() -> str:
    """The time for a program to count its start-up from."""
    return repr(time.time())
