"""A headless browser for tests of pages, with the errors and requests that it reports."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from toolchain.tools import require

if TYPE_CHECKING:
    from playwright.sync_api import Browser

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
QUIET = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


@contextmanager
def launched() -> Iterator[Browser]:
    """The browser; the test is skipped where there is none, with the command that installs it."""
    program = next(filter(None, map(shutil.which, NAMES)), None) or require(NAMES[0], NAMES[0])
    sync_api = pytest.importorskip("playwright.sync_api", reason='no playwright: pip install "mahovik[test]"')
    with sync_api.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=program, args=QUIET)
        yield browser
        browser.close()


class Opened:
    """A page in the browser that notes errors and requests: `complaints`, `requests`."""

    def __init__(self, browser: Browser, path: Path, **context: Any) -> None:
        self.context = browser.new_context(**{"viewport": {"width": 1100, "height": 900}} | context)
        self.page = self.context.new_page()
        self.page.set_default_timeout(120_000)  # ms; a busy machine draws slowly
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.address = path.as_uri()
        self.page.goto(self.address)
