"""Runs in the background: each a process of its own with a folder, so that it can be cancelled."""

from __future__ import annotations

import json
import os
import secrets
import subprocess
import sys
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pyfret.workbench.sessions import Sessions

__all__ = ["Job", "Jobs"]

#: Runs of a page at once, and runs of a browser that are kept.
AT_ONCE, KEPT = 2, 12


@dataclass
class Job:
    """A run in the background."""

    id: str
    title: str
    folder: Path
    process: subprocess.Popen[bytes]
    cancelled: bool = False

    def running(self) -> bool:
        """Check that the process runs."""
        return self.process.poll() is None

    def progress(self) -> tuple[int, int]:
        """Return how much is done of how much; 0 of 0 before the first news."""
        try:
            done, total = json.loads((self.folder / "progress.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return 0, 0
        return int(done), int(total)

    def result(self) -> dict[str, Any]:
        """Return the result of the run: numbers and figures, or why there are none."""
        if self.cancelled:
            return {"refused": "cancelled"}
        try:
            outcome = json.loads((self.folder / "result.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {"refused": f"the run ended with code {self.process.returncode}"}
        return dict(outcome)

    def cancel(self) -> None:
        """End the process."""
        if self.running():
            self.cancelled = True
            self.process.kill()
            self.process.wait()


class Jobs:
    """The runs of all browsers, by their sessions."""

    def __init__(self, sessions: Sessions) -> None:
        self._sessions = sessions
        self._lock = threading.Lock()
        self._jobs: dict[str, list[Job]] = {}

    def start(self, session: str, title: str, order: Mapping[str, Any]) -> Job:
        """Start a run; `order` is what the worker reads.

        Raises
        ------
        ValueError
            As many runs go on as the page has at once.
        """
        with self._lock:
            running = [job for jobs in self._jobs.values() for job in jobs if job.running()]
            if len(running) >= AT_ONCE:
                raise ValueError(f"{AT_ONCE} runs are going: wait, or cancel one")
            number = secrets.token_hex(8)
            folder = self._sessions.folder_of(session) / f"job-{number}"
            folder.mkdir(mode=0o700)
            (folder / "order.json").write_text(json.dumps(order), encoding="utf-8")
            command = [sys.executable, "-m", "pyfret.workbench.worker", str(folder)]
            with (folder / "errors.txt").open("wb") as errors:
                process = subprocess.Popen(
                    command,
                    cwd=folder,
                    env={**os.environ, "MPLBACKEND": "Agg"},
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    stderr=errors,
                )
            job = Job(number, title, folder, process)
            self._jobs.setdefault(session, []).append(job)
            del self._jobs[session][:-KEPT]
            return job

    def jobs_of(self, session: str) -> list[Job]:
        """Return the runs of a browser, the last first."""
        with self._lock:
            return self._jobs.get(session, [])[::-1]

    def find(self, session: str, number: str) -> Job | None:
        """Return a run of a browser by its number."""
        return next((job for job in self.jobs_of(session) if job.id == number), None)

    def stop(self) -> None:
        """End all runs."""
        with self._lock:
            for jobs in self._jobs.values():
                for job in jobs:
                    job.cancel()
