"""The binding reads every number of every function through one door."""

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
from pyfret._util import compiled, door
from pyfret._util.door import OBJECTS, is_own

ROOT = Path(__file__).parents[1]
#: Types of the binding that hold numbers.
RAW = re.compile(
    r"(?:Option<)?(?:f64|usize|u8|u32|u64|i64|\(f64, f64\)|\(usize, usize\)|\[f64; \d\])>?$"
)


def binding() -> list[tuple[str, str, bool]]:
    """Parameters of raw numbers of the binding, their types, and whether the door reads them."""
    found = []
    for file in sorted((ROOT / "crates/pyfret/src").rglob("*.rs")):
        text = file.read_text()
        for start in re.finditer(r"#\[pymethods\]\s*impl[^{]*\{|#\[pyfunction", text):
            end = (
                closing(text, start.end())
                if "impl" in start[0]
                else text.find("{", text.index("fn ", start.end()))
            )
            part = text[start.end() : end]
            for head in re.finditer(r"fn (\w+)(?:<[^(]*>)?\(", part):
                parameters = part[head.end() : closing(part, head.end(), "()") - 1]
                if head[1].startswith("__"):
                    continue
                for one in re.split(r",\s*(?![^(\[<]*[)\]>])", parameters):
                    match = re.search(r"(\w+): ([^:]+)$", one.strip())
                    if match and RAW.match(match[2].strip()):
                        where = f"{file.stem}.{head[1]}({match[1]})"
                        found.append((where, match[2], "from_py_with = " in one))
    return found


def closing(text: str, start: int, pair: str = "{}") -> int:
    """Where the bracket that is open at a place closes."""
    depth = 1
    for n in range(start, len(text)):
        depth += (text[n] == pair[0]) - (text[n] == pair[1])
        if depth == 0:
            return n + 1
    raise ValueError("a bracket that does not close")


def test_lists_and_arrays_of_the_binding_come_through_the_door() -> None:
    """No list is laid out by the length that it says, and no array is read around the door."""
    wrong = []
    for file in sorted((ROOT / "crates/pyfret/src").rglob("*.rs")):
        text = file.read_text()
        for start in re.finditer(r"#\[new\]|#\[pyfunction", text):
            head = text[start.end() : text.index("{", text.index("fn ", start.end()))]
            wrong += [
                f"{file.stem}: {one}" for one in re.findall(r"\w+: Vec<\(?[\w:, ]+\)?>", head)
            ]
        if file.stem != "arguments":
            wrong += [f"{file.stem}: {one}" for one in re.findall(r"PyArrayLike\w*<[^>]*>", text)]
    # Fields that a run of wear has written, and what the command line is given.
    known = {"wear: PyArrayLike2<'py, f64>", "command_line: arguments: Vec<OsString>"}
    assert {one for one in wrong if "Py<" not in one} - known == set()


def test_the_binding_reads_all_its_numbers_by_the_door(
    record_property: Callable[[str, object], None],
) -> None:
    found = binding()
    record_property("parameters", len(found))
    assert len(found) > 150
    assert [where for where, _, by_door in found if not by_door] == []


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_every_public_callable_is_called_with_hostile_values(
    monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    """Found by introspection: none is forgotten by ``tests/hostile``."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    found = dict(public.public())
    called = {name for name, call in found.items() if public.good(name, call) is not None}
    record_property("callables", len(found))
    assert len(found) > 330
    # Constructors of the criteria take their numbers by name, whatever they are.
    forgotten = set(found) - called - set(public.LEFT_OUT)
    assert {name for name in forgotten if not name.startswith("fatigue.Criterion.")} == set()


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_an_object_of_pyfret_is_no_plain_value(
    monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    """Every parameter that takes one refuses a list by its name, before anything else is done."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    asked = 0
    for name, call in public.public():
        found = None if name in public.LEFT_OUT else public.good(name, call)
        if found is None or not isinstance(call, FunctionType):
            continue
        for one in inspect.signature(call).parameters.values():
            annotation = str(one.annotation)
            classes = [of for of in annotation.split(" | ") if of != "None"]
            if not OBJECTS.fullmatch(annotation) or not all(is_own(of) for of in classes):
                continue
            asked += 1
            said = rf"{one.name} = \[1\.0\]: must be|argument '{one.name}'|processing '{one.name}'"
            with pytest.raises(TypeError, match=said):
                public.invoked(call, found[0] | {one.name: [1.0]})
    record_property("parameters", asked)
    assert asked > 100


def stands_behind(call: Any) -> bool:
    """Whether a function of a door, of Python's or the compiled one, is this, or one it wraps."""
    while call is not None:
        of = getattr(call, "__code__", None)
        if of is not None and of.co_filename in (door.__file__, compiled.__file__):
            return True
        call = getattr(call, "__wrapped__", None)
    return False


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_every_public_function_stands_behind_the_door(
    monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    asked, open_ones = 0, []
    for name, call in public.public():
        own = isinstance(call, FunctionType) and "." not in call.__qualname__
        if not own or not inspect.signature(call).parameters:
            continue
        asked += 1
        if not stands_behind(call):
            open_ones.append(name)
    record_property("functions", asked)
    assert asked > 100
    assert open_ones == []


def constructor_of(cls: Any) -> Any:
    """What takes the arguments of a class: ``__init__``, of a compiled one ``__new__``."""
    if isinstance(cls.__init__, FunctionType):
        return cls.__init__
    return None if cls.__text_signature__ is None else cls.__new__


def test_every_compiled_callable_is_behind_the_compiled_door(
    record_property: Callable[[str, object], None],
) -> None:
    """Methods, functions and constructors, private ones of the package included."""
    asked, open_ones = 0, []
    for name, of in vars(fret._core).items():
        if isinstance(of, type) and not issubclass(of, BaseException):
            members = {f"{name}.{one}": getattr(of, one) for one in vars(of) if one[0] != "_"}
            if of.__text_signature__ is not None:
                members[f"{name}.__new__"] = of.__new__
        else:
            members = {name: of}
        for told, call in members.items():
            criterion = told.partition(".")[0] == "Criterion" and told != "Criterion.of"
            if not callable(call) or isinstance(call, type) or criterion:
                continue
            asked += 1
            if not stands_behind(call):
                open_ones.append(told)
    record_property("callables", asked)
    assert asked > 200
    assert open_ones == []


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: fret.Elastic(210e9, 0.3), r"Elastic takes arguments by name, Elastic\(E=..., nu="),
        (lambda: fret.History("cycles"), "History is not made: it is one of History.INCREMENT"),
        (lambda: fret.Body(fret.RIGID, thickness=1.0), r"belongs to .*Coating\(thickness=...\)"),
        (lambda: fret.fatigue.life(1, L=3.0), r"life.over_distance\(L=...\) or life.range_of"),
        (lambda: fret.fatigue.life(1, scatter=3.0), r"life.range_of\(scatter=...\)"),
        (lambda: fret.fatigue.life(1, error=True), r"belongs to solve\(error=...\)"),
        (lambda: fret.solve(1, increments=3), r"path.cycles\(increments=...\)"),
        (lambda: fret.Sphere(radius=3.0), "'radius': the nearest is 'R'"),
        (lambda: fret.LoadPath.start().normal(F=3.0), "'F': the nearest is 'W'"),
    ],
)
def test_a_keyword_of_another_function_is_told_with_that_function(
    call: Callable[[], object], says: str
) -> None:
    with pytest.raises(TypeError, match=says):
        call()


@pytest.mark.solves
@pytest.mark.filterwarnings("ignore")
def test_an_unknown_keyword_is_refused_with_those_that_are_known(
    monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    """By every function, method and constructor whose names of arguments are known."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    public = importlib.import_module("public")
    asked = 0
    for _, call in public.public():
        own = inspect.isclass(call) and call.__module__.partition(".")[0] == "pyfret"
        function = constructor_of(call) if own else getattr(call, "__func__", call)
        if not isinstance(function, FunctionType) or not stands_behind(function):
            continue
        parameters = inspect.signature(function).parameters.values()
        further = [str(of.annotation) for of in parameters if of.kind is of.VAR_KEYWORD]
        if any(door.keywords(of) is None for of in further):
            continue
        asked += 1
        of = call.__qualname__.rpartition(".")[2]
        with pytest.raises(TypeError, match=rf"{of} has no argument 'no_such_name': it takes"):
            call(no_such_name=1)
    record_property("callables", asked)
    assert asked > 260
    with pytest.raises(TypeError, match="'tolerance_': the nearest is 'tolerance'"):
        fret.fatigue.lives(None, None, None, tolerance_=1e-3)  # type: ignore[call-arg]
    # Keywords that a class of options has are known by it.
    with pytest.raises(TypeError, match=r"'resid': the nearest is 'residual' \(of .*azimuth"):
        fret.fatigue.life(None, None, None, resid=[0.0])  # type: ignore[call-arg]


def test_a_doubt_is_at_the_line_of_the_program_that_calls() -> None:
    """Not at a line of pyfret: by the door, by a constructor, by a run."""
    calls: list[Callable[[], object]] = [
        lambda: fret.wear.Archard(k=1e-6),
        lambda: fret.material("CrN"),
        lambda: fret.Scene(
            body1=fret.Body(fret.Elastic(E=210e9, nu=0.3), shape=fret.Sphere(R=5.0)),
            body2=fret.Body(fret.Elastic(E=210e9, nu=0.3)),
            mu=0.3,
            grid=fret.Grid.centred(extent=1e-3, n=16),
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
