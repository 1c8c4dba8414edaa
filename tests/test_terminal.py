"""Output of all commands in windows of any width: no line is wider, colours are for terminals."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from pathlib import Path

import pytest

import pyfret as fret
from conftest import ROOT, T_MAX, sphere_on_flat
from conftest import W as LOAD
from pyfret import verification
from pyfret._cli import commands
from pyfret._util import window
from pyfret._util.window import format_table, wrap

pytestmark = pytest.mark.solves

FRET = ROOT / "target" / "release" / "fret"
WIDTHS = (60, 80, 120)
#: Codes of colours, and all others.
CODE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with short names: a scene, its result, its wear."""
    folder = tmp_path_factory.mktemp("terminal")
    path = fret.LoadPath.start().normal(LOAD, increments=2)
    path = path.tangential([T_MAX, -T_MAX, T_MAX], increments=5)
    scene = sphere_on_flat(ratio=2.0, n=16).replace(path=path)
    (folder / "s.toml").write_text(scene.to_toml(), encoding="utf-8")
    worn = scene.to_toml() + "\n[wear]\ncycles = 2000\nbody2 = { k = 1e-14 }\n"
    (folder / "w.toml").write_text(worn, encoding="utf-8")
    fret.solve(scene, save="all", out=folder / "r.zarr", progress=False)
    return folder


#: Commands with tables, sentences and messages; those that end with 2 refuse their input.
CALLS = {
    "check": ("check", "s.toml"),
    "run": ("run", "s.toml", "-o", "x.zarr", "--overwrite", "--wide"),
    "run with errors": ("run", "s.toml", "-o", "x.zarr", "--overwrite", "--error"),
    "stress": ("stress", "r.zarr", "--of", "von_mises,s_xx"),
    "life": ("life", "r.zarr", "--material", "none,steel_42CrMo4", "--criterion", "findley"),
    "wear": ("wear", "w.toml", "-o", "y.zarr", "--overwrite"),
    "crack": ("crack", "r.zarr", "--material", "steel_42CrMo4", "--lengths", "20 um,50 um"),
    "info": ("info", "r.zarr"),
    "cite": ("cite", "r.zarr"),
    "no file": ("check", "a file with a long name that is nowhere to be found in this folder.toml"),
    "no option": ("life", "r.zarr", "--criterion", "a_criterion_that_nobody_has_heard_of"),
    "no option of python": ("crack", "r.zarr", "--with-an-option-that-nobody-has-heard-of-before"),
}
#: Commands that start an interpreter, in the narrowest window alone.
PYTHON = {"crack", "info", "cite", "no option of python"}


def widths(name: str) -> tuple[int, ...]:
    """Return the widths of windows for a command."""
    return WIDTHS[:1] if name in PYTHON else WIDTHS


def piped(call: tuple[str, ...], folder: Path, **variables: str) -> tuple[str, str]:
    """Return what a command writes into pipes."""
    environment = {k: v for k, v in os.environ.items() if k not in ("COLUMNS", "NO_COLOR")}
    done = subprocess.run(
        [FRET, *call],
        cwd=folder,
        env={**environment, "TERM": "xterm-256color", "FRET_PYTHON": sys.executable, **variables},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout, done.stderr


def on_terminal(call: tuple[str, ...], folder: Path, width: int, **variables: str) -> str:
    """Return what a command writes to a terminal of so many columns."""
    environment = {k: v for k, v in os.environ.items() if k not in ("COLUMNS", "NO_COLOR")}
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 40, width, 0, 0))
    process = subprocess.Popen(
        [FRET, *call],
        cwd=folder,
        env={**environment, "TERM": "xterm-256color", "FRET_PYTHON": sys.executable, **variables},
        stdin=subprocess.DEVNULL,
        stdout=theirs,
        stderr=theirs,
    )
    os.close(theirs)
    parts = []
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        parts.append(part)
    process.wait()
    os.close(ours)
    return b"".join(parts).decode()


def too_wide(text: str, width: int) -> list[str]:
    """Lines of a text that are wider than a window, codes of the terminal left out."""
    lines = re.split(r"[\r\n]+", CODE.sub("", text))
    return [line for line in lines if len(line.rstrip()) > width]


@pytest.mark.parametrize("name", CALLS)
def test_no_line_in_a_pipe_is_wider_and_none_has_a_code(name: str, folder: Path) -> None:
    for width in widths(name):
        out, messages = piped(CALLS[name], folder, COLUMNS=str(width))
        assert out or messages
        assert not too_wide(out, width)
        assert not too_wide(messages, width)
        assert "\x1b" not in out + messages
    if name not in PYTHON:
        out, messages = piped(CALLS[name], folder)
        assert not too_wide(out, 80)
        assert "\x1b" not in out + messages


@pytest.mark.parametrize("name", CALLS)
def test_no_line_on_a_terminal_is_wider(name: str, folder: Path) -> None:
    for width in widths(name):
        text = on_terminal(CALLS[name], folder, width)
        assert text
        assert not too_wide(text, width)


def test_colours_are_for_terminals_and_can_be_declined(folder: Path) -> None:
    for name in ("run", "no file", "no option"):
        assert CODE.search(on_terminal(CALLS[name], folder, 80)), name
    for variables in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
        for name in ("check", "no file", "no option", "no option of python"):
            assert "\x1b" not in on_terminal(CALLS[name], folder, 80, **variables), name


def test_a_message_in_a_file_is_one_line(folder: Path) -> None:
    _, messages = piped(CALLS["no file"], folder)
    assert len(messages.splitlines()) == 1


def test_a_table_is_aligned_on_a_terminal_and_has_commas_in_a_pipe(folder: Path) -> None:
    call = ("table", "r.zarr")
    head = piped(call, folder)[0].splitlines()[0]
    assert head.count(",") > 10
    text = on_terminal(call, folder, 60)
    assert not too_wide(text, 60)
    for title in head.split(","):
        assert title.partition(" [")[0].strip('"') in text, title


@pytest.mark.parametrize("width", WIDTHS)
def test_help_of_every_command_fits(width: int, folder: Path) -> None:
    out, _ = piped(("--help",), folder, COLUMNS=str(width))
    names = re.findall(r"^  (\w+) ", out, re.MULTILINE)
    assert len(names) > 20
    for name in names:
        if name not in {"help", *commands_of_python()}:
            out += piped((name, "--help"), folder, COLUMNS=str(width))[0]
    assert not too_wide(out, width)


def commands_of_python() -> set[str]:
    """Names of the commands that the package runs."""
    from pyfret._cli import NEEDS_PYTHON

    return set(NEEDS_PYTHON)


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("name", sorted(commands_of_python()))
def test_help_of_every_command_in_python_fits(
    width: int,
    name: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    assert commands.main([name, "--help"]) == 0
    assert not too_wide(capsys.readouterr().out, width)


@pytest.mark.parametrize("width", WIDTHS)
def test_summaries_fit(
    width: int, coated: fret.Result, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    check = verification.Check("normal approach", "Johnson (1985), eq. 4.22", 1.0, 1.0, 1.0, 1e-5)
    texts = [
        wrap(coated.summary()),
        wrap(str(verification.Verification([check] * 3, 12.0))),
        wrap(fret.open(folder / "r.zarr").crack(lengths=[2e-5, 5e-5]).summary()),
    ]
    for text in texts:
        assert not too_wide(text, width)
        assert re.search(r"^-+$", text, re.MULTILINE)


def test_a_table_keeps_its_columns_and_repeats_the_first(monkeypatch: pytest.MonkeyPatch) -> None:
    titles = [f"quantity{n}\n[MPa]" for n in range(12)]
    rows = [[f"{k}.{n:02d}e-12" for n in range(12)] for k in range(3)]
    for width in (40, 60, 80, 120):
        monkeypatch.setenv("COLUMNS", str(width))
        text = format_table(titles, rows)
        assert not too_wide(text, width)
        blocks = text.split("\n\n")
        assert all(block.lstrip().startswith("quantity0") for block in blocks)
        for row in rows:
            for cell in row[1:]:
                assert text.count(cell) == 1
    # A column that is wider than the window is folded.
    monkeypatch.setenv("COLUMNS", "40")
    assert not too_wide(format_table(["a", "b"], [["1", "many words " * 12]]), 40)


def test_units_stay_with_their_numbers() -> None:
    text = "a stiffness of (1.070 +- 0.011)e8 N/m at x = -3.5e-12 um, " * 4
    for width in range(40, 100, 7):
        wrapped = wrap(text.strip(), width)
        assert not too_wide(wrapped, width)
        for whole in ("(1.070 +- 0.011)e8 N/m", "x = -3.5e-12 um"):
            assert sum(line.count(whole) for line in wrapped.splitlines()) == 4


@pytest.mark.parametrize("text", ["", "0", "-5", "wide", "1e3", "\u0665"])
def test_a_width_that_is_none_is_passed_over(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", text)
    assert window.window_width() == 80
