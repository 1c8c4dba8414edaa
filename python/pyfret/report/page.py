"""One page for a browser: everything in one file, nothing fetched."""

from __future__ import annotations

import base64
import gzip
import io
import json
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import Scene, __version__
from pyfret._util import theme
from pyfret._util.files import replacement
from pyfret._util.numbers import in_letters
from pyfret._util.text import html
from pyfret.citation import sources
from pyfret.fatigue.judged import Life
from pyfret.fracture.growth import Cracks, Threshold
from pyfret.report.content import figures as numbers
from pyfret.report.crack import CrackSection
from pyfret.run.summary import directions
from pyfret.run.tables import cycles_table, ends_table
from pyfret.scene.tables import scene_html, table
from pyfret.subsurface.plastic import PlasticState

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    from matplotlib.figure import Figure

    from pyfret._core import Body
    from pyfret.run import Run
    from pyfret.wear.result import WearResult

__all__ = ["write_page"]

#: Folder of the looks of the page.
HERE = Path(__file__).parent
#: Note on the numbers of a run on a page with its wear.
SURFACES = (
    "<p>The numbers of the run belong to the surfaces before wear. The energy of a cycle and "
    "the loops in the section on wear are those {of}.</p>"
)


def write_page(
    result: Run,
    path: str | os.PathLike[str],
    *,
    wear: WearResult | None = None,
    crack: Cracks | None = None,
    threshold: Threshold | None = None,
    life: Life | Sequence[Life] | None = None,
    figures: Mapping[str, Figure] | None = None,
) -> None:
    """Write the page of :meth:`pyfret.Result.report`."""
    target = Path(path)
    if target.suffix not in (".html", ".htm"):
        raise ValueError(f"{target}: must end in .html")
    if threshold is not None and crack is None:
        raise ValueError("threshold: needs a crack, such as crack=result.crack()")
    for name, data in (("wear", wear), ("crack", crack)):
        if data is None:
            continue
        bodies = bodies_of(data)
        if bodies is None:
            raise ValueError(
                f"{name}: lacks the bodies that it is in. It is from arrays, or an older "
                "version saved it. Compute it from the run: crack=result.crack()"
            )
        if bodies != bodies_of(result):
            raise ValueError(f"{name}: is of other bodies than the run: write a page for each")
    lives = [] if life is None else [life] if isinstance(life, Life) else list(life)
    for one_life in lives:
        check_layers(one_life, result)
    cracked = None if crack is None else CrackSection(crack, threshold)
    with replacement(target) as unfinished:
        # A folder that takes no file is refused before anything is drawn.
        unfinished.touch()
        page = Template((HERE / "page.html").read_text(encoding="utf-8")).substitute(
            title=html(str(result.dataset.attrs["title"]) or "Fretting contact"),
            version=html(str(result.dataset.attrs.get("version", __version__))),
            status=html(result.status),
            doubts="".join(
                f'<p class="doubt">Doubted: {html(doubt)}.</p>' for doubt in result.doubts
            ),
            scene=scene_html(result.scene),
            ends=ends_table(result),
            bars=bars(result),
            cycles="".join(cycles_table(result, direction) for direction in directions(result)),
            plan=plan(result),
            sources=cited(result),
            surfaces="" if wear is None else SURFACES.format(of=html(wear.loops_note)),
            worn=""
            if wear is None
            else f'<pre tabindex="0">{html(in_letters(wear.summary()))}</pre>',
            more="".join(
                picture(caption, figure)
                for caption, figure in {**yielded(result), **(figures or {})}.items()
            ),
            toml=html(result.scene.to_toml()),
            css=theme.css_variables() + (HERE / "page.css").read_text(encoding="utf-8"),
            js=(HERE / "page.js").read_text(encoding="utf-8"),
            numbers=packed(
                json.dumps({**numbers(result, wear, cracked), "theme": looks()}, allow_nan=False)
            ),
            life="".join(map(life_section, lives)),
            no_life="" if lives else "hidden",
            **stills(result, wear, crack, threshold),
            plotly=packed(drawing()),
        )
        unfinished.write_text(page, encoding="utf-8")


def bodies_of(result: Run | WearResult | Cracks) -> tuple[Body, Body] | None:
    """Both bodies of a result, with shapes, materials and coatings; None where it has no scene."""
    if isinstance(result, Cracks):
        text = result.dataset.attrs.get("scene")
        scene = None if text is None else Scene.from_toml(text)
    else:
        scene = result.scene
    return None if scene is None else (scene.body1, scene.body2)


def check_layers(life: Life, result: Run) -> None:
    """Refuse a life below another contact: its interfaces are other ones."""
    interfaces = np.atleast_1d(life.dataset.attrs.get("interfaces", []))
    for body in (result.scene.body1, result.scene.body2):
        depths = np.cumsum([coating.thickness for coating in body.coatings])
        if interfaces.shape == depths.shape and np.allclose(interfaces, depths, rtol=1e-6):
            return
    raise ValueError("life: is of other bodies than the run: write a page for each")


def life_section(life: Life) -> str:
    """Return the numbers of a life, its notes and its map."""
    from pyfret import plot

    criterion = str(life.dataset.attrs["criterion"])
    figure = plot.criterion_map(life).figure
    shown = image(f"map of the criterion {criterion} below the contact", figure)
    close(figure)
    notes = "".join(f"<p>{html(note)}</p>" for note in life.notes)
    return f"{in_letters(life._repr_html_())}{notes}<p>{shown}</p>"


def yielded(result: Run) -> dict[str, Figure]:
    """Return figures of each body that has yielded: the zone and the residual stress."""
    from pyfret import plot

    state = result.at(-1)
    figures_by_caption = {}
    for body_number in (n for n in (1, 2) if state.body(n).yields):
        if PlasticState(state, body_number).volume() == 0.0:
            continue
        location = f"the {'upper' if body_number == 1 else 'lower'} body at the last increment"
        zone = plot.plastic_zone(state, body_number=body_number, units="SI")
        figures_by_caption[f"Plastic strain of {location}, on the section along the shear"] = (
            zone.figure
        )
        residual = plot.residual_stress(state, body_number=body_number, units="SI")
        figures_by_caption[
            f"Residual stress below the middle of {location}, the contact taken apart"
        ] = residual.figure
    return figures_by_caption


def drawing() -> str:
    """Return the program that draws, plotly.js."""
    try:
        from plotly.offline import get_plotlyjs
    except ImportError as absent:
        message = 'reports need plotly: pip install "fretting[report]"'
        raise ImportError(message) from absent
    return str(get_plotlyjs())


def packed(text: str) -> str:
    """Text for the page: compressed, in letters; the browser unpacks it."""
    return base64.b64encode(gzip.compress(text.encode("utf-8"), 9, mtime=0)).decode("ascii")


def bars(result: Run) -> str:
    """Explain the error bars, or how to get them."""
    if result.dataset.attrs.get("error_bars"):
        return (
            "Behind &plusmn; stand estimated errors: of the cells, from runs on other grids, of "
            "the increments, from a run with fewer, and of the solver."
        )
    return (
        "This run has no error bars; <code>fret run --error</code> or "
        "<code>solve(..., error=True)</code> estimates them."
    )


def plan(result: Run) -> str:
    """List the skipped and kept parts of the solution, with reasons."""
    rows = []
    for line in result.dataset.attrs.get("plan", ()):
        decision, _, why = str(line).partition(" (")
        kind, _, subject = decision.partition(": ")
        rows.append([html(kind), html(subject), html(why.removesuffix(")"))])
    return table(["", "what", "why"], rows, words=True)


def cited(result: Run) -> str:
    """Return the sources of the methods."""
    rows = [
        f"<li><b>{html(s.what)}</b>: {html(s.text)}, doi:{html(s.doi)}</li>"
        for s in sources(result)
    ]
    return f"<ul>{''.join(rows)}</ul>"


def looks() -> dict[str, Any]:
    """Return the theme of the figures, on a light and on a dark screen."""
    out = {}
    for name, dark in (("light", False), ("dark", True)):
        values = theme.variables(dark=dark)
        first, second = (values[f"--category-{n}"] for n in (1, 2))
        meanings = {key: values[f"--{key}"] for key in ("stick", "slip", "crack", "ink")}
        colours = {**meanings, "first": first, "second": second, "bound": values["--reference"]}
        layout = theme.plotly_layout(dark=dark)
        out[name] = {
            "colours": colours,
            "layout": layout,
            "scale": theme.plotly_scale("sequential"),
        }
    return out


def stills(
    result: Run, wear: WearResult | None, crack: Cracks | None, threshold: Threshold | None
) -> dict[str, str]:
    """Return the figures that are seen on paper, and wherever no program draws."""
    from pyfret import plot

    shown = {"still": [("the loop, the contact and the stress below", plot.overview(result))]}
    shown["still_crack"] = []
    if crack is not None:
        largest = crack.lengths[len(crack.lengths) // 2]
        figure = plot.intensity_history(crack, float(largest)).figure
        shown["still_crack"] = [("stress intensity over the cycle", figure)]
        if threshold is not None:
            diagram = plot.kitagawa(crack, threshold).figure
            shown["still_crack"].append(("diagram of Kitagawa and Takahashi", diagram))
    shown["still_wear"] = []
    if wear is not None:
        history, loops = plot.wear_history(wear).figure, plot.wear_loops(wear).figure
        shown["still_wear"] = [("worn depth over cycles", history), ("friction loops", loops)]
        if not {"air", "bed"}.isdisjoint(wear.table):
            scar = plot.third_body(wear).figure
            shown["still_wear"].append(("scar, debris and oxygen", scar))
    pages = {key: "".join(image(*pair) for pair in pairs) for key, pairs in shown.items()}
    for pairs in shown.values():
        for _, figure in pairs:
            close(figure)
    return {
        **pages,
        "verdict": "",
        "no_crack": "hidden" if crack is None else "",
        "no_wear": "hidden" if wear is None else "",
    }


def close(figure: Figure) -> None:
    """Close a figure."""
    import matplotlib.pyplot as plt

    plt.close(figure)


def image(caption: str, figure: Figure) -> str:
    """Return a figure of matplotlib as an image of vectors, described by its caption."""
    file = io.BytesIO()
    figure.savefig(file, format="svg")
    data = base64.b64encode(file.getvalue()).decode("ascii")
    return f'<img alt="{html(caption)}" src="data:image/svg+xml;base64,{data}">'


def picture(caption: str, figure: Figure) -> str:
    """Return a figure of matplotlib for the page, with a caption."""
    file = io.BytesIO()
    figure.savefig(file, format="png", dpi=150)
    data = base64.b64encode(file.getvalue()).decode("ascii")
    return (
        f'<section><h2>{html(caption)}</h2><img alt="{html(caption)}" '
        f'src="data:image/png;base64,{data}"></section>'
    )
