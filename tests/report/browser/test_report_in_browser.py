"""The report in the hands of a reader: opened from a file, in a browser, on a phone, in the dark, on paper."""

import pytest

from report.browser.conftest import Opener

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("name", ["bench8", "demo3", "none", "many"])
def test_no_errors_and_no_requests(opened: Opener, name: str) -> None:
    """Nothing is loaded but the file, and the browser reports no error."""
    found = opened(name)
    assert found.complaints == []
    assert found.requests == [found.address]


@pytest.mark.parametrize("width", [320, 400])
def test_narrow_pages_do_not_overflow(opened: Opener, width: int) -> None:
    """On a phone what is wide scrolls in its own frame."""
    found = opened("bench8", viewport={"width": width, "height": 800})
    assert found.page.evaluate("document.scrollingElement.scrollWidth") <= width


def test_paper_shows_everything_but_controls(opened: Opener) -> None:
    """In print colours, dark or not; parts that are closed on screen are opened, buttons are left out."""
    page = opened("bench8", color_scheme="dark").page
    page.emulate_media(media="print", color_scheme="dark")
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert page.evaluate("[...document.querySelectorAll('main > section')].every((s) => s.offsetHeight > 60)")
    assert not page.locator("#theme").is_visible()
    page.pdf()
    assert page.evaluate("[...document.querySelectorAll('details')].every((each) => each.open)")
