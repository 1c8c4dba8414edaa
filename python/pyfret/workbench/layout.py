"""The frame of the page: headline, six tabs, places that the callbacks fill."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed
from pyfret.study.measures import MEASURES
from pyfret.workbench.form import button, html, select
from pyfret.workbench.judgements import CRITERIA

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["FIGURES", "TABS", "page_layout"]

#: Tabs with their titles.
TABS = {
    "contact": "Contact",
    "answers": "Answers",
    "compare": "Compare",
    "files": "Files",
    "out": "Out",
}
#: Figures of the answers with their captions.
FIGURES = {
    "loop": "Loop: force over shift.",
    "zones": "Stick and slip at the end of the path.",
    "tractions": "Pressure, shear and the bound of friction along the shear.",
    "stress": "Von Mises stress of the lower body on the section along the shear.",
}
#: Figures of the first tab.
DRAWINGS = {
    "bodies": "The bodies to scale, with the largest loads.",
    "layers": "Layers, each with room for its name. The orange line is the Hertz contact without "
    "coatings.",
    "cycle": "The load path: each load over its largest value.",
}
#: What the figures are drawn with: no tools that keyboards cannot reach.
CONFIG = {"displayModeBar": False, "responsive": True}


def graph(name: str, caption: str) -> Any:
    """Make the place of a figure with its caption."""
    h, dcc = html(), needed("dash.dcc", "explore")
    drawing = dcc.Graph(id=f"figure-{name}", config=CONFIG, className="plot", responsive=True)
    return h.Figure([drawing, h.Figcaption(caption)])


def tab(name: str, children: list[Any]) -> Any:
    """Make the panel of a tab."""
    labelled = {"aria-labelledby": f"tab-{name}"}
    return html().Section(
        children, id=f"panel-{name}", role="tabpanel", className="panel", **labelled
    )


def tab_bar(first: str) -> Any:
    """Make the row of tabs."""
    h = html()
    tabs = [
        h.Button(
            title,
            id=f"tab-{name}",
            role="tab",
            type="button",
            **{
                "data-tab": name,
                "aria-controls": f"panel-{name}",
                "aria-selected": str(name == first).lower(),
            },
        )
        for name, title in TABS.items()
    ]
    return h.Div(tabs, role="tablist", className="tabs", **{"aria-label": "Steps"})


def field(name: str, label: str, value: str) -> Any:
    """Make a text field for a number with its unit."""
    h, dcc = html(), needed("dash.dcc", "explore")
    entry = dcc.Input(id=name, type="text", value=value)
    return h.Div([h.Label(label, htmlFor=name), entry], className="field")


def answers_panel() -> list[Any]:
    """Make the second tab: numbers, figures, and the runs that take longer."""
    h = html()
    bodies = [("2", "lower body"), ("1", "upper body")]
    measures = [
        (name, f"{meaning} [{unit}]" if unit != "1" else meaning)
        for name, (unit, meaning, _) in MEASURES.items()
    ]
    wear = h.Fieldset(
        [
            h.Legend("Wear after many cycles"),
            select("wear-body", "body that wears", bodies, "2"),
            field("wear-alpha", "wear coefficient, worn volume per energy [m^3/J]", "1e-14"),
            field("wear-cycles", "cycles", "1e5"),
            button("Compute the wear", event="wear"),
        ]
    )
    study = h.Fieldset(
        [
            h.Legend("One number over one field"),
            h.Div(id="study-keys"),
            field("study-low", "from, in the unit of the field", "0.2"),
            field("study-high", "to", "0.8"),
            field("study-count", "number of values", "5"),
            select("study-measure", "number", measures, "loop_energy"),
            button("Run the study", event="study"),
        ]
    )
    criteria = [(name, text) for name, text in CRITERIA.items()]
    return [
        h.H2("Answers"),
        h.Div(
            id="numbers", className="wide", role="region", **{"aria-label": "Numbers"}, tabIndex=0
        ),
        h.H3("Will it last?"),
        select("criterion", "criterion", criteria, "smith_watson_topper", event="criterion"),
        h.Div(id="life", className="wide"),
        h.Div(id="crack", className="wide"),
        h.Div([graph(name, caption) for name, caption in FIGURES.items()], className="figures"),
        h.H3("Longer runs"),
        h.Div([wear, study], className="columns"),
        h.Div(id="jobs"),
    ]


def compare_panel() -> list[Any]:
    """Make the third tab: variants side by side."""
    h = html()
    graphs = [
        graph("compare-loop", "Loops of the variants."),
        graph("compare-p", "Pressure along the shear."),
        graph("compare-stress", "Von Mises stress below the middle of the contact."),
    ]
    return [
        h.H2("Compare"),
        h.P("Pin the contact of the first tab, change it, and pin it again: up to four variants."),
        h.Div(
            [button("Pin this contact", event="pin"), button("Remove all pins", event="unpin")],
            className="buttons",
        ),
        h.Div(
            id="comparison",
            className="wide",
            role="region",
            **{"aria-label": "Variants"},
            tabIndex=0,
        ),
        h.Div(graphs, className="figures", id="comparison-figures", hidden=True),
    ]


def files_panel() -> list[Any]:
    """Make the fourth tab: files that are dropped."""
    h = html()
    drop = h.Div(
        [
            h.P(
                "Drop a surface, a loop, the profile of a scar, a scene, or the folder of a store."
            ),
            h.Label("Or choose files", htmlFor="choose-files", className="choose"),
            h.Div(id="choose-place"),
        ],
        id="drop",
        className="drop",
    )
    return [h.H2("Files"), drop, h.P(id="upload-state", role="status"), h.Div(id="files")]


def out_panel() -> list[Any]:
    """Make the fifth tab: the same contact as Python, as a file, as a command, as a report."""
    h = html()
    names = {
        "report.html": "Report (HTML)",
        "figures.svg": "Figures (SVG)",
        "figures.png": "Figures (PNG)",
        "numbers.csv": "Table (CSV)",
        "scene.toml": "Scene file",
        "contact.py": "Python script",
    }
    buttons = [button(text, event="out", name=name) for name, text in names.items()]
    return [
        h.H2("Out"),
        h.Div(buttons, className="buttons"),
        h.P(id="out-state", role="status"),
        h.H3("A link that holds the whole scene"),
        h.P(
            "It opens in a workbench of your own: fret workbench, then paste it behind the address."
        ),
        h.Div([h.Label("link", htmlFor="link", className="unseen"), h.Div(id="link-place")]),
        h.H3("The same as Python"),
        h.Pre(id="python", tabIndex=0),
        h.H3("The same as commands"),
        h.Pre(id="commands", tabIndex=0),
        h.H3("The scene file"),
        h.Pre(id="toml", tabIndex=0),
    ]


def page_layout(packed: Mapping[str, Any], first: str) -> Any:
    """Make the page."""
    h, dcc = html(), needed("dash.dcc", "explore")
    stores = [
        dcc.Store(id="scene", storage_type="session", data=packed),
        dcc.Store(id="pins", storage_type="session", data=[]),
        dcc.Store(id="dropped", storage_type="session", data=[]),
        *(
            dcc.Store(id=name)
            for name in (
                "event",
                "done",
                "session",
                "tab",
                "judging",
                "solved",
                "previewed",
                "judged",
            )
        ),
        dcc.Store(id="counts"),
        dcc.Store(id="note"),
        dcc.Interval(id="tick", interval=1000, disabled=False),
        dcc.Download(id="file"),
    ]
    contact = [
        h.H2("Contact"),
        h.Div(
            [
                h.Div(id="form", className="form"),
                h.Div([graph(*item) for item in DRAWINGS.items()], className="drawings"),
            ],
            className="columns contact",
        ),
    ]
    header = h.Header(
        [
            h.H1("pyfret workbench"),
            h.Button("Dark", id="theme", type="button", **{"data-theme-button": "1"}),
            tab_bar(first),
        ]
    )
    headline = h.Section(
        [
            h.Div(
                [
                    h.P("", id="state", role="status"),
                    button("Pin", label="Pin this contact for the comparison", event="pin"),
                ],
                className="head",
            ),
            h.Dl(id="headline"),
            h.Div(id="run-doubts", className="doubt"),
        ],
        className="headline",
        **{"aria-label": "Largest numbers"},
    )
    panels = [
        tab("contact", contact),
        tab("answers", answers_panel()),
        tab("compare", compare_panel()),
        tab("files", files_panel()),
        tab("out", out_panel()),
    ]
    main = h.Main([headline, *panels], id="main", **{"data-tab": first})
    return h.Div([header, main, *stores], id="workbench")
