"""Every public function with hostile values: an answer or a clear error, and soon."""

from __future__ import annotations

import os
import select
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.solves

CALLS = Path(__file__).with_name("hostile")
#: The most processor time that a call may take, and the longest on a machine that is busy [s].
MOST, LONGEST = 20.0, 600.0


def spent(pid: int) -> float:
    """Processor time of a process so far [s]."""
    stat = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(stat[11]) + int(stat[12])) / os.sysconf("SC_CLK_TCK")


def batch(start: int, *which: str, refused: bool = False) -> tuple[list[str], int | None]:
    """Return the wrong calls from `start` on, and the number of the last call.

    `which` are the other calls of ``tests/hostile``; with `refused` an answer is wrong.
    """
    command = [sys.executable, str(CALLS), str(start), *which]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        assert process.stdout is not None
        wrong, remainder, last, text = [], b"", None, "the imports"
        begun, then = spent(process.pid), time.monotonic()
        while True:
            ready, _, _ = select.select([process.stdout], [], [], 1.0)
            upper = MOST if last is not None else LONGEST
            if (
                not ready
                and spent(process.pid) - begun < upper
                and time.monotonic() - then < LONGEST
            ):
                continue
            data = os.read(process.stdout.fileno(), 1 << 16) if ready else b""
            if not data:
                process.kill()
                how = "ended the process" if ready else f"took longer than {upper:g} s"
                assert last is not None, how
                return [*wrong, f"{text} {how}"], last + 1
            begun, then = spent(process.pid), time.monotonic()
            *lines, remainder = (remainder + data).split(b"\n")
            for line in (line.decode() for line in lines):
                number, _, words = line.partition("\t")
                if number == "done":
                    return wrong, None
                if number:
                    last, text = int(number), words
                elif (
                    words.startswith("BAD")
                    or (text.endswith("as it should be") and words.startswith("refused"))
                    or (refused and words == "answered")
                ):
                    wrong.append(f"{text}: {words}")


def wrong_of(*which: str, refused: bool = False) -> list[str]:
    """Return the wrong calls of all, in processes that survive them."""
    wrong: list[str] = []
    start: int | None = 0
    while start is not None:
        extra, start = batch(start, *which, refused=refused)
        wrong += extra
    return wrong


@pytest.mark.timeout(600)
def test_hostile_values_are_answered_or_refused() -> None:
    """No call ends its process or takes long, under a limit of memory."""
    wrong = wrong_of()
    assert not wrong, "\n".join(wrong)


@pytest.mark.timeout(600)
def test_no_public_callable_takes_for_a_number_what_is_none() -> None:
    """True, NaN, complex numbers, masked values and texts, for every number of every callable."""
    wrong = wrong_of("never", refused=True)
    assert not wrong, "\n".join(wrong)


@pytest.mark.timeout(600)
def test_a_value_of_a_wrong_class_is_refused_with_the_name_of_its_argument() -> None:
    """Make 500 calls: TypeError, ValueError or an error of pyfret, the name in its text."""
    wrong = wrong_of("classes500")
    assert not wrong, "\n".join(wrong)


@pytest.mark.timeout(36_000)
def test_random_hostile_calls_of_all_public_callables() -> None:
    """Under 8 GB of address space; as many as ``FRET_HOSTILE`` (``make fuzz``: 20 000)."""
    wrong = wrong_of(os.environ.get("FRET_HOSTILE", "200"))
    assert not wrong, "\n".join(wrong)
