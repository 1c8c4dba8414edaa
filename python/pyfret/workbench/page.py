"""The page of the workbench: a Dash application of scenes that live in the browsers.

Dash is the library. Its figures are plotly's, which reports have already. It serves its files
itself, so that it works offline. Its callbacks keep no state on the server: two browsers cannot mix
their scenes. Panel and NiceGUI hold a session in the server for each browser instead.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, Any

from pyfret._core import Scene
from pyfret._util.extras import needed
from pyfret.quantities import quantities
from pyfret.solution import read
from pyfret.workbench.answers import REFUSALS, preview
from pyfret.workbench.callbacks import connect
from pyfret.workbench.file_views import read_dropped_scene
from pyfret.workbench.jobs import Jobs
from pyfret.workbench.layout import TABS, page_layout
from pyfret.workbench.names import names_of
from pyfret.workbench.presets import FIRST, make_preset
from pyfret.workbench.server import Page, make_folder, make_token
from pyfret.workbench.sessions import START, Sessions
from pyfret.workbench.theme import css
from pyfret.workbench.uploads import add_upload

if TYPE_CHECKING:
    from pyfret._core import LoadPath

__all__ = ["Page", "explore", "open_workbench"]

#: The document: its language, and no title that changes while it computes.
DOCUMENT = """<!DOCTYPE html>
<html lang="en">
<head>{%metas%}<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{%title%}</title>{%favicon%}{%css%}<style>THEME</style></head>
<body>{%app_entry%}<footer>{%config%}{%scripts%}{%renderer%}</footer></body>
</html>"""


@quantities
def explore(
    scene: Scene | str | os.PathLike[str] | None = None,
    path: LoadPath | None = None,
    *,
    port: int = 0,
) -> Page:
    """Serve the workbench: a page on which a contact answers while its parameters are dragged.

    The page has five tabs: the contact, its answers, variants side by side, measured files, and
    the same contact for other programs. A preview comes first; the full answer with its errors
    replaces it.

    The page is on 127.0.0.1 alone, by an address with a secret, and needs no network. In a
    notebook the value of the cell shows it. Needs Dash: ``pip install "fretting[explore]"``.

    Parameters
    ----------
    scene : Scene or path, optional
        The contact to begin with, or its file (default: a ball on a coated flat).
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
    'http://127.0.0.1:41287/5f0c.../'
    """
    if scene is None:
        whole, names = make_preset(FIRST)
    else:
        whole, names = read(scene), {}
    whole = whole.replace(path=path)
    whole.check()
    return serve(whole, names, port=port)


def open_workbench(file: str | os.PathLike[str] | None, *, port: int = 0) -> Page:
    """Serve the workbench on a scene file, the scene of a store, or a measured file.

    A measured file is copied to the page and shown on its fourth tab.
    """
    if file is None:
        return explore(port=port)
    source = Path(file)
    if source.is_dir() or source.suffix.lower() in (".toml", ".nc", ".zarr"):
        return serve(read_dropped_scene(source), {}, port=port)
    if not source.is_file():
        raise FileNotFoundError(2, "no such file", str(source))
    return serve(*make_preset(FIRST), port=port, measured=source)


def serve(
    scene: Scene, names: dict[str, str], *, port: int = 0, measured: Path | None = None
) -> Page:
    """Serve the page of a scene."""
    token, folder = make_token(), make_folder()
    sessions = Sessions(folder)
    jobs = Jobs(sessions)
    packed = sessions.pack(START, scene, names_of(scene, names))
    app = application(packed, token, sessions, jobs, measured)
    page = Page(app, port, token, folder)
    page.at_stop(jobs.stop)
    # The first preview, and what it imports, while the browser loads the page.
    Thread(target=answer_first, args=(scene,), daemon=True, name="first preview").start()
    return page


def answer_first(scene: Scene) -> None:
    """Solve the first preview; the page shows its refusal, where there is one."""
    with suppress(*REFUSALS):
        preview(scene, None)


def application(
    packed: dict[str, Any], token: str, sessions: Sessions, jobs: Jobs, measured: Path | None
) -> Any:
    """Make the Dash application."""
    dash = needed("dash", "explore")
    app = dash.Dash(
        "pyfret",
        title="pyfret workbench",
        update_title="",
        url_base_pathname=f"/{token}/",
        assets_folder=str(Path(__file__).parent / "assets"),
        index_string=DOCUMENT.replace("THEME", css()),
        serve_locally=True,
    )
    first = next(iter(TABS)) if measured is None else "files"
    app.layout = page_layout(packed, first)
    connect(app, sessions, jobs, measured)
    add_upload(app, sessions, token)
    return app
