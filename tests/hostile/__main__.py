"""Calls every public function and constructor with hostile values; run by ``test_hostile.py``.

``python tests/hostile START`` makes the calls from number START on, one line before and one
after each, under a limit of memory. Whoever reads along knows which call ended the process.
"""

from __future__ import annotations

import resource
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import closed_forms
import fields
import follows
import numpy as np
import scenes
from values import ALLOWED, OWN, hostile

import pyfret as fret

#: Address space beyond what is taken after the imports [bytes].
MEMORY = 3 << 30
CALLS = [*scenes.CALLS, *closed_forms.CALLS, *fields.CALLS, *follows.CALLS]


def cases() -> Iterator[tuple[str, Callable[..., Any], dict[str, Any]]]:
    """Every call, with one argument hostile at a time."""
    for name, call, good in CALLS:
        yield f"{name}, as it should be", call, good
        for key, value in good.items():
            for other in hostile(value):
                text = " ".join(f"{other!r}".split())[:100]
                yield f"{name}({key} = {text})", call, good | {key: other}


def flat(values: Any) -> Iterator[Any]:
    """The numbers and arrays in nested lists and tuples."""
    for value in values:
        if isinstance(value, (list, tuple)):
            yield from flat(value)
        elif isinstance(value, (float, np.ndarray)):
            yield value


def outcome(call: Callable[..., Any], arguments: dict[str, Any]) -> str:
    """What a call does, in a word."""
    by_position = [arguments[key] for key in sorted(k for k in arguments if k.isdigit())]
    by_name = {key: value for key, value in arguments.items() if not key.isdigit()}
    try:
        found = call(*by_position, **by_name)
    except (*ALLOWED, *OWN) as error:
        text = str(error)
        # A scene tells every mistake, each with its place on a line of its own.
        listed = isinstance(error, fret.errors.InvalidSceneError)
        whole = "\n" not in text or (listed and all(": " in line for line in text.splitlines()))
        # What PyO3 says of a value of another type has several lines.
        if not text.strip() or not (whole or isinstance(error, TypeError)):
            return f"BAD: {type(error).__name__} says {text[:200]!r}"
        return f"refused: {type(error).__name__}: {text[:150]}"
    except BaseException as error:
        return f"BAD: {type(error).__name__}: {str(error)[:200]!r}"
    given = list(flat([*by_position, *by_name.values()]))
    if all(np.all(np.isfinite(v)) for v in given if np.asarray(v).dtype.kind == "f"):
        for values in found if isinstance(found, (list, tuple)) else [found]:
            numbers = isinstance(values, (float, np.ndarray)) and np.asarray(values).dtype.kind
            if numbers in ("f", "c") and np.any(np.isnan(values)):
                return "BAD: finite numbers in, nan out"
    return "answered"


def main(start: int) -> None:
    """Makes the calls, with a line before and after each."""
    size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (size + MEMORY, resource.RLIM_INFINITY))
    for number, (text, call, arguments) in enumerate(cases()):
        if number < start:
            continue
        print(f"{number}\t{text}", flush=True)
        print(f"\t{' '.join(outcome(call, arguments).split())}", flush=True)
    print("done", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]))
