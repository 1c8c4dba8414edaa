"""Damage to files: bits that flip, ends that are cut."""

from __future__ import annotations

import random
from pathlib import Path


def damage(file: Path, rng: random.Random) -> None:
    """Flips a bit, cuts, empties, removes or swaps."""
    content = bytearray(file.read_bytes())
    kind = rng.randrange(6)
    if kind == 0 or not content:
        file.unlink()
    elif kind == 1:
        file.write_bytes(content[: rng.randrange(len(content))])
    elif kind == 2:
        file.write_bytes(content + bytes(rng.randrange(1, 9)))
    elif kind == 3:
        alternative = rng.choice(sorted(f for f in file.parent.iterdir() if f.is_file()))
        file.write_bytes(alternative.read_bytes())
    else:
        position = rng.randrange(len(content))
        content[position] ^= 1 << rng.randrange(8)
        file.write_bytes(content)
