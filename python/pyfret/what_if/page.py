"""The page: sliders, figures and numbers, served on this machine alone.

The library is Dash. Its figures are plotly's, which the reports have already. It serves all its
files itself, so that it works offline. Its callbacks keep no state on the server. All that a
browser has changed lives in that browser, so that two of them cannot mix their scenes.
"""

from __future__ import annotations

import math
import threading
import time
from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed
from pyfret.quantities import quantities
from pyfret.solution import read
from pyfret.what_if.answer import FEWER, PageAnswer, answer
from pyfret.what_if.controls import changed, controls

if TYPE_CHECKING:
    import os

    from pyfret._core import LoadPath, Scene

__all__ = ["Page", "explore"]

#: Cells along x: of balls, of line contacts, and how many times as many "solve finer" takes.
CELLS, CELLS_OF_LINES, FINER = 48, 192, 2
#: The address of this machine, that no other one can reach.
HERE = "127.0.0.1"
#: Names of this machine in the address of a page.
NAMES = (HERE, "localhost")


class Page:
    """A page that is served on this machine until it is stopped.

    Attributes
    ----------
    url : str
        Its address.
    """

    def __init__(self, server: Any) -> None:
        self._server = server
        self.url = f"http://{HERE}:{server.server_port}/"
        self._thread = threading.Thread(target=server.serve_forever, daemon=True, name="explore")
        self._thread.start()

    def stop(self) -> None:
        """End it."""
        self._server.shutdown()
        self._thread.join()

    def wait(self) -> None:
        """Serve until Ctrl-C."""
        try:
            while self._thread.is_alive():
                time.sleep(0.2)
        except KeyboardInterrupt:
            self.stop()

    def _repr_html_(self) -> str:
        """The page in a notebook."""
        return f'<iframe src="{self.url}" width="100%" height="920" style="border:0"></iframe>'

    def __repr__(self) -> str:
        """Give the address."""
        return f"Page({self.url})"


@quantities
def explore(
    scene: Scene | str | os.PathLike[str], path: LoadPath | None = None, *, port: int = 0
) -> Page:
    """Serve a page on which a contact answers while its parameters are dragged.

    Sliders: load, friction, thickness and modulus of the outermost coating, radius. At once: loop,
    stick and slip, tractions and stress on the section along the shear. The page has the largest
    stress, its layer, and the first doubt that applies. A preview comes first, with a third of the
    increments of the neighbouring scene; the full answer replaces it. The line above the numbers
    begins with "preview" or "full answer".

    The page is on 127.0.0.1 alone and needs no network. In a notebook the value of the cell shows
    it. Needs Dash: ``pip install "fretting[explore]"``.

    Parameters
    ----------
    scene : Scene or path
        The contact to begin with.
    path : LoadPath, optional
        Load history (default: the scene's own).
    port : int
        Port of this machine (default: a free one).

    Returns
    -------
    Page
        Its ``url``; ``stop()`` ends it.

    Examples
    --------
    >>> page = explore(scene, path)  # doctest: +SKIP
    >>> page.url  # doctest: +SKIP
    'http://127.0.0.1:41287/'
    """
    whole = read(scene).replace(path=path)
    whole.check()
    serving = needed("werkzeug.serving", "explore")
    app = application(whole)
    return Page(serving.make_server(HERE, port, app.server, threaded=True))


def application(scene: Scene) -> Any:
    """The Dash application of a scene."""
    dash = needed("dash", "explore")
    quiet()
    app = dash.Dash("pyfret", title="pyfret: what if", update_title="")
    app.layout = layout(scene, dash)
    app.server.before_request(refuse_others)
    answers(app, scene, dash)
    return app


def quiet() -> None:
    """Keep the server from writing a line for every request."""
    import logging

    logging.getLogger("werkzeug").setLevel(logging.ERROR)


def refuse_others() -> Any:
    """Refuse requests by another name of this machine, as a page of somebody else would send."""
    flask = needed("flask", "explore")
    if flask.request.host.partition(":")[0] not in NAMES:
        flask.abort(403)


def layout(scene: Scene, dash: Any) -> Any:
    """The page."""
    html, dcc = dash.html, dash.dcc
    sliders = []
    for control in controls(scene):
        low, high = control.ends(scene)
        value = control.read(scene)
        assert value is not None
        sliders += [
            html.Div(
                [control.label, ": ", html.B(control.text(value), id=f"text-{control.name}")],
                style={"marginTop": "1em"},
            ),
            dcc.Slider(
                math.log10(low),
                math.log10(high),
                value=math.log10(value),
                step=0.001,
                marks=None,
                id=f"slider-{control.name}",
                updatemode="drag",
                allow_direct_input=False,
            ),
        ]
    buttons = [
        html.Button(text, id=name, n_clicks=0, style={"marginRight": ".6em", "marginTop": "1em"})
        for name, text in (
            ("as-python", "as Python"),
            ("as-scene", "as scene file"),
            ("finer", "solve finer"),
        )
    ]
    return html.Div(
        [
            html.H2(scene.title or "What if"),
            html.Div(
                [
                    html.Div(
                        [
                            *sliders,
                            html.Div(buttons),
                            html.P(id="state", style={"color": "#555"}),
                            html.P(id="doubt", style={"color": "#B04000"}),
                            html.Table(id="numbers"),
                        ],
                        style={"width": "22em", "flex": "none"},
                    ),
                    dcc.Graph(
                        id="figure", style={"flex": "auto"}, config={"displayModeBar": False}
                    ),
                ],
                style={"display": "flex", "gap": "1.5em"},
            ),
            dcc.Store(id="counts"),
            dcc.Store(id="previewed"),
            dcc.Download(id="file"),
        ],
        style={"fontFamily": "sans-serif", "margin": "1em 2em"},
    )


def answers(app: Any, scene: Scene, dash: Any) -> None:
    """Connect the callbacks of the page."""
    shown = controls(scene)
    inputs = [dash.Input(f"slider-{control.name}", "value") for control in shown]
    states = [dash.State(f"slider-{control.name}", "value") for control in shown]
    texts = [dash.Output(f"text-{control.name}", "children") for control in shown]
    n = CELLS_OF_LINES if scene.grid.plane_strain else CELLS

    def made(places: tuple[float, ...], cells: int = n) -> Scene:
        values = {control.name: 10.0**place for control, place in zip(shown, places, strict=True)}
        return changed(scene, values, n=cells)

    def begun(cells: int) -> Scene:
        """The scene that the page begins with, whose increments are the first guess of others."""
        return changed(scene, {}, n=cells).replace(save="branches")

    def panel(found: PageAnswer, state: str) -> list[Any]:
        html = dash.html
        rows = [html.Tr([html.Td(f"{k}: "), html.Td(v)]) for k, v in found.numbers.items()]
        rows.append(html.Tr([], **{"data-largest": repr(found.largest)}, id="largest"))
        return [found.figure, rows, found.doubt, state]

    everything = [
        dash.Output("figure", "figure", allow_duplicate=True),
        dash.Output("numbers", "children", allow_duplicate=True),
        dash.Output("doubt", "children", allow_duplicate=True),
        dash.Output("state", "children", allow_duplicate=True),
    ]

    def refused(error: ValueError) -> list[Any]:
        keep = dash.no_update
        return [keep, keep, str(error), "no answer"]

    @app.callback(  # type: ignore[untyped-decorator]
        *everything,
        dash.Output("previewed", "data"),
        *texts,
        *inputs,
        dash.State("counts", "data"),
        prevent_initial_call="initial_duplicate",
    )
    def preview(*given: Any) -> list[Any]:
        """The first answer to a change."""
        *places, counts = given
        labels = [control.text(10.0**place) for control, place in zip(shown, places, strict=True)]
        if counts is None:
            # Nothing is known of the increments yet: the full answer is the first.
            keep = dash.no_update
            return [keep, keep, "", "solving ...", places, *labels]
        try:
            shown_answer = answer(made(tuple(places)), counts)
        except ValueError as error:
            return [*refused(error), places, *labels]
        cells = f"{n} x {n}" if not scene.grid.plane_strain else f"{n}"
        state = (
            f"preview: {cells} cells, 1/{FEWER} of the increments of the neighbouring scene; "
            "the full answer follows"
        )
        return [*panel(shown_answer, state), places, *labels]

    @app.callback(  # type: ignore[untyped-decorator]
        *everything,
        dash.Output("counts", "data"),
        dash.Input("previewed", "data"),
        prevent_initial_call=True,
    )
    def in_full(places: list[float]) -> list[Any]:
        """The full answer, after the preview."""
        return full(tuple(places), n)

    @app.callback(  # type: ignore[untyped-decorator]
        *everything,
        dash.Output("counts", "data", allow_duplicate=True),
        dash.Input("finer", "n_clicks"),
        *states,
        prevent_initial_call=True,
    )
    def finer(_: int, *places: float) -> list[Any]:
        """The full answer on more cells."""
        return full(places, FINER * n)

    def full(places: tuple[float, ...], cells: int) -> list[Any]:
        try:
            shown_answer = answer(made(places, cells), like=begun(cells))
        except ValueError as error:
            return [*refused(error), dash.no_update]
        state = f"full answer: {cells} cells along x, {sum(shown_answer.counts)} chosen increments"
        return [*panel(shown_answer, state), shown_answer.counts]

    @app.callback(  # type: ignore[untyped-decorator]
        dash.Output("file", "data"),
        dash.Input("as-python", "n_clicks"),
        dash.Input("as-scene", "n_clicks"),
        *states,
        prevent_initial_call=True,
    )
    def write(_: int, __: int, *places: float) -> dict[str, str]:
        """The scene as a file."""
        text = made(places).to_toml()
        if dash.ctx.triggered_id == "as-scene":
            return {"content": text, "filename": "scene.toml"}
        return {"content": as_python(text), "filename": "scene.py"}


def as_python(text: str) -> str:
    """A script that solves a scene and shows it."""
    quoted = text.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    return (
        "import matplotlib.pyplot as plt\n\nimport pyfret as fret\n\n"
        f'scene = fret.Scene.from_toml("""\n{quoted}""")\n'
        "result = fret.solve(scene)\nprint(result.summary())\nresult.plot()\nplt.show()\n"
    )
