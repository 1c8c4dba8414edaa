"""Scenes and files of the browsers: each has a folder by its random name, and nothing in common."""

from __future__ import annotations

import hashlib
import re
import threading
from pathlib import Path
from typing import Any

from pyfret._core import Scene

__all__ = ["START", "Sessions"]

#: Names of sessions and of dropped files.
NAME = re.compile(r"[0-9a-f]{8,64}")
#: Session of the start scene, which all browsers read.
START = "0" * 32
#: Letters of a scene that a browser keeps itself; longer ones hold measured surfaces.
INLINE = 200_000
#: Sessions whose last request is remembered.
MOST_SESSIONS = 64


class Sessions:
    """The folders of the browsers, and the last scene that each wants an answer to."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._lock = threading.Lock()
        self._wanted: dict[str, str] = {}

    def folder_of(self, session: str) -> Path:
        """Return the folder of a session, made where it is missing.

        Raises
        ------
        ValueError
            The name is not one that the page makes.
        """
        if not isinstance(session, str) or not NAME.fullmatch(session):
            raise ValueError("the session has no name: reload the page")
        folder = self.folder / session
        folder.mkdir(mode=0o700, exist_ok=True)
        return folder

    def pack(self, session: str, scene: Scene, names: dict[str, str]) -> dict[str, Any]:
        """Return a scene for the store of a browser; a long one lies in the session's folder."""
        text = scene.to_toml()
        if len(text) <= INLINE:
            return {"toml": text, "names": names}
        key = hashlib.sha256(text.encode()).hexdigest()[:32]
        (self.folder_of(session) / f"{key}.toml").write_text(text, encoding="utf-8")
        return {"file": key, "names": names}

    def unpack(self, session: str, packed: dict[str, Any]) -> tuple[Scene, dict[str, str]]:
        """Return the scene of a store, and the names of its materials.

        Raises
        ------
        ValueError
            The store is damaged, or its file is gone.
        """
        names = packed.get("names") or {}
        if "toml" in packed:
            return read_scene_text(packed["toml"]), dict(names)
        key = packed.get("file", "")
        if not NAME.fullmatch(str(key)):
            raise ValueError("the scene of this page is damaged: take a preset")
        places = (self.folder_of(name) / f"{key}.toml" for name in (session, START))
        path = next((path for path in places if path.is_file()), None)
        if path is None:
            raise ValueError("the scene of this page is gone: take a preset, or drop its file")
        return read_scene_text(path.read_text(encoding="utf-8")), dict(names)

    def want(self, session: str, key: str) -> None:
        """Remember the scene that a browser waits for."""
        with self._lock:
            self._wanted.pop(session, None)
            self._wanted[session] = key
            while len(self._wanted) > MOST_SESSIONS:
                self._wanted.pop(next(iter(self._wanted)))

    def wants(self, session: str, key: str) -> bool:
        """Check that a browser still waits for a scene."""
        with self._lock:
            return self._wanted.get(session, key) == key


def read_scene_text(text: str) -> Scene:
    """Read the text of a scene that names no files.

    Raises
    ------
    ValueError
        The scene has no meaning, or names a file: a text has no folder.
    """
    if re.search(r"\bfile\s*=", text):
        raise ValueError("the scene names a file: drop the surface itself, or open the folder")
    return Scene.from_toml(text)
