"""Closed forms: the truths that the numerical solution is measured against."""

from pyfret._core import (
    CattaneoMindlin,
    CoatedIndentation,
    CoupledIndentation,
    Hertz,
    HertzEllipse,
    HertzStress,
    LineContact,
    Lubkin,
    Springs,
    coated_indentation,
    coupled_indentation,
    dundurs_beta,
    goodman_stick_ratio,
    hertz,
    hertz_ellipse,
    line_contact,
)
from pyfret._util.names import listing
from pyfret._util.sheet import sheet

__all__ = [
    "CattaneoMindlin",
    "CoatedIndentation",
    "CoupledIndentation",
    "Hertz",
    "HertzEllipse",
    "HertzStress",
    "LineContact",
    "Lubkin",
    "Springs",
    "coated_indentation",
    "coupled_indentation",
    "dundurs_beta",
    "goodman_stick_ratio",
    "hertz",
    "hertz_ellipse",
    "line_contact",
]
__dir__ = listing(__all__)

for _of in (
    *(CattaneoMindlin, CoatedIndentation, CoupledIndentation, Hertz, HertzEllipse, HertzStress),
    *(LineContact, Lubkin, Springs),
):
    setattr(_of, "__str__", sheet)  # noqa: B010  # a method of a compiled class
