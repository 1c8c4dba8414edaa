"""Times of the workbench in Chromium: to a usable page, and to numbers after a change.

    python benches/workbench.py [--turns N]

The contact is the first one of the page, on 48 x 48 cells. "Usable" is the time from the command to
a number that can be changed beside its first preview. Times of a change begin at the key Enter.
The processor time is the one of the server: unlike the time it hardly grows on a busy machine. The
bars on a quiet machine: page 4 s, preview 0.3 s, full answer 1.5 s, life and crack 4 s.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from pathlib import Path
from statistics import median
from typing import Any

import psutil

sys.path.append(str(Path(__file__).parents[1] / "tests"))

from tables import table

from workbench_pages import PATIENCE, User, open_browser

#: Steps of a change: the text that each waits for, and where.
STEPS = {
    "preview": ("#state", "preview"),
    "full answer": ("#state", "full answer"),
    "life": ("#life", "first yield"),
    "crack": ("#crack", "crack"),
}


def has_text(view: Any, selector: str, words: str, before: str) -> bool:
    """Check that an element has a text with these words, and not the one before."""
    text = str(view.inner_text(selector)).strip()
    return words in text and text != before


def used_by(server: psutil.Process) -> float:
    """Processor time of the server [s]."""
    times = server.cpu_times()
    return float(times.user + times.system)


def change_number(user: User, server: psutil.Process, value: str) -> dict[str, tuple[float, float]]:
    """Change the friction coefficient; return time and processor time to each step [s]."""
    view = user.view
    before = {step: view.inner_text(place).strip() for step, (place, _) in STEPS.items()}
    before["full answer"] = before["preview"] = ""
    view.evaluate(
        """() => {
          window.changes = {};
          const look = () => {
            const state = document.getElementById('state').innerText;
            for (const name of ['preview', 'full answer'])
              if (state.startsWith(name) && window.begun && !(name in window.changes)
                  && (name === 'preview' || 'preview' in window.changes))
                window.changes[name] = performance.now() - window.begun;
          };
          new MutationObserver(look).observe(document.body,
            {subtree: true, childList: true, characterData: true});
        }"""
    )
    user.go("answers")
    view.evaluate("() => { window.begun = 0; }")
    user.go("contact")
    view.fill("#number-friction-mu", value)
    begin, used = time.perf_counter(), used_by(server)
    view.evaluate("() => { window.changes = {}; window.begun = performance.now(); }")
    view.press("#number-friction-mu", "Enter")
    user.go("answers")
    taken = {}
    for step in ("life", "crack"):
        place, start = STEPS[step]
        while not has_text(view, place, start, before[step]):
            view.wait_for_timeout(20)
            if time.perf_counter() - begin > PATIENCE / 1000:
                raise TimeoutError(step)
        taken[step] = (time.perf_counter() - begin, used_by(server) - used)
    seen = view.evaluate("() => window.changes")
    for step in ("preview", "full answer"):
        taken[step] = (seen.get(step, float("nan")) / 1000, float("nan"))
    return taken


def main() -> None:
    """Start the page, change a number some times, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--turns", type=int, default=5)
    turns = parser.parse_args().turns
    with open_browser() as browser:
        begin = time.perf_counter()
        command = [sys.executable, "-u", "-m", "pyfret", "workbench", "--no-browser"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        try:
            assert process.stdout is not None
            line = next(line for line in process.stdout if "http://" in line)
            url = next(word for word in line.split() if word.startswith("http://"))
            user = User(browser, url)
            user.view.wait_for_selector("#number-friction-mu")
            user.wait("preview|full answer")
            server = psutil.Process(process.pid)
            rows = [["page", f"{time.perf_counter() - begin:.2f}", f"{used_by(server):.2f}"]]
            user.settle()
            # The answers to the first contact end before the first change.
            user.go("answers")
            user.view.wait_for_selector("#crack table", timeout=PATIENCE)
            values = [f"{0.4 + 0.03 * n:.2f}" for n in range(1, turns + 1)]
            changes = [change_number(user, server, value) for value in values]
            for step in STEPS:
                times, used = zip(*(change[step] for change in changes), strict=True)
                rows.append([step, f"{median(times):.2f}", f"{median(used):.2f}"])
            user.close()
        finally:
            process.terminate()
            process.wait()
    print(table(["answer", "time [s]", "processor time of the server [s]"], rows))


if __name__ == "__main__":
    main()
