"""A name that an object does not have, and an object that a figure does not draw, are refused."""

from __future__ import annotations

import importlib
import inspect
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import pytest
import xarray as xr

import pyfret as fret
from pyfret.scene.parts import Replaceable

pytestmark = [pytest.mark.solves, pytest.mark.filterwarnings("ignore")]

STEEL = fret.Elastic(E=210e9, nu=0.3)
#: Figures that are not drawn of one thing, or too dear for a walk.
LEFT_OUT = ("style", "animate", "paper_figures", "overview", "crack_panels")


@pytest.fixture
def public(monkeypatch: pytest.MonkeyPatch) -> Any:
    """All public callables with good arguments, and an object of every kind."""
    monkeypatch.syspath_prepend(str(Path(__file__).with_name("hostile")))
    return importlib.import_module("public")


def objects(public: Any) -> dict[str, Any]:
    """Objects of the package, of every kind that a user holds."""
    life = public.LIFE
    computed = {
        name: entry
        for name, entry in vars(public).items()
        if type(entry).__module__.partition(".")[0] == "pyfret" or isinstance(entry, xr.Dataset)
    }
    extra = {"worst": life.worst, "range": life.range, "over": life.over_distance([1e-5])}
    return computed | extra | {"errors": life.worst.errors, "text": "findley", "list": [1.0, 2.0]}


def test_a_misspelt_attribute_of_every_object_is_refused_with_the_nearest(public: Any) -> None:
    count = 0
    for item in objects(public).values():
        in_layer = type(item).__module__.partition(".")[0] == "pyfret"
        if not in_layer or not hasattr(type(item), "__getattr__"):
            continue
        names = [item for item in dir(item) if not item.startswith("_") and len(item) > 3]
        for name in names[:3]:
            count += 1
            with pytest.raises(
                AttributeError, match=rf"has no (?:attribute )?'{name}_'.*\b{name}\b"
            ):
                getattr(item, name + "_")
    assert count > 35


def test_a_property_that_fails_says_why_by_itself() -> None:
    class Broken(Replaceable):
        @property
        def number(self) -> float:
            raise AttributeError("the cause")

    with pytest.raises(AttributeError, match="the cause"):
        _ = Broken().number


def test_closed_forms_print_their_numbers_with_units() -> None:
    """Every attribute that is a number stands in the text; its unit stands in its docstring."""
    made = {
        "Hertz": fret.reference.hertz(R=0.05, bodies=(STEEL, STEEL), W=30.0),
        "HertzEllipse": fret.reference.hertz_ellipse(R_x=0.01, R_y=0.02, E_star=1e11, W=30.0),
        "LineContact": fret.reference.line_contact(R=0.05, bodies=(STEEL, STEEL), W=3e5),
        "HertzStress": fret.reference.HertzStress(a=1e-4, nu=0.3),
        "CoupledIndentation": fret.reference.coupled_indentation(beta=0.2, mu=0.3),
    }
    hertz = made["Hertz"]
    made["CattaneoMindlin"] = fret.reference.CattaneoMindlin(hertz, bodies=(STEEL, STEEL), mu=0.3)
    made["Lubkin"] = fret.reference.Lubkin(hertz, bodies=(STEEL, STEEL), mu=0.3)
    made["CoatedIndentation"] = fret.reference.coated_indentation(
        R=0.01, indenter=STEEL, coating=fret.Coating(STEEL, thickness=1e-5), substrate=STEEL, W=10.0
    )
    for name, item in made.items():
        lines = str(item).splitlines()
        assert lines[0] == f"{name}:"
        for key, attribute in inspect.getmembers_static(type(item), inspect.isgetsetdescriptor):
            unit = re.search(r"\[(.+?)\]", attribute.__doc__ or "")
            if key.startswith("_") or not isinstance(getattr(item, key), float):
                continue
            [line] = [line for line in lines if line.split()[0] == key]
            assert unit is None or unit[1][-1] in line, line
    assert "p0       310." in str(hertz) or "p0       31" in str(hertz)
    assert " MPa " in str(hertz)
    for item in (hertz, made["HertzEllipse"], made["LineContact"]):
        assert item.p_H == item.p0  # type: ignore[attr-defined]


@pytest.mark.usefixtures("without_layout")
def test_a_figure_says_what_it_takes_instead_of_what_it_is_given(
    public: Any, record_property: Callable[[str, object], None]
) -> None:
    """All figures of all objects: drawn, or refused by the name of the parameter."""
    count, drawn, wrong = 0, 0, []
    for name in sorted(set(fret.plot.__all__) - set(LEFT_OUT)):
        draw = getattr(fret.plot, name)
        arguments, _ = public.good(f"plot.{name}", draw)
        parameters = list(inspect.signature(draw).parameters.values())
        first = parameters[0].name
        needed = {
            item.name: arguments[item.name]
            for item in parameters[1:]
            if item.default is item.empty and item.name in arguments and item.name != "ax"
        }
        if "ax" in [item.name for item in parameters if item.default is item.empty]:
            needed["ax"] = plt.figure().add_subplot()
        for key, entry in objects(public).items():
            count += 1
            try:
                draw(entry, **needed)
                drawn += 1
            except (TypeError, ValueError) as refused:
                # An object that lacks something names it, and the remedy.
                match = re.search(rf"^{first}\b|: give ", str(refused))
                if not match:
                    wrong.append(f"{name}({key}): {type(refused).__name__}: {refused}")
            except Exception as raised:
                wrong.append(f"{name}({key}): {type(raised).__name__}: {raised}")
        plt.close("all")
    record_property("calls", count)
    assert count > 1000
    assert drawn > 50
    assert wrong == []


def test_numbers_of_a_criterion_come_from_a_material() -> None:
    """Every criterion and material gives the numbers of its assessment."""
    fatigue, made = fret.fatigue, 0
    for name in fatigue.CRITERIA:
        for key, material in fatigue.Materials().items():
            try:
                expected = material.assessment(name).criterion
            except ValueError as lacking:
                with pytest.raises(ValueError, match=re.escape(str(lacking))):
                    fatigue.Criterion.of(name, key)
                continue
            made += 1
            assert fatigue.Criterion.of(name, key) == expected
            assert getattr(fatigue.Criterion, name)(material=material) == expected
            assert fatigue.Criterion(name, **expected.numbers, material=key) == expected
    assert made > 30
    with pytest.raises(ValueError, match=r"material = \"7076 T9\": must be a Material, or one of"):
        fatigue.Criterion.findley(material="7076 T9")


def test_a_life_beyond_the_tests_is_told_as_one_everywhere(public: Any) -> None:
    """It is capped in the worst point, the fields, the range, the text and the view."""
    life = public.LIFE
    assert life.worst.margin == life.best == float("inf")
    assert life.worst.range[1] == life.high == float("inf")
    assert life.worst.range[0] <= fret._core.LONGEST_LIFE
    fields = life.dataset.life.values
    assert fields[fields < float("inf")].size == 0 or fields[fields < float("inf")].max() <= 1e7
    assert "or more" in repr(life)
    for text in (repr(life), repr(life.worst), life._repr_html_()):
        assert re.search(r"e\+?(0[89]|1\d)", text) is None, text


def test_figures_of_a_life_are_those_of_its_worst_point(public: Any) -> None:
    life = public.LIFE
    judged = fret.fatigue.evaluate_criterion(life.history(), life.criterion)
    assert float(judged.value) == pytest.approx(life.worst.value, rel=1e-9)
    assert fret.plot.critical_plane_rose(life).get_title("left").startswith("Smith")
    assert len(fret.plot.life_over_distance(life).lines[0].get_xdata()) == 9
    fret.plot.dang_van_diagram(life)
    # All of it beyond the longest life that is printed.
    fret.plot.life_over_distance(life).figure.canvas.draw()
    fret.plot.criterion_map(life).figure.canvas.draw()
    plt.close("all")
    with pytest.raises(TypeError, match=r"criterion = 'findley': must be .*Criterion.findley\(k="):
        fret.plot.critical_plane_rose(life, "findley")  # type: ignore[arg-type]
