"""Axes of the figures, in the colours of the theme; the style sheet colours lines and texts."""

from __future__ import annotations

from typing import Any

from pyfret._util.theme import CATEGORIES, MARK, REFERENCE, SLIP, STICK, plotly_scale, variables

__all__ = ["CURVES", "MARK", "STICK", "ZONES", "axis", "css", "layout", "scale"]

#: Curves in their order: colours of the theme that hold on light and on dark ground.
CURVES = (CATEGORIES[0], MARK, REFERENCE, CATEGORIES[3], CATEGORIES[1])
#: Colours of the zones: none, slip, stick.
ZONES = [[0.0, "#ffffff"], [0.5, SLIP], [1.0, STICK]]


def scale() -> list[list[float | str]]:
    """Return the scale of stresses and heights."""
    return plotly_scale("sequential")


def css() -> str:
    """Return the variables of the style sheet, light or dark as the screen or the reader wants."""

    def block(*, dark: bool) -> str:
        scheme = f"color-scheme: {'dark' if dark else 'light'}; "
        edge = f"--edge: {'#8b9199' if dark else '#767676'}; "
        values = variables(dark=dark).items()
        return scheme + edge + "".join(f"{name}: {value}; " for name, value in values)

    light, dark = block(dark=False), block(dark=True)
    return (
        f":root {{ {light} }}\n"
        "@media screen and (prefers-color-scheme: dark) "
        f"{{ :root:not([data-theme=light]) {{ {dark} }} }}\n"
        f":root[data-theme=dark] {{ {dark} }}\n"
    )


def axis(title: str, **options: Any) -> dict[str, Any]:
    """Return an axis with a title; the style sheet colours its lines and texts."""
    return {
        "title": {"text": title, "standoff": 8},
        "automargin": True,
        "zeroline": False,
        "ticks": "outside",
        "ticklen": 4,
        "nticks": 6,
        **options,
    }


def layout(across: dict[str, Any], up: dict[str, Any], *, legend: bool) -> dict[str, Any]:
    """Return the layout of a figure: no background, the legend above it."""
    return {
        "xaxis": across,
        "yaxis": up,
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "margin": {"l": 56, "r": 16, "t": 34 if legend else 14, "b": 46},
        "showlegend": legend,
        "legend": {"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom"},
        "font": {"family": variables()["--font"], "size": 12},
        "uirevision": "keep",
    }
