"""Sizes of packed chunks: looked at before a library unpacks them.

A chunk of a megabyte may unpack to gigabytes. Nothing larger than its array allows is
unpacked.
"""

from __future__ import annotations

import struct
import zlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["unpacks_within"]

#: Largest ratio of deflate, with room; bytes that may always be unpacked.
RATIO, HARMLESS = 1100, 1 << 28
#: Bytes of a file that are read at once, and bytes beside the numbers of a chunk.
PART, MARGIN = 1 << 18, 1 << 12


def unpacks_within(file: Path, codec: str, limit: int) -> bool:
    """Return whether a packed chunk unpacks to at most `limit` bytes.

    Deflated chunks (gzip, zlib) are unpacked in parts that are thrown away, where they are large
    enough to do harm. The heads of blosc and zstd have the size that their libraries make room for.
    """
    limit += MARGIN
    deflated = codec in ("gzip", "zlib")
    if deflated and file.stat().st_size * RATIO <= max(HARMLESS, limit):
        return True
    with file.open("rb") as stream:
        if codec == "blosc":
            head = stream.read(16)
            return len(head) == 16 and struct.unpack_from("<I", head, 4)[0] <= limit
        if codec == "zstd":
            return size_of_frame(stream.read(18)) <= limit
        if not deflated:
            return True
        unpacker, size = zlib.decompressobj(wbits=47), 0
        while part := stream.read(PART):
            while part:
                size += len(unpacker.decompress(part, PART))
                if size > limit:
                    return False
                part = unpacker.unconsumed_tail
    return True


def size_of_frame(head: bytes) -> int:
    """Return the size in the head of a frame of zstd (RFC 8878, 3.1.1); 0 where it has none."""
    if len(head) < 6 or head[:4] != b"\x28\xb5\x2f\xfd":
        return 0
    descriptor = head[4]
    single = descriptor >> 5 & 1
    width = (1 if single else 0, 2, 4, 8)[descriptor >> 6]
    start = 5 + (0 if single else 1) + (0, 1, 2, 4)[descriptor & 3]
    size = int.from_bytes(head[start : start + width], "little")
    return size + 256 if width == 2 else size
