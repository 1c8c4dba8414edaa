"""A quantity may be a text with its unit wherever a number is taken, by one rule."""

from __future__ import annotations

import ast
import dataclasses
import importlib
import inspect
import re
from collections.abc import Callable, Mapping
from decimal import Decimal
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np
import pytest

import pyfret as fret
from pyfret import _core
from pyfret._util import compiled
from pyfret._util.parameter import Signature
from test_types import annotation_in_stub

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]

STEEL = fret.Elastic(E=210e9, nu=0.3)
#: Callables that compute for long, write, or take any keyword.
LEFT_OUT = ("fit.", "study.", "wear.solve", "wear.resume", "solve", "march", "resume", "compare")


@pytest.fixture
def public(monkeypatch: pytest.MonkeyPatch) -> Any:
    """All public callables with good arguments."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    return importlib.import_module("public")


def test_every_number_takes_a_text_with_its_unit_or_says_what_to_write(
    public: Any, record_property: Callable[[str, object], None]
) -> None:
    """All parameters that take one number, of all public callables."""
    taken, refused, wrong = 0, 0, []
    for name, call in public.public():
        if name in public.LEFT_OUT or name.startswith(LEFT_OUT):
            continue
        computed = public.good(name, call)
        if computed is None:
            continue
        for key, value in computed[0].items():
            if type(value) is not float or not accepted(public, call, computed[0]):
                continue
            measured = _core.measured_by(f"{name}.{key}") or measured_by_type(call, key)
            if measured and " at " in measured[1]:
                # A growth law has no unit of one word.
                continue
            unit = measured[1] if measured and measured[1] else "um"
            try:
                public.invoked(call, computed[0] | {key: f"{value!r} {unit}"})
                taken += 1
                if unit == "um" and (measured is None or not measured[1]):
                    wrong.append(f"{name}({key}): a length is taken")
            except Exception as error:
                text = f"{error} {getattr(error, '__notes__', '')}"
                refused += 1
                if "write " not in text and "must be" not in text:
                    wrong.append(f"{name}({key}): {type(error).__name__}: {text:.200}")
                if "write " not in text and measured and measured[1]:
                    wrong.append(f"{name}({key}): {type(error).__name__}: {text:.200}")
    record_property("taken", taken)
    record_property("refused", refused)
    assert not wrong, "\n".join(wrong)
    assert taken > 45
    assert refused > 60


def test_every_array_takes_texts_with_units_or_says_what_to_write(
    public: Any, record_property: Callable[[str, object], None]
) -> None:
    """All parameters that take several numbers, of all public callables."""
    taken, wrong = 0, []
    for name, call in public.public():
        # A constructor of data that were measured does not read them.
        if name in public.LEFT_OUT or name.startswith(LEFT_OUT[1:]):
            continue
        computed = public.good(name, call)
        rows = {} if computed is None else computed[0]
        rows = {key: value for key, value in rows.items() if is_row(value)}
        if computed is None or not rows or not accepted(public, call, computed[0]):
            continue
        for key, value in rows.items():
            measured = _core.measured_by(f"{name}.{key}") or measured_by_type(call, key)
            unit = measured[1] if measured and measured[1] else "um"
            texts = [f"{float(number)!r} {unit}" for number in value]
            options = computed[0] | {key: tuple(texts) if isinstance(value, tuple) else texts}
            try:
                public.invoked(call, options)
                taken += 1
            except Exception as error:
                if not re.search("write |must be|exists", str(error)):
                    wrong.append(f"{name}({key}): {type(error).__name__}: {error!s:.200}")
    record_property("taken", taken)
    assert not wrong, "\n".join(wrong)
    assert taken > 20


def is_row(value: Any) -> bool:
    """Whether a value is a row of a few numbers."""
    if not isinstance(value, (list, tuple, np.ndarray)) or not 0 < len(value) < 200:
        return False
    return all(type(number) in (float, int, np.float64) for number in value)


def test_every_array_of_the_closed_forms_takes_texts() -> None:
    """The table of arrays is complete."""
    stub = ast.parse(Path(fret.__file__).with_name("_core.pyi").read_text(encoding="utf-8"))
    arrays: dict[str, set[str]] = {}
    for kind in stub.body:
        if isinstance(kind, ast.ClassDef) and kind.name in fret.reference.__all__:
            for method in (member for member in kind.body if isinstance(member, ast.FunctionDef)):
                for argument in (*method.args.args, *method.args.kwonlyargs):
                    if isinstance(argument.annotation, ast.Name) and (
                        argument.annotation.id == "ArrayLike"
                    ):
                        arrays.setdefault(f"{kind.name}.{method.name}", set()).add(argument.arg)
    assert {name: set(keys) for name, keys in compiled.ARRAYS.items()} == arrays
    ball = fret.reference.hertz(R=5e-3, bodies=(STEEL, STEEL), W=20.0)
    slip = fret.reference.CattaneoMindlin(ball, bodies=(STEEL, STEEL), mu=0.5)
    shifts = slip.shift_loading([3.0, 7.0])
    for loads in (["3 N", "7 N"], ("3000 mN", 7.0), [["3 N", "0.007 kN"]]):
        np.testing.assert_allclose(np.ravel(slip.shift_loading(loads)), shifts, rtol=1e-15)
    assert slip.shift_loading(T="7 N") == shifts[1]
    with pytest.raises(ValueError, match=r'T = "7 um": must be a number in N'):
        slip.shift_loading("7 um")


#: Numbers with a unit that the table of quantities does not have, or that several share.
NO_QUANTITY = {
    *("wear.Air", "wear.DissipatedEnergy", "wear.WearResult.cycles_to"),
}
#: Units of quantities, as descriptions of parameters give them.
WITH_UNIT = re.compile(r"\[(m|Pa|N|N/m|rad|Hz)\]")


def test_every_number_that_is_described_with_a_unit_is_a_quantity(public: Any) -> None:
    """All public callables and figures."""
    figures = [(f"plot.{name}", getattr(fret.plot, name)) for name in fret.plot.__all__]
    wrong, count = [], 0
    for name, call in [*public.public(), *figures]:
        documentation = inspect.getdoc(call) or ""
        if name in NO_QUANTITY or not WITH_UNIT.search(documentation):
            continue
        for key, parameter in parameters_of(call).items():
            entry = re.search(
                rf"^(?:\w+, )*{key}\b[\w, ]*(?: :.*)?\n( +)(.*(?:\n\1.*)*)", documentation, re.M
            )
            if entry is None or not WITH_UNIT.search(entry[2]):
                continue
            count += 1
            if re.fullmatch(r"float( \| None)?", str(parameter.annotation)):
                wrong.append(f"{name}({key})")
    assert not wrong, wrong
    assert count > 100


def parameters_of(call: Any) -> Mapping[str, inspect.Parameter]:
    """Parameters of a callable; none of the compiled criteria, which have no signature."""
    try:
        return inspect.signature(call).parameters
    except ValueError:
        return {}


def measured_by_type(call: Any, key: str) -> tuple[str, str] | None:
    """Quantity and unit of a parameter by its type: its name may have no row."""
    call = getattr(call, "__func__", call)
    arrays = compiled.ARRAYS.get(getattr(call, "__qualname__", ""), {})
    if key in arrays:
        return arrays[key]
    if isinstance(call, type) and dataclasses.is_dataclass(call):
        of_part = inspect.unwrap(call.__init__)
        rules = Signature(of_part, call).rules
    elif isinstance(call, FunctionType):
        rules = Signature(inspect.unwrap(call)).rules
    else:
        return None
    unit = rules[key].unit if key in rules else None
    return None if unit is None else (unit.quantity, unit.si)


def accepted(public: Any, call: Any, given: dict[str, Any]) -> bool:
    """Whether the good arguments are good."""
    try:
        public.invoked(call, given)
    except Exception:
        return False
    return True


def test_a_text_is_the_number_of_its_unit() -> None:
    path = fret.LoadPath.start().normal("10 N").rig("9 N/um")
    assert path.rig_stiffness == fret.LoadPath([], rig_stiffness="9 N/um").rig_stiffness == 9e6
    assert fret.wear.Archard(k="1e-5 mm^3/(N m)").k == pytest.approx(1e-14)
    assert fret.wear.Wear(
        cycles=10, body2=fret.wear.Archard(1e-14), rig_stiffness="9 N/um"
    ).rig_stiffness == pytest.approx(9e6)
    hertz = fret.reference.hertz(R="3 mm", bodies=(STEEL, STEEL), W=30.0)
    assert hertz == fret.reference.hertz(R=3e-3, bodies=(STEEL, STEEL), W=30.0)
    assert fret.Grid.centred(width="1 mm", n=8) == fret.Grid.centred(width=1e-3, n=8)
    assert fret.fracture.Threshold(dK_th="2 MPa m^0.5").dK_th == pytest.approx(2e6)


def test_another_dimension_is_refused_with_the_units_that_are_meant() -> None:
    with pytest.raises(
        ValueError, match=r'k = "3 um": must be a number in m\^2/N, a text with its'
    ):
        fret.wear.Archard(k="3 um")
    with pytest.raises(ValueError, match='"1 N": must be a number in m, a text with its unit'):
        fret.Grid.centred(width="1 N", n=8)
    with pytest.raises(TypeError, match=r'"0\.3": must be a number, not a text'):
        fret.fatigue.Criterion.findley(k="0.3")


#: Numbers of the closed forms that have no unit.
PURE = {"mu", "nu", "beta", "eps_x"}


def test_a_load_of_a_closed_form_is_one_of_its_contact(public: Any) -> None:
    """All numbers of the closed forms: N/m of a line, N of others, each in another unit."""
    requests = []
    for name, call in public.public():
        computed = public.good(name, call) if name.startswith("reference.") else None
        if computed is None or not accepted(public, call, computed[0]):
            continue
        line = "line" in name.lower()
        for key, value in computed[0].items():
            if type(value) is not float or key in PURE or takes_array(call, key):
                continue
            unit, power, wrong = "um", -6, "2 N"
            if key in {"W", "T", "T_m"}:
                unit, power, wrong = ("N/mm", 3, "2 kN") if line else ("kN", 3, "2 kN/m")
            elif key in {"E_star", "p0"}:
                unit, power = "MPa", 6
            elif key == "M_z":
                unit, power = "N mm", -3
            # In decimals, as a reader writes it: 6e-5 m are 60 um.
            number = Decimal(repr(value)).scaleb(-power)
            right = public.invoked(call, computed[0])
            options = public.invoked(call, computed[0] | {key: f"{number} {unit}"})
            assert numbers_in(options) == pytest.approx(numbers_in(right), rel=1e-12), (name, key)
            with pytest.raises(ValueError, match="must be a number in") as refused:
                public.invoked(call, computed[0] | {key: wrong})
            if key in {"W", "T", "T_m"}:
                assert f"must be a number in {'N/m' if line else 'N'}, a text" in str(refused.value)
            requests.append(f"{name}({key})")
    assert {"reference.line_contact(W)", "reference.hertz(W)"} <= set(requests)
    assert {"reference.LineContact.q(T)", "reference.CattaneoMindlin.loop_energy(T_m)"} <= set(
        requests
    )
    assert len(requests) > 20, requests


def takes_array(call: Any, key: str) -> bool:
    """Whether a parameter takes an array, whose numbers are in SI units."""
    name = f"{call.__qualname__}.__new__" if isinstance(call, type) else call.__qualname__
    return "ArrayLike" in annotation_in_stub(name, key)


def numbers_in(of: Any) -> Any:
    """The numbers of an answer: itself, or those that its representation has."""
    if isinstance(of, float | np.ndarray | list):
        return np.asarray(of)
    return [float(number) for number in re.findall(r"\d[\d.]*(?:e-?\d+)?", repr(of))]
