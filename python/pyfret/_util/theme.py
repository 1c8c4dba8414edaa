"""The look of figures, reports, pages and the book: one table of colours by meaning.

Figures take it as settings of matplotlib (:func:`settings`), pages as variables of CSS
(:func:`css_variables`), figures of plotly as scales and a layout (:func:`plotly_scale`,
:func:`plotly_layout`).

The maps of colours come from cmcrameri: F. Crameri, G. E. Shephard, P. J. Heron, Nat. Commun. 11
(2020) 5444, doi:10.1038/s41467-020-19160-7. Equal steps of a value are equal steps of colour, also
for colour-blind readers, and the lightness of a sequential map changes in one direction. Cmocean
meets the same demands. Cmcrameri imports in a third of its time, and its maps are archived with a
number (doi:10.5281/zenodo.1243862).
"""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from matplotlib.colors import ListedColormap
    from numpy.typing import NDArray

__all__ = [
    "CATEGORIES",
    "CRACK",
    "DANGER",
    "INK",
    "MARK",
    "MIDDLE",
    "NEUTRAL",
    "REFERENCE",
    "SAFE",
    "SLIP",
    "STICK",
    "colour_map",
    "css_variables",
    "plotly_layout",
    "plotly_scale",
    "settings",
    "variables",
]

#: Lines and text, the softest to the strongest.
INK, SOFT, GRID, GROUND = "#202020", "#595959", "#e6e6e6", "#ffffff"
#: Curves. The lightness of neighbours differs by 15 (CIE L*) and more, in grey print too.
CATEGORIES = ("#0072B2", "#E57F00", "#00523B", "#CC79A7", "#3A1A5E", "#56B4E9", "#000000")
#: The same on a dark ground.
ON_DARK = ("#56B4E9", "#B5480A", "#7FDDB8", "#CC79A7", "#D3C3F7", "#2E8BD0", "#FFFFFF")
#: Zones of a contact.
STICK, SLIP = "#0072B2", "#F2C9A9"
#: Marks of largest values and of events.
MARK = "#D55E00"
#: Closed forms, bounds and limits that results are compared with.
REFERENCE = "#8A8A8A"
#: A crack, and contours of its danger.
CRACK = "#A50F15"
#: Areas of a map: nothing happens, safe, between, dangerous. Dangerous ones are hatched, too.
NEUTRAL, SAFE, MIDDLE, DANGER = "#FFFFFF", "#9ECAE1", "#E9F2FB", "#F5B078"
#: Warnings in pages.
WARNING = "#A33B00"

#: Kinds of quantities that have a map of colours.
Kind: TypeAlias = Literal["sequential", "diverging", "warm", "order"]
#: The map of cmcrameri of each kind, and the part of it that is used: light enough for black
#: contours and labels, dark enough for lines on white.
MAPS: dict[Kind, tuple[str, float, float]] = {
    "sequential": ("navia_r", 0.0, 0.68),
    "diverging": ("vik", 0.2, 0.8),
    "warm": ("lajolla_r", 0.0, 0.8),
    "order": ("batlow", 0.0, 0.85),
}

#: Widths of figures [inch]: a column of 85 mm, a page of 170 mm; of text on a screen by default.
WIDTHS = {"column": 85 / 25.4, "page": 170 / 25.4}
#: Width, and size of the text [points].
DEFAULT_WIDTH, TEXT, TEXT_OF_COLUMNS = 5.2, 9.0, 7.5


@cache
def colour_map(kind: Kind) -> ListedColormap:
    """Return the map of colours of a kind of quantity."""
    from matplotlib.colors import ListedColormap

    return ListedColormap(colour_table(kind), name=f"pyfret_{kind}")


@cache
def colour_table(kind: Kind) -> NDArray[np.float64]:
    """Return red, green and blue (0 to 1) of the 256 colours of a kind of quantity.

    They are read from the tables of cmcrameri: its import takes as long as pyplot.
    """
    package = find_spec("cmcrameri")
    if package is None or package.origin is None:
        message = 'colours need cmcrameri: pip install "fretting[plot]"'
        raise ModuleNotFoundError(message, name="cmcrameri")
    name, low, high = MAPS[kind]
    file = Path(package.origin).parent / "cmaps" / f"{name.removesuffix('_r')}.txt"
    table: NDArray[np.float64] = np.loadtxt(file)
    if name.endswith("_r"):
        table = table[::-1]
    return table[nearest_rows(np.linspace(low, high, 256), len(table))]


def nearest_rows(parts: NDArray[np.float64], count: int) -> NDArray[np.intp]:
    """Return the rows of a table of colours at parts (0 to 1) of its length."""
    return np.minimum((parts * count).astype(np.intp), count - 1)


def plotly_scale(kind: Kind, colours: int = 17) -> list[list[float | str]]:
    """Return the scale of colours of a kind of quantity for plotly."""
    table, places = colour_table(kind), np.linspace(0.0, 1.0, colours)
    rows = np.rint(255 * table[nearest_rows(places, len(table))]).astype(int)
    return [
        [float(at), "#" + "".join(f"{level:02x}" for level in row)]
        for at, row in zip(places, rows, strict=True)
    ]


def settings(text: float = TEXT) -> dict[str, Any]:
    """Return the settings of matplotlib, with a size of the text [points].

    Thin axes on two sides, no frames, text that stays text in vector files.
    """
    from cycler import cycler

    small = text - 1.0
    return {
        "font.family": "sans-serif",
        "font.sans-serif": ["DejaVu Sans"],
        "font.size": text,
        "mathtext.fontset": "dejavusans",
        "axes.titlesize": text,
        "axes.titlelocation": "left",
        "axes.labelsize": text,
        "axes.linewidth": 0.7,
        "axes.edgecolor": "#404040",
        "axes.labelcolor": INK,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "axes.prop_cycle": cycler(color=list(CATEGORIES)),
        "grid.color": GRID,
        "grid.linewidth": 0.6,
        "xtick.color": "#404040",
        "ytick.color": "#404040",
        "xtick.labelsize": small,
        "ytick.labelsize": small,
        "xtick.major.width": 0.7,
        "ytick.major.width": 0.7,
        "lines.linewidth": 1.4,
        "lines.markersize": 4,
        "legend.frameon": False,
        "legend.fontsize": small,
        "legend.title_fontsize": small,
        "legend.handlelength": 1.8,
        "figure.figsize": (DEFAULT_WIDTH, 3.6),
        "figure.dpi": 110,
        "figure.constrained_layout.use": True,
        "savefig.dpi": 200,
        "hatch.linewidth": 0.5,
        "svg.fonttype": "none",
        "pdf.fonttype": 42,
        "axes.unicode_minus": True,
        "axes.formatter.use_mathtext": True,
    }


def variables(*, dark: bool = False) -> dict[str, str]:
    """Return the variables of CSS with their values, for light or for dark pages.

    ``--ink``, ``--soft``, ``--line``, ``--ground``, ``--panel``: text, notes, rules, page, boxes.
    ``--accent``: links and controls. ``--warning``: doubts. ``--stick``, ``--slip``, ``--mark``,
    ``--reference``, ``--crack`` and ``--category-1`` to ``--category-7``: as in figures.
    """
    page = (
        {"ink": "#e8e8e8", "soft": "#b4b4b4", "line": "#444a50", "ground": "#16191d"}
        | {"panel": "#22272c", "accent": "#6cb8ea", "warning": "#ff9d5c"}
        if dark
        else {"ink": INK, "soft": SOFT, "line": "#d9d9d9", "ground": GROUND}
        | {"panel": "#f5f5f5", "accent": "#00609A", "warning": WARNING}
    )
    meanings = {"stick": STICK, "slip": SLIP, "mark": MARK, "reference": REFERENCE, "crack": CRACK}
    meanings |= {"font": "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', sans-serif"}
    curves = {
        f"category-{n}": colour for n, colour in enumerate(ON_DARK if dark else CATEGORIES, 1)
    }
    return {f"--{name}": value for name, value in {**page, **meanings, **curves}.items()}


def css_variables() -> str:
    """Return a sheet of CSS with :func:`variables`, dark where the reader's screen is dark."""

    def block(values: dict[str, str]) -> str:
        """Return the declarations of some variables."""
        return "".join(f"{name}: {value}; " for name, value in values.items())

    light = block(variables())
    dark = block(variables(dark=True))
    return (
        f":root {{ color-scheme: light dark; {light}}}\n"
        f"@media screen and (prefers-color-scheme: dark) {{ :root {{ {dark}}} }}\n"
    )


def plotly_layout(*, dark: bool = False) -> dict[str, Any]:
    """Return the layout of figures of plotly: fonts, ground, grid and colours of curves."""
    of_page = variables(dark=dark)
    ink, line = of_page["--ink"], of_page["--line"]
    axis = {"gridcolor": line, "linecolor": ink, "zerolinecolor": line, "automargin": True}
    return {
        "font": {"family": of_page["--font"], "size": 12, "color": ink},
        "paper_bgcolor": of_page["--ground"],
        "plot_bgcolor": of_page["--ground"],
        "colorway": list(ON_DARK if dark else CATEGORIES),
        "xaxis": axis,
        "yaxis": axis,
        "hoverlabel": {"bgcolor": of_page["--panel"], "font": {"color": ink}},
    }
