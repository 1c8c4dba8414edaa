"""Every function checks its arguments by their types, and refuses unknown keywords."""

from __future__ import annotations

import importlib
import inspect
import re
from collections.abc import Callable
from pathlib import Path
from types import FunctionType
from typing import Any

import pytest

import pyfret as fret
from pyfret import _core, quantities
from pyfret._util import refusals
from pyfret._util.compiled import NAMED

ROOT = Path(__file__).parents[1]


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_every_public_callable_is_called_with_hostile_values(
    monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    """Found by introspection: none is forgotten by ``tests/hostile``."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    computed = dict(public.public())
    called = {name for name, call in computed.items() if public.good(name, call) is not None}
    record_property("callables", len(computed))
    assert len(computed) > 330
    # Constructors of the criteria take their numbers by name, whatever they are.
    forgotten = set(computed) - called - set(public.LEFT_OUT)
    assert {name for name in forgotten if not name.startswith("fatigue.Criterion.")} == set()


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_an_object_of_pyfret_is_no_plain_value(
    monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    """Every parameter that takes one refuses a list by its name, before anything else is done."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    count = 0
    for name, call in public.public():
        computed = None if name in public.LEFT_OUT else public.good(name, call)
        if computed is None or not isinstance(call, FunctionType):
            continue
        rules = quantities.Signature(inspect.unwrap(call)).rules.values()
        for rule in (rule for rule in rules if rule.objects):
            count += 1
            text = rf"{rule.name} = \[1\.0\]: must be|argument '{rule.name}'|'{rule.name}'"
            with pytest.raises(TypeError, match=text):
                public.invoked(call, computed[0] | {rule.name: [1.0]})
    record_property("parameters", count)
    assert count > 100


def is_checked(call: Any) -> bool:
    """Whether the arguments of a function are checked by the decorator, or by the compiled one."""
    while call is not None:
        item = getattr(call, "__code__", None)
        if item is not None and item.co_filename == refusals.__file__:
            return True
        call = getattr(call, "__wrapped__", None)
    return False


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_every_public_function_checks_its_arguments(
    monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    count, open_ones = 0, []
    for name, call in public.public():
        own_values = isinstance(call, FunctionType) and "." not in call.__qualname__
        if not own_values or not inspect.signature(call).parameters:
            continue
        count += 1
        if not is_checked(call):
            open_ones.append(name)
    record_property("functions", count)
    assert count > 100
    assert open_ones == []


def constructor_of(cls: Any) -> Any:
    """Return the constructor of a class: ``__init__``, of a compiled one ``__new__``."""
    if isinstance(cls.__init__, FunctionType):
        return cls.__init__
    return None if cls.__text_signature__ is None else cls.__new__


def test_every_compiled_callable_refuses_keywords(
    record_property: Callable[[str, object], None],
) -> None:
    """Methods, functions and constructors, private ones of the package included."""
    count, open_ones = 0, []
    for name, entry in vars(fret._core).items():
        if isinstance(entry, type) and not issubclass(entry, BaseException):
            members = {
                f"{name}.{item}": getattr(entry, item) for item in vars(entry) if item[0] != "_"
            }
            if entry.__text_signature__ is not None:
                members[f"{name}.__new__"] = entry.__new__
        else:
            members = {name: entry}
        for pattern, call in members.items():
            criterion = pattern.partition(".")[0] == "Criterion" and pattern != "Criterion.of"
            if not callable(call) or isinstance(call, type) or criterion:
                continue
            count += 1
            if not is_checked(call):
                open_ones.append(pattern)
    record_property("callables", count)
    assert count > 200
    assert open_ones == []


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        (lambda: fret.Elastic(210e9, 0.3), r"Elastic takes arguments by name, Elastic\(E=..., nu="),
        (lambda: fret.History("cycles"), "History is not made: it is one of History.INCREMENT"),
        (lambda: fret.Body(fret.RIGID, thickness=1.0), "'thickness': it takes substrate, coatings"),
        (lambda: fret.fatigue.life(1, L=3.0), "'L': it takes result, materials"),
        (lambda: fret.Sphere(radius=3.0), "'radius': the nearest is 'R'"),
        (lambda: fret.LoadPath.start().normal(F=3.0), "'F': the nearest is 'W'"),
    ],
)
def test_a_wrong_keyword_is_refused_with_the_nearest(
    call: Callable[[], object], expected: str
) -> None:
    with pytest.raises(TypeError, match=expected):
        call()


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_an_unknown_keyword_is_refused_with_those_that_are_known(
    monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    """Every function, method and constructor with known argument names does so."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    count = 0
    for _, call in public.public():
        in_layer = inspect.isclass(call) and call.__module__.partition(".")[0] == "pyfret"
        function = constructor_of(call) if in_layer else getattr(call, "__func__", call)
        if not isinstance(function, FunctionType) or not is_checked(function):
            continue
        if quantities.Signature(inspect.unwrap(function)).keywords is None:
            continue
        count += 1
        item = call.__qualname__.rpartition(".")[2]
        with pytest.raises(TypeError, match=rf"{item} has no argument 'no_such_name': it takes"):
            call(no_such_name=1)
    record_property("callables", count)
    assert count > 260
    with pytest.raises(TypeError, match="'tolerance_': the nearest is 'tolerance'"):
        fret.fatigue.lives(None, None, None, tolerance_=1e-3)  # type: ignore[call-arg]
    # Keywords that a class of options has are known by it.
    with pytest.raises(TypeError, match=r"'resid': the nearest is 'residual' \(of .*azimuth"):
        fret.fatigue.life(None, None, None, resid=[0.0])  # type: ignore[call-arg]


def test_a_constructor_says_what_it_needs() -> None:
    """Every compiled class with required arguments names them, with what they are."""
    count = 0
    for kind in vars(_core).values():
        if not inspect.isclass(kind) or kind.__new__ is object.__new__:
            continue
        try:
            parameters = inspect.signature(kind).parameters.values()
        except ValueError:
            continue
        needed = [p.name for p in parameters if p.default is p.empty and p.kind in NAMED]
        if needed:
            count += 1
            with pytest.raises(TypeError, match=rf"^{kind.__name__} needs {needed[0]}\b"):
                kind()
    assert count > 20


def test_a_doubt_is_at_the_line_of_the_program_that_calls() -> None:
    """Not at a line of pyfret: by the door, by a constructor, by a run."""
    calls: list[Callable[[], object]] = [
        lambda: fret.wear.Archard(k=1e-6),
        lambda: fret.material("CrN"),
        lambda: fret.Scene(
            body1=fret.Body(fret.Elastic(E=210e9, nu=0.3), shape=fret.Sphere(R=5.0)),
            body2=fret.Body(fret.Elastic(E=210e9, nu=0.3)),
            friction=0.3,
            grid=fret.Grid.centred(width=1e-3, n=16),
        ).check(path=fret.LoadPath.start().normal(1.0)),
    ]
    for call in calls:
        with pytest.warns(fret.errors.SceneWarning) as doubts:
            call()
        assert {doubt.filename for doubt in doubts} == {__file__}


def test_nothing_is_no_number_where_one_is_needed() -> None:
    with pytest.raises(TypeError, match="x = None: must be given"):
        fret.fracture.Cracks.places(None, None)  # type: ignore[arg-type]


def test_what_several_objects_are_is_no_text() -> None:
    with pytest.raises(TypeError, match="increments = b'x': must be several of the class State"):
        fret.subsurface.envelope(None, b"x")  # type: ignore[arg-type]


def test_numbers_that_leave_nothing_are_refused() -> None:
    with pytest.raises(ValueError, match="both must be positive"):
        fret.experiments.fouvry2007(mu=5e-324)


def nested(depth: int = 5000) -> list[object]:
    """A list in a list in a list."""
    value: list[object] = []
    for _ in range(depth):
        value = [value]
    return value


@pytest.mark.parametrize(
    ("call", "begin"),
    [
        (lambda: fret.SurfaceMap(nested(), spacing=1e-6), "values = ?: must be"),
        (lambda: fret.Body(fret.Elastic(E=1e9, nu=0.3), coatings=nested()), "coatings: ?: must be"),
        (
            lambda: fret.fatigue.evaluate_margin(nested(), "7075", "crossland"),
            "evaluate_criterion: stress is a list, which it does not take",
        ),
    ],
)
def test_a_list_without_end_is_refused_by_its_name(call: Callable[[], object], begin: str) -> None:
    """Compiled functions and functions of Python follow one rule."""
    with pytest.raises(TypeError, match=f"^{re.escape(begin)}"):
        call()
