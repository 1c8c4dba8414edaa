"""Calls public functions and constructors with hostile values; run by ``test_hostile.py``.

``python tests/hostile START`` makes the calls of the written list from number START on, one line
before and one after each, under a limit of memory. Whoever reads along knows which call ended the
process. ``python tests/hostile START COUNT`` makes random calls of all public callables, and
``python tests/hostile START never`` gives each of them values that are no numbers.
``python tests/hostile START classes500`` makes 500 calls with an argument of a wrong class.
"""

from __future__ import annotations

import random
import re
import resource
import sys
import warnings
from collections.abc import Callable, Iterator
from itertools import chain
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
#: Address space of the random calls [bytes].
MEMORY_OF_RANDOM = 8 << 30
CALLS = [*scenes.CALLS, *closed_forms.CALLS, *fields.CALLS, *follows.CALLS]


def cases() -> Iterator[tuple[str, Callable[..., Any], dict[str, Any]]]:
    """Every call, with one argument hostile at a time."""
    for name, call, good in CALLS:
        yield f"{name}, as it should be", call, good
        for key, value in good.items():
            for alternative in hostile(value):
                text = " ".join(f"{alternative!r}".split())[:100]
                yield f"{name}({key} = {text})", call, good | {key: alternative}


def flat(values: Any) -> Iterator[Any]:
    """The numbers and arrays in nested lists and tuples."""
    for value in values:
        if isinstance(value, (list, tuple)):
            yield from flat(value)
        elif isinstance(value, (float, np.ndarray)):
            yield value


def outcome(call: Callable[..., Any], arguments: dict[str, Any]) -> str:
    """Classify the behaviour of a call in a word."""
    by_position = [arguments[key] for key in sorted(k for k in arguments if k.isdigit())]
    by_name = {key: value for key, value in arguments.items() if not key.isdigit()}
    try:
        computed = call(*by_position, **by_name)
    except (*ALLOWED, *OWN) as error:
        text = str(error)
        # The error of a scene has a line with a place for each mistake.
        listed = isinstance(error, fret.errors.InvalidSceneError)
        whole = "\n" not in text or (listed and all(": " in line for line in text.splitlines()))
        # PyO3's message for a value of another type has several lines.
        if not text.strip() or not (whole or isinstance(error, TypeError)):
            return f"BAD: {type(error).__name__} has the text {text[:200]!r}"
        return f"refused: {type(error).__name__}: {text[:150]}"
    except AttributeError as error:
        # A function for any object of a kind names the wrong object in its message.
        kinds = (type(value).__name__ for value in arguments.values())
        if any(f"{kind}' object has no attribute" in str(error) for kind in kinds):
            return f"refused: AttributeError: {error}"
        return f"BAD: AttributeError: {error}"
    except RuntimeError as error:
        # A map over loads names the loads without an answer, and the reasons.
        if re.match(r"[TW] = ", str(error)):
            return f"refused: RuntimeError: {error}"
        return f"BAD: RuntimeError: {error}"
    except BaseException as error:
        return f"BAD: {type(error).__name__}: {str(error)[:200]!r}"
    given_values = list(flat([*by_position, *by_name.values()]))
    if all(np.all(np.isfinite(v)) for v in given_values if np.asarray(v).dtype.kind == "f"):
        # A record has NaN for a number that was not asked for.
        for values in computed if type(computed) in (list, tuple) else [computed]:
            numbers = isinstance(values, (float, np.ndarray)) and np.asarray(values).dtype.kind
            if numbers in ("f", "c") and np.any(np.isnan(values)):
                return "BAD: finite numbers in, nan out"
    return "answered"


def random_cases(count: int) -> Iterator[tuple[str, Callable[..., Any], dict[str, Any]]]:
    """Calls of public callables found by introspection, with one to three hostile arguments.

    The call of a number is the same however many were made before it.
    """
    import public

    known_items = [(name, call, public.good(name, call)) for name, call in public.public()]
    known_items = [
        item for item in known_items if item[0] not in public.LEFT_OUT and item[2] is not None
    ]
    for number in range(count):
        rng = random.Random(number)
        name, call, (needed, free) = rng.choice(known_items)  # type: ignore[misc]
        changed = rng.sample(free, min(len(free), rng.choice((1, 1, 1, 2, 3))))
        alternative = {
            key: rng.choice(public.unlike(needed.get(key, public.GOOD.get(key)))) for key in changed
        }
        options = ", ".join(f"{key} = {entry!r}"[:100] for key, entry in alternative.items())
        text = " ".join(f"{name}({options})".split())
        yield text, lambda call=call, **k: public.invoked(call, k), needed | alternative


def no_numbers() -> Iterator[tuple[str, Callable[..., Any], dict[str, Any]]]:
    """Every public callable with values that are no numbers where it takes numbers."""
    import public

    for name, call in public.public():
        computed = public.good(name, call)
        if name in public.LEFT_OUT or computed is None:
            continue
        for key in computed[1]:
            if public.free_of(name, key):
                continue
            for alternative in public.never(computed[0].get(key, public.GOOD.get(key))):
                text = " ".join(f"{name}({key} = {alternative!r})".split())[:200]
                yield (
                    text,
                    lambda call=call, **k: public.invoked(call, k),
                    computed[0] | {key: alternative},
                )


def wrong_classes(count: int) -> Iterator[tuple[str, Callable[..., Any], dict[str, Any]]]:
    """Calls of public callables with one argument of a class that none of them takes."""
    import public

    known_items = [(name, call, public.good(name, call)) for name, call in public.public()]
    known_items = [
        item for item in known_items if item[0] not in public.LEFT_OUT and item[2] is not None
    ]
    for number in range(count):
        rng = random.Random(number)
        name, call, (needed, free) = rng.choice(known_items)  # type: ignore[misc]
        free = [key for key in free if f"{name}({key})" not in public.FUNCTIONS]
        if not free:
            continue
        key = rng.choice(free)
        value = rng.choice(public.OF_NO_CLASS)()
        text = f"{name}({key} = {type(value).__name__})"

        def made(call: Callable[..., Any] = call, **k: Any) -> Any:
            return public.invoked(call, k)

        made.__doc__ = call.__doc__
        yield text, made, needed | {key: value}


def refusal_of_class(call: Callable[..., Any], arguments: dict[str, Any], text: str) -> str:
    """Check that a wrong class ends in a refusal whose text has the name of the argument."""
    key = text.partition("(")[2].partition(" = ")[0]
    try:
        call(**arguments)
    except BaseException as error:
        of_pyfret = type(error).__module__.partition(".")[0] == "pyfret"
        name = type(error).__name__
        if isinstance(error, KeyError) and "KeyError" in str(getattr(call, "__doc__", "")):
            return "refused: KeyError, as its page has it"
        if not of_pyfret and type(error) not in (TypeError, ValueError, MemoryError):
            return f"BAD: {name}: {str(error)[:150]!r}"
        if not re.search(rf"\b{re.escape(key)}\b", str(error)):
            return f"BAD: {key} is not named: {name}: {str(error)[:150]!r}"
        return f"refused: {name}"
    return "answered"


def main(start: int, more: str = "") -> None:
    """Makes the calls, with a line before and after each."""
    warnings.simplefilter("ignore")
    classes = more.startswith("classes")
    if classes:
        computed = wrong_classes(int(more.removeprefix("classes")))
    else:
        computed = no_numbers() if more == "never" else random_cases(int(more)) if more else cases()
    import public

    first = next(computed)
    size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    limit = size + MEMORY if not more else MEMORY_OF_RANDOM
    resource.setrlimit(resource.RLIMIT_AS, (limit, resource.RLIM_INFINITY))
    for number, (text, call, arguments) in enumerate(chain([first], computed)):
        if number < start:
            continue
        print(f"{number}\t{text}", flush=True)
        word = refusal_of_class(call, arguments, text) if classes else outcome(call, arguments)
        print(f"\t{' '.join(word.split())}", flush=True)
        if more:
            public.close()
    print("done", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), *sys.argv[2:])
