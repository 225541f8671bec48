"""The report on paper: nothing is cut off at the edge of a page."""

import pytest

from report.browser.conftest import Opener

pytestmark = pytest.mark.slow

A4 = 688
"""CSS px between the margins of the stylesheet: (210 - 28) mm."""

BEYOND = """() => [...document.querySelectorAll("main *")]
  .filter((each) => each.getBoundingClientRect().right > innerWidth + 1)
  .map((each) => `${each.tagName} ${each.textContent.slice(0, 40)}`)"""


def test_nothing_is_wider_than_the_paper(opened: Opener) -> None:
    found = opened("bench8", viewport={"width": A4, "height": 970})
    assert found.page.evaluate(BEYOND) != []  # on the screen tables scroll
    found.page.emulate_media(media="print")
    assert found.page.evaluate(BEYOND) == []
