"""Every public function with hostile values: an answer or a clear error, and soon."""

from __future__ import annotations

import os
import select
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.solves

CALLS = Path(__file__).with_name("hostile")
#: The longest that a call may take, a busy machine allowed for [s].
LONGEST = 60.0


def batch(start: int) -> tuple[list[str], int | None]:
    """What the calls from `start` on did wrong, and the number of the one that was the last."""
    command = [sys.executable, str(CALLS), str(start)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        assert process.stdout is not None
        wrong, rest, last, text = [], b"", None, "the imports"
        while True:
            ready, _, _ = select.select([process.stdout], [], [], LONGEST)
            data = os.read(process.stdout.fileno(), 1 << 16) if ready else b""
            if not data:
                process.kill()
                how = "ended the process" if ready else f"took longer than {LONGEST} s"
                assert last is not None, how
                return [*wrong, f"{text} {how}"], last + 1
            *lines, rest = (rest + data).split(b"\n")
            for line in (line.decode() for line in lines):
                number, _, words = line.partition("\t")
                if number == "done":
                    return wrong, None
                if number:
                    last, text = int(number), words
                elif words.startswith("BAD") or (
                    text.endswith("as it should be") and words.startswith("refused")
                ):
                    wrong.append(f"{text}: {words}")


@pytest.mark.timeout(600)
def test_hostile_values_are_answered_or_refused() -> None:
    """In a process of its own, under a limit of memory; none may end it or keep it for long."""
    wrong: list[str] = []
    start: int | None = 0
    while start is not None:
        more, start = batch(start)
        wrong += more
    assert not wrong, "\n".join(wrong)
