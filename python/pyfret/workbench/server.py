"""The server of the page: on this machine alone, by a secret address, for pages of its own only."""

from __future__ import annotations

import logging
import secrets
import shutil
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

from pyfret._util.extras import needed

__all__ = ["HERE", "Page", "guard", "make_token"]

#: The address of this machine, that no other one can reach.
HERE = "127.0.0.1"
#: Largest body of a request that is no file [bytes].
MOST_BYTES = 8_000_000
#: Headers of every answer: nothing is fetched elsewhere, nobody else may frame the page.
HEADERS = {
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
}
POLICY = (
    "default-src 'none'; connect-src 'self'; font-src 'self' data:; form-action 'none'; "
    "img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; base-uri 'none'; "
    "worker-src blob:; script-src 'self' {hashes}"
)


def make_token() -> str:
    """Return a secret for an address: 128 random bits."""
    return secrets.token_hex(16)


class Page:
    """A page that is served on this machine until it is stopped.

    Attributes
    ----------
    url : str
        Its address, with its secret.
    folder : Path
        The only folder that it writes to; it is removed at the end.
    """

    def __init__(self, app: Any, port: int, token: str, folder: Path) -> None:
        serving = needed("werkzeug.serving", "explore")
        logging.getLogger("werkzeug").setLevel(logging.ERROR)
        self.folder = folder
        self._server = serving.make_server(HERE, port, app.server, threaded=True)
        self.url = f"http://{HERE}:{self._server.server_port}/{token}/"
        self._stops: list[Any] = [self._server.shutdown]
        self._thread = threading.Thread(
            target=self._server.serve_forever, daemon=True, name="workbench"
        )
        guard(app, token, self._server.server_port)
        self._thread.start()

    def at_stop(self, action: Any) -> None:
        """Register an action for the end of the page."""
        self._stops.append(action)

    def stop(self) -> None:
        """End the server, its background runs and its folder."""
        for action in self._stops:
            action()
        self._stops.clear()
        self._thread.join()
        shutil.rmtree(self.folder, ignore_errors=True)

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


def make_folder() -> Path:
    """Make the folder of a page, which its owner alone can read."""
    return Path(tempfile.mkdtemp(prefix="fret-workbench-"))


def guard(app: Any, token: str, port: int) -> None:
    """Refuse requests without the secret, by another name, or from another page."""
    flask = needed("flask", "explore")
    hosts = {f"{HERE}:{port}", f"localhost:{port}"}
    hashes = " ".join(app.csp_hashes())

    def refuse() -> Any:
        """Refuse a request from elsewhere."""
        request = flask.request
        if request.host not in hosts:
            return "This page is at 127.0.0.1 alone.", 403
        if request.headers.get("Origin", f"http://{request.host}") != f"http://{request.host}":
            return "Requests of other pages are refused.", 403
        if request.headers.get("Sec-Fetch-Site") == "cross-site" and request.method != "GET":
            return "Requests of other pages are refused.", 403
        first = request.path.split("/", 2)[1]
        if not secrets.compare_digest(first.encode(), token.encode()):
            return "The address of this page has a secret: take the one that fret printed.", 403
        if not request.path.startswith(f"/{token}/upload/"):
            length = request.content_length
            if request.method == "POST" and (length is None or length > MOST_BYTES):
                return f"A request may have {MOST_BYTES // 1_000_000} MB.", 413
        return None

    def add_headers(response: Any) -> Any:
        """Forbid other pages to embed this one."""
        response.headers.update(HEADERS)
        response.headers["Content-Security-Policy"] = POLICY.format(hashes=hashes)
        return response

    # The first functions of all requests, before the ones of the application.
    app.server.before_request_funcs.setdefault(None, []).insert(0, refuse)
    app.server.after_request_funcs.setdefault(None, []).append(add_headers)
