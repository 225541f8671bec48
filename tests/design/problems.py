"""Design problems for the tests: the shaker's flywheels, which stand where they should not."""

from __future__ import annotations

from dataclasses import replace

from mahovik import stands
from mahovik.core.motion.required import RequiredMotion, load_motion
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.use.design.freedom import Freedom
from mahovik.use.design.read import read_freedom

FREE = """
schema = 1
speed = [-1, 1]
harmonics = 1
quality = 1e-9
[[free]]
position = { min = ["-80 mm", "-80 mm", "-80 mm"], max = ["80 mm", "80 mm", "80 mm"] }
angles = { min = ["-20 deg", "-20 deg"], max = ["20 deg", "20 deg"] }
unbalance = { min = 0, max = "3 kg mm" }
[limits]
distance = "100 mm"
"""


def shaker() -> Stand:
    """shaker2 with its flywheels out of place."""
    stand = load(stands.path("shaker2"))
    places = ((0.03, 0.06, 0.01), (-0.02, -0.07, 0.02))
    wheels = tuple(replace(w, position=p) for w, p in zip(stand.flywheels, places, strict=True))
    return replace(stand, flywheels=wheels)


def motion_of(stand: Stand) -> RequiredMotion:
    """0.3 mm along z at 20 Hz."""
    return load_motion(stands.path("shaker2").with_name("shaker2.motion.json"), stand)


def freedom(text: str = FREE, **changes: str) -> Freedom:
    """Free numbers of the shaker, with words of FREE changed."""
    for old, new in changes.items():
        text = text.replace(old, new)
    return read_freedom(text, shaker())
