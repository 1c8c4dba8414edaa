"""Whether the files of a release name the same version: ``python tools/release_check.py 0.1.0``."""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
#: Where the version stands, and how.
PLACES = {
    "Cargo.toml": r'(?m)^version = "([^"]+)"',
    "CITATION.cff": r"(?m)^version: (\S+)",
    "CHANGELOG.md": r"(?m)^## \[(\d[^\]]*)\]",
}


def main(version: str) -> None:
    """Fails at the first file that names another version."""
    for name, pattern in PLACES.items():
        found = re.search(pattern, (ROOT / name).read_text(encoding="utf-8"))
        if found is None or found[1] != version:
            sys.exit(f"{name}: names version {found[1] if found else 'none'}, not {version}")
    print(f"{', '.join(PLACES)}: version {version}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
