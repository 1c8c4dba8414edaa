"""Two browsers on one page of the workbench, whose users act at random.

    python tests/campaign/browsers.py [MINUTES]

Ten minutes by default. Fails if a browser shows the scene of the other one, if the page or the
server raises, or if the memory of the server grows by 30 MB in the second half.
"""

from __future__ import annotations

import random
import sys
import time
from pathlib import Path
from typing import Any

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

import numpy as np
import psutil

import pyfret as fret
from pyfret.workbench.presets import FIRST
from workbench_pages import PATIENCE, User, open_browser

TABS = ("contact", "answers", "compare", "files", "out")
#: Friction coefficients by which the two scenes are known apart at the end.
LAST = (0.401, 0.702)
#: Growth of the memory of the server in the second half [bytes].
MOST_GROWTH = 30e6


def act(user: User, choice: random.Random) -> None:
    """Do something at random."""
    from playwright.sync_api import TimeoutError

    actions = [
        lambda: user.go(choice.choice(TABS)),
        lambda: user.go("contact"),
        lambda: user.type("#number-friction-mu", f"{choice.uniform(0.35, 0.9):.3f}"),
        lambda: user.type("#number-path-0-W", f"{choice.uniform(8.0, 15.0):.3f}"),
        lambda: user.choose("#preset", choice.choice(["Connector", "Crossed cylinders", FIRST])),
        lambda: user.click("[data-event=add][data-part=body2]"),
        lambda: user.click("[data-event=remove]"),
        lambda: user.click(".headline [data-event=pin]"),
        lambda: user.click("[data-event=unpin]"),
        lambda: user.choose("#criterion", choice.choice(["crossland", "findley"])),
    ]
    try:
        user.view.set_default_timeout(400)
        choice.choice(actions)()
    except TimeoutError:
        # An element of another tab cannot be clicked.
        pass
    finally:
        user.view.set_default_timeout(PATIENCE)
    user.view.wait_for_timeout(choice.uniform(20, 200))


def act_at_random(browser: Any, url: str, *, seconds: float) -> list[int]:
    """Act in two browsers, compare their scenes, and return the memory after each round [bytes]."""
    process = psutil.Process()
    users = [User(browser, url) for _ in range(2)]
    choices = [random.Random(seed) for seed in (1, 2)]
    for user in users:
        user.wait()
    sizes = []
    start = time.monotonic()
    while time.monotonic() - start < seconds:
        for user, choice in zip(users, choices, strict=True):
            act(user, choice)
        sizes.append(process.memory_info().rss)
    for user, mu in zip(users, LAST, strict=True):
        user.view.wait_for_timeout(500)
        user.go("contact")
        user.type("#number-friction-mu", f"{mu}")
        user.settle()
    for user, mu in zip(users, LAST, strict=True):
        user.go("out")
        # The text follows the scene by a call of the server.
        user.view.wait_for_selector(f"#toml:has-text('{mu}')", timeout=PATIENCE)
        assert fret.Scene.from_toml(user.view.inner_text("#toml")).mu == mu
        user.close()
    return sizes


def main() -> None:
    """Act for some minutes, and print rounds and memory."""
    from pyfret.workbench.page import explore

    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
    page = explore()
    try:
        with open_browser() as browser:
            sizes = act_at_random(browser, page.url, seconds=60.0 * minutes)
    finally:
        page.stop()
    quarters = np.array_split(np.array(sizes), 4)
    grown = float(np.median(quarters[3]) - np.median(quarters[2]))
    print(f"{len(sizes)} rounds, {sizes[-1] / 1e6:.0f} MB, grown by {grown / 1e6:.1f} MB")
    assert grown < MOST_GROWTH


if __name__ == "__main__":
    main()
