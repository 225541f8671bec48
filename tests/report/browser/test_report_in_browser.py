"""The report in the hands of a reader: opened from a file, in a browser, on a phone, in the dark, on paper."""

from typing import Any

import pytest

from .chromium import Opened
from .conftest import Opener

pytestmark = pytest.mark.slow

REDUCED: dict[str, Any] = {"reduced_motion": "reduce"}
STAGE = "document.activeElement === document.getElementById('stage')"


@pytest.fixture
def still(opened: Opener) -> Opened:
    """The whole report of bench8, its animation in sight and paused."""
    found = opened("bench8", **REDUCED)
    found.show()
    return found


@pytest.mark.parametrize("name", ["bench8", "demo3", "none", "many"])
def test_no_errors_and_no_requests(opened: Opener, name: str) -> None:
    """Nothing is loaded but the file, and the browser reports no error."""
    found = opened(name)
    found.show()
    found.picture()
    assert found.complaints == []
    assert found.requests == [found.address]


def test_it_plays_by_itself_and_pauses(opened: Opener) -> None:
    """Pictures differ while it plays, not while it is paused; the clock goes on and the button says what it does."""
    found = opened("bench8")
    found.show()
    found.wait_until("document.getElementById('play').textContent === 'Pause'")
    first, begun = found.picture(), found.text("#clock")
    found.wait_until(f"document.getElementById('clock').textContent !== {begun!r}")
    found.changed(first)
    found.page.get_by_role("button", name="Pause the animation").click()
    first = found.picture()
    found.page.wait_for_timeout(120)
    assert found.picture() == first
    found.page.get_by_role("button", name="Play the animation").click()
    found.changed(first)
    assert found.text("#play") == "Pause"


def test_reduced_motion_starts_paused(still: Opened) -> None:
    """A reader who asks the system for less motion sees none before starting it."""
    first = still.picture()
    still.page.wait_for_timeout(120)
    assert still.picture() == first
    assert still.text("#play") == "Play"


def test_scrubbing_sets_the_time(still: Opened) -> None:
    """The slider moves to a time; its picture is the same whenever it is asked for."""
    pictures = []
    for value in ("0.25", "0.5", "0.25"):
        still.page.locator("#scrub").fill(value)
        pictures.append(still.picture())
    assert pictures[0] == pictures[2] != pictures[1]
    assert still.text("#clock").startswith("0.1000 s")


def test_keys_change_the_picture(still: Opened) -> None:
    """The canvas is used by the keyboard: 0 sets the view back, a comma takes back a full stop, Space plays."""
    still.page.locator("#stage").focus()
    first, keyboard = still.picture(), still.page.keyboard
    seen = {first}
    for key, back in (*((k, "0") for k in ("ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "+", "-")), (".", ",")):
        keyboard.press(key)
        seen.add(still.picture())
        keyboard.press(back)
        assert still.picture() == first
    assert len(seen) == 8
    keyboard.press("Space")
    still.wait_until("document.getElementById('play').textContent === 'Pause'")
    keyboard.press("Space")
    assert still.text("#play") == "Play"


def test_dragging_turns_the_view(still: Opened) -> None:
    """The pointer may be a mouse or a finger."""
    box, first = still.box("#stage"), still.picture()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    still.page.mouse.move(x, y)
    still.page.mouse.down()
    still.page.mouse.move(x + 80, y + 30, steps=4)
    still.page.mouse.up()
    turned = still.changed(first)
    still.page.mouse.move(x - 80, y)
    assert still.picture() == turned
    still.page.locator("[data-view=aslant]").click()
    assert still.picture() == first


def test_wheel_zooms_the_chosen_picture_and_scrolls_the_page_otherwise(still: Opened) -> None:
    """A reader who scrolls past the animation is not caught by it."""
    box, first = still.box("#stage"), still.picture()
    still.page.mouse.move(box["x"] + 50, box["y"] + 50)
    still.page.mouse.wheel(0, -40)
    still.page.wait_for_timeout(120)
    assert still.picture() == first
    still.show()
    still.page.locator("#stage").focus()
    still.page.mouse.wheel(0, -40)
    still.changed(first)


def test_a_finger_turns_the_view(opened: Opener) -> None:
    """Sideways; up and down it scrolls the page, which would be caught otherwise."""
    found = opened("bench8", has_touch=True, is_mobile=True, viewport={"width": 400, "height": 800}, **REDUCED)
    found.show()
    box, first = found.box("#stage"), found.picture()
    touch = found.context.new_cdp_session(found.page)
    x, y = box["x"] + 100, box["y"] + 100
    for kind, dx in (("touchStart", 0), ("touchMove", 30), ("touchMove", 60), ("touchMove", 90)):
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x + dx, "y": y}]})
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    found.changed(first)


def test_fine_screens_have_fine_pictures(opened: Opener) -> None:
    """The canvas has as many pixels as the screen shows."""
    found = opened("demo3", device_scale_factor=2, **REDUCED)
    found.show()
    found.picture()
    shown, drawn = found.page.evaluate(
        "(c => [c.getBoundingClientRect().width, c.width])(document.getElementById('stage'))"
    )
    assert drawn == round(2 * shown)


def test_views_magnification_and_trace_change_the_picture(still: Opened) -> None:
    """Each control does something, and the magnification is written beside its slider."""
    page = still.page
    seen = [still.picture()]
    for view in ("front", "top", "side"):
        page.locator(f"[data-view={view}]").click()
        seen.append(still.picture())
    page.locator("#scrub").fill("0.6")
    page.locator("#magnify").fill("0")
    assert still.text("#magnified") == "× 1"
    seen.append(still.picture())
    page.locator("#magnify").fill("6")
    assert still.text("#magnified") == "× 100"
    seen.append(still.picture())
    page.locator("#trace").select_option("-1")
    seen.append(still.picture())
    assert len(set(seen)) == len(seen)


def test_small_motion_is_magnified_from_the_start(still: Opened) -> None:
    """Tens of micrometres are not seen on a stand of decimetres."""
    assert int(still.text("#magnified").removeprefix("× ")) > 100


INK = "getComputedStyle(document.querySelector('svg.drawing text')).fill"


def test_dark_mode_changes_page_and_picture(still: Opened) -> None:
    """The button changes the theme, and the canvas follows the page."""
    first, ink = still.picture(), still.page.evaluate(INK)
    still.page.locator("#theme").click()
    assert still.picture() != first
    assert still.page.evaluate(INK) != ink
    still.page.locator("#theme").click()
    assert still.picture() == first


def test_dark_mode_follows_the_system(opened: Opener) -> None:
    """The page follows the theme of the system, also when that changes."""
    found = opened("demo3", color_scheme="dark", **REDUCED)
    found.show()
    dark = found.picture()
    found.page.emulate_media(color_scheme="light")
    assert found.picture() != dark


@pytest.mark.parametrize("width", [320, 400])
def test_narrow_pages_do_not_overflow(opened: Opener, width: int) -> None:
    """On a phone what is wide scrolls in its own frame."""
    found = opened("bench8", viewport={"width": width, "height": 800}, **REDUCED)
    assert found.page.evaluate("document.scrollingElement.scrollWidth") <= width


def test_paper_shows_everything_but_controls(opened: Opener) -> None:
    """In print colours, dark or not; parts that are closed on screen are opened, buttons are left out."""
    found = opened("bench8", color_scheme="dark", **REDUCED)
    found.show()
    dark = found.picture()
    found.page.emulate_media(media="print", color_scheme="dark")
    assert found.picture() != dark
    assert found.page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert found.page.evaluate("[...document.querySelectorAll('main > section')].every((s) => s.offsetHeight > 60)")
    assert not found.page.locator("#play").is_visible()
    assert found.page.locator("#stage").is_visible()
    found.page.pdf()
    assert found.page.evaluate("[...document.querySelectorAll('details')].every((each) => each.open)")


def test_every_control_has_a_name(still: Opened) -> None:
    """For readers who hear the page."""
    nameless = still.page.evaluate(
        """[...document.querySelectorAll("button, input, select, canvas")].filter((each) =>
           !(each.textContent.trim() || each.getAttribute("aria-label") || (each.labels && each.labels.length)))
           .map((each) => each.outerHTML)"""
    )
    assert nameless == []


def test_focus_is_seen(still: Opened) -> None:
    """The canvas comes in the order of tabs, before the button that plays it, with a ring."""
    still.page.locator("#play").focus()
    still.page.keyboard.press("Shift+Tab")
    assert still.page.evaluate(STAGE)
    assert still.page.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"
