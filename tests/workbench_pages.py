"""A real browser on the workbench: steps of a user, and checks of what the page shows."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

__all__ = ["User", "check_texts", "open_browser"]

#: Milliseconds that an answer may take on a busy machine.
PATIENCE = 120_000
#: Texts that overlap, are cut off, or stick out of the page.
FAULTS = (
    Path(__file__).with_name("workbench_faults.js").read_text(encoding="utf-8").partition("\n")[2]
)


@contextmanager
def open_browser() -> Iterator[Any]:
    """Start Chromium, or skip the test where there is none."""
    api = pytest.importorskip("playwright.sync_api", reason="no playwright")
    path = shutil.which("chromium") or shutil.which("chromium-browser")
    if path is None:
        pytest.skip("there is no Chromium")
    with api.sync_playwright() as play:
        chromium = play.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield chromium
        chromium.close()


class User:
    """Somebody in front of a page, whose actions are counted."""

    def __init__(self, browser: Any, url: str, *, width: int = 1280, scheme: str = "light") -> None:
        self.actions = 0
        self.errors: list[str] = []
        self.requests: list[str] = []
        self.context = browser.new_context(
            viewport={"width": width, "height": 900}, color_scheme=scheme, accept_downloads=True
        )
        self.view = self.context.new_page()
        self.view.on("request", lambda request: self.requests.append(request.url))
        self.view.on("pageerror", lambda error: self.errors.append(str(error)))
        self.view.on("console", self._listen)
        self.view.goto(url, timeout=PATIENCE)

    def _listen(self, message: Any) -> None:
        if message.type == "error":
            self.errors.append(message.text)

    def close(self) -> None:
        """Leave the page; there were no errors, and no requests to anybody else."""
        host = self.view.url.split("/", 3)[2]
        self.context.close()
        assert not self.errors, self.errors
        outside = [
            u for u in self.requests if not u.startswith((f"http://{host}/", "data:", "blob:"))
        ]
        assert not outside, outside

    def wait(self, state: str = "full answer:") -> None:
        """Wait until the state of the answer begins so."""
        self.view.wait_for_selector(f'#state:text-matches("^{state}")', timeout=PATIENCE)

    def settle(self) -> None:
        """Wait until no change is under way and the full answer is there."""
        for _ in range(600):
            if self.view.evaluate("() => window.workbench && window.workbench.idle()"):
                break
            self.view.wait_for_timeout(100)
        self.view.wait_for_timeout(150)
        self.wait()

    def go(self, tab: str) -> None:
        """Open a tab."""
        self.actions += 1
        self.view.click(f"#tab-{tab}")

    def click(self, selector: str) -> None:
        """Press a button."""
        self.actions += 1
        self.view.locator(selector).first.click()

    def choose(self, selector: str, value: str) -> None:
        """Choose an entry of a list."""
        self.actions += 1
        self.view.select_option(selector, value)

    def type(self, selector: str, text: str) -> None:
        """Type a value and press Enter."""
        self.actions += 1
        self.view.fill(selector, text)
        self.view.press(selector, "Enter")

    def drop(self, *paths: Path) -> None:
        """Give files to the page."""
        self.actions += 1
        self.view.set_input_files("#file-input", [str(path) for path in paths])

    def see(self, selector: str, value: str) -> None:
        """Wait until a field has a value."""
        for _ in range(PATIENCE // 100):
            if self.view.locator(selector).count() and self.view.input_value(selector) == value:
                return
            self.view.wait_for_timeout(100)
        raise AssertionError(f"{selector} is {self.view.input_value(selector)!r}, not {value!r}")

    def number(self, name: str, place: str = "#numbers") -> float:
        """Read a number of a table."""
        cell = self.view.locator(f'{place} [data-number="{name}"]').first
        cell.wait_for(timeout=PATIENCE)
        return float(cell.get_attribute("data-value") or "nan")


def check_texts(view: Any) -> list[str]:
    """Return the texts that overlap, are cut off, or stick out."""
    faults: list[str] = view.evaluate(FAULTS)
    return faults
