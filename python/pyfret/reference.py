"""Closed forms: the truths that the numerical solution is measured against."""

from pyfret._core import (
    CattaneoMindlin,
    Hertz,
    HertzEllipse,
    Lubkin,
    dundurs_beta,
    goodman_stick_ratio,
    hertz,
    hertz_ellipse,
)

__all__ = [
    "CattaneoMindlin",
    "Hertz",
    "HertzEllipse",
    "Lubkin",
    "dundurs_beta",
    "goodman_stick_ratio",
    "hertz",
    "hertz_ellipse",
]
