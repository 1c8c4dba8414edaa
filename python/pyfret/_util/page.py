"""A page for a browser in the theme, with nothing fetched."""

from __future__ import annotations

import base64
from pathlib import Path

from pyfret._util import theme
from pyfret._util.files import replacement
from pyfret._util.text import html

__all__ = ["svg_image", "write_page"]

#: Looks of all pages, beside the colours of the theme.
LOOKS = Path(__file__).parents[1] / "report" / "page.css"
PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>{css}</style>
</head>
<body>
<header>
<h1>{title}</h1>
</header>
<main>
{content}
</main>
</body>
</html>
"""


def write_page(path: Path, title: str, content: str) -> None:
    """Write a page with a title and content in HTML; a page that is there is replaced."""
    css = theme.css_variables() + LOOKS.read_text(encoding="utf-8")
    with replacement(path) as unfinished:
        unfinished.write_text(
            PAGE.format(title=html(title), css=css, content=content), encoding="utf-8"
        )


def svg_image(svg: bytes, description: str) -> str:
    """Return a figure as an image of vectors, with its description for those who listen."""
    data = base64.b64encode(svg).decode("ascii")
    source = f'alt="{html(description)}" src="data:image/svg+xml;base64,{data}"'
    return f'<div class="wide" tabindex="0"><img {source}></div>'
