"""The site of the documentation: `make docs`. Pages are those of this folder, as they are read in the repository."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from docutils import nodes
from pygments.lexers.special import TextLexer
from sphinx import addnodes
from sphinx.highlighting import lexers
from sphinx.util import osutil

if TYPE_CHECKING:
    from sphinx.application import Sphinx

sys.path.insert(0, str(Path(__file__).resolve().parent))  # of formulas.py

project = "mahovik"
html_title = "mahovik"
extensions = ["myst_parser", "formulas"]
myst_enable_extensions = ["dollarmath"]
html_math_renderer = "mathml"
exclude_patterns: list[str] = []
nitpicky = True

lexers["csv"] = TextLexer()  # Pygments has none
highlight_language = "text"  # of fences without a language
smartquotes = False  # phi' is a derivative, not a quotation
myst_heading_anchors = 6  # anchors of headings as in the repository

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_copyright = False

LISTS = {
    "index": "",
    "tutorial": "tutorial-",
}
"""Pages whose lists of links become tables of contents, and the folder of the listed pages."""


def contents(page: str, folder: str) -> str:
    """The lists of links to pages in `folder` under the headings of a page, as tables of contents."""
    text = ""
    for section in page.split("\n## ")[1:]:
        heading, _, listed = section.partition("\n")
        pages = re.findall(r"^\* .*?\]\((\S+\.md)\)", listed, re.MULTILINE)
        pages = [name for name in pages if name.startswith(folder)]
        if pages:
            text += toctree(heading, pages)
    return text


def toctree(heading: str, pages: list[str]) -> str:
    """A hidden table of contents."""
    return "\n".join(["", "```{toctree}", ":hidden:", f":caption: {heading}", "", *pages, "```", ""])


def read(app: Sphinx, name: str, source: list[str]) -> None:
    """Turn a page of the repository into one of the site.

    The lists of LISTS become tables of contents too; links to Markdown outside this folder become files.
    """
    if name in LISTS:
        source[0] += contents(source[0], LISTS[name])
    source[0] = re.sub(r"(?<=\]\()[^)#:]*\.md(?=\))", lambda link: outside(app, name, link[0]), source[0])


def outside(app: Sphinx, name: str, target: str) -> str:
    """A link of the page, marked as one to a file where it leads out of this folder."""
    file = (Path(app.srcdir) / name).parent / target
    return target if file.resolve().is_relative_to(app.srcdir) else f"path:{target}"


def show(app: Sphinx, tree: nodes.document, name: str) -> None:
    """Files of the repository that pages link to (C, templates) are shown by the browser instead of saved."""
    page = app.builder.get_target_uri(name)
    for link in [link for link in tree.findall(addnodes.download_reference) if "filename" in link]:
        target = osutil.relative_uri(page, f"_downloads/{link['filename']}")
        link.replace_self(nodes.reference("", "", *link.children, refuri=target, internal=True))


def setup(app: Sphinx) -> None:
    """Called by Sphinx as it starts."""
    app.connect("source-read", read)
    app.connect("doctree-resolved", show)
