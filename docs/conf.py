"""How Sphinx makes a site of the manual; `make docs` writes it to build/docs."""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path
from typing import TYPE_CHECKING

from pygments.lexers.c_cpp import CLexer

if TYPE_CHECKING:
    from sphinx.application import Sphinx

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

project = "golc"
author = "the authors of golc"
release = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
extensions = ["myst_parser"]
exclude_patterns = ["README.md"]  # index.md includes it
myst_heading_anchors = 3  # the anchors of the pages where they are read as Markdown

html_theme = "furo"
html_title = f"golc {release}"
html_use_index = False
html_copy_source = False
html_show_copyright = False
highlight_language = "text"
pygments_style = "friendly"
pygments_dark_style = "github-dark"


def setup(app: Sphinx) -> None:
    """Teach Pygments the languages of the manual, whether or not golc is installed."""
    from golc.highlighting import GolcLexer

    app.add_lexer("golc", GolcLexer)
    app.add_lexer("nqc", CLexer)
    app.connect("source-read", add_pages_of_codes)


def add_pages_of_codes(app: Sphinx, name: str, text: list[str]) -> None:
    """Put the pages of ``golc explain CODE`` below the page about codes, in their order."""
    from golc.codes.pages import page
    from golc.diagnostics import Code

    if name == "codes":
        for code in sorted(Code, key=lambda code: code.code):
            body = re.sub("^## (.*)$", r"**\1**", page(code).text, flags=re.MULTILINE)
            text[0] += f"\n## {code.code}: {code.title}\n\n{body}"
