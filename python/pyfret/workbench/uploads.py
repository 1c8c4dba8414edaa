"""Dropped files: written into the folder of their session and nowhere else."""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any

from pyfret._util.extras import needed

if TYPE_CHECKING:
    from pyfret.workbench.sessions import Sessions

__all__ = ["add_upload", "drop_folder", "dropped_path", "safe_parts"]

#: Largest file and largest drop [bytes], most files of a drop.
MOST_FILE, MOST_DROP, MOST_FILES = 200_000_000, 200_000_000, 20_000
#: Bytes that are read at once.
CHUNK = 1 << 20
#: Longest name, deepest folder.
LONGEST, DEEPEST = 120, 12
#: Letters that names of files of instruments and stores have.
ALLOWED = re.compile(r"[^\x00-\x1f\x7f/\\:*?\"<>|]+")


def safe_parts(path: str) -> list[str]:
    """Return the parts of a relative path.

    Raises
    ------
    ValueError
        It leaves its folder, or has letters that no name of a file has.
    """
    parts = PurePosixPath(path).parts
    if not parts or len(parts) > DEEPEST or path.startswith("/"):
        raise ValueError("the path of the file must be relative and at most 12 folders deep")
    for part in parts:
        if part in (".", "..") or not ALLOWED.fullmatch(part) or len(part) > LONGEST:
            raise ValueError("a name of the path has letters that no name of a file has")
    return list(parts)


def drop_folder(sessions: Sessions, session: str, drop: str) -> Path:
    """Return the folder of a drop."""
    if not re.fullmatch(r"[0-9a-f]{16}", drop):
        raise ValueError("the drop has no name: reload the page")
    folder = sessions.folder_of(session) / f"drop-{drop}"
    folder.mkdir(mode=0o700, exist_ok=True)
    return folder


def dropped_path(sessions: Sessions, session: str, drop: str, name: str) -> Path:
    """Return the place of a dropped file or folder.

    Raises
    ------
    ValueError
        There is none.
    """
    path = drop_folder(sessions, session, drop) / safe_parts(name)[0]
    if not path.exists():
        raise ValueError(f"{name}: is no longer there: drop it again")
    return path


def folder_size(folder: Path) -> tuple[int, int]:
    """Return bytes and number of the files in a folder."""
    sizes = [path.stat().st_size for path in folder.rglob("*") if path.is_file()]
    return sum(sizes), len(sizes)


def add_upload(app: Any, sessions: Sessions, token: str) -> None:
    """Add the address that files are sent to."""
    flask = needed("flask", "explore")

    @app.server.route(f"/{token}/upload/<session>/<drop>", methods=["POST"])  # type: ignore[untyped-decorator]
    def upload(session: str, drop: str) -> Any:
        """Store one file of a drop."""
        request = flask.request
        length = request.content_length
        if length is None or length > MOST_FILE:
            return f"a file may have {MOST_FILE // 1_000_000} MB", 413
        try:
            parts = safe_parts(request.args.get("path", ""))
            folder = drop_folder(sessions, session, drop)
        except ValueError as error:
            return str(error), 400
        size, count = folder_size(folder)
        if size + length > MOST_DROP or count >= MOST_FILES:
            return f"a drop may have {MOST_DROP // 1_000_000} MB in {MOST_FILES} files", 413
        target = folder.joinpath(*parts)
        target.parent.mkdir(parents=True, exist_ok=True)
        with target.open("wb") as file:
            while chunk := request.stream.read(CHUNK):
                file.write(chunk)
        return "", 200
