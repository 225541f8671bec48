"""The site builds without a warning (of a page that no index lists, too), and it needs no network."""

from __future__ import annotations

import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

from docs.pages import ROOT
from report.chromium import Opened, launched

DOCS = ROOT / "docs"


class Loads(HTMLParser):
    """Files that a browser loads with a page, and targets of its links."""

    def __init__(self) -> None:
        super().__init__()
        self.loaded: list[str] = []
        self.links: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        attributes = dict(attrs)
        if tag in ("script", "img", "link", "iframe", "source", "object", "embed"):
            self.loaded += [value for key in ("src", "href", "data") if (value := attributes.get(key))]
        elif tag == "a" and attributes.get("href"):
            self.links.append(str(attributes["href"]))


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built as `make docs` builds it."""
    out = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-n", "-q", "-b", "html", str(DOCS), str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert " ".join(command[2:-2]) in (ROOT / "Makefile").read_text(encoding="utf-8")
    return out


@pytest.mark.slow
def test_nothing_is_loaded_from_the_network(site: Path) -> None:
    """Pages and style sheets load nothing; every link into the site leads to a file."""
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > len(list(DOCS.rglob("*.md")))
    for page in pages:
        loads = Loads()
        loads.feed(page.read_text(encoding="utf-8"))
        assert not [target for target in loads.loaded if re.match(r"(https?:)?//", target)], page.name
        for target in loads.loaded + loads.links:
            path = re.split(r"[?#]", target)[0]
            if path and not re.match(r"[a-z]+:", path):
                assert (page.parent / path).exists(), f"{page.name}: {target}"
    for sheet in site.rglob("*.css"):
        assert not re.search(r"url\(['\"]?(https?:)?//|@import", sheet.read_text(encoding="utf-8")), sheet.name


@pytest.mark.slow
def test_pages_fit_a_phone_and_ask_for_nothing(site: Path) -> None:
    """In a browser with dark colours no page is wider than the screen, logs an error or makes a request."""
    root = "document.documentElement"
    with launched() as browser:
        opened = Opened(browser, site / "index.html", viewport={"width": 390, "height": 844}, color_scheme="dark")
        for page in sorted(site.rglob("*.html")):
            opened.page.goto(page.as_uri())
            assert opened.page.evaluate(f"{root}.scrollWidth <= {root}.clientWidth"), page.name
        assert opened.complaints == []
        assert [url for url in opened.requests if not url.startswith("file:")] == []
