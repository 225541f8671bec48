"""Draw the random stands of the net once: `python tests/net/draw.py` writes tests/net/stands/*.toml.

The files are kept, so that the net does not move when the generator of random stands does. Every law, kind of hold,
run-time input and task stands in some of them.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from mahovik.core.stand import Stand, dumps, loads
from mahovik.core.stand.random import BARE, EVERYTHING, SEQUENCES, Features, random_stand
from mahovik.proof.verify.backends import with_all_inputs

STANDS = Path(__file__).parent / "stands"
COUNTS = (3, 1, 6, 2, 0, 7, 5, 8, 12, 4)
"""Flywheels, in turn."""

FREE = 36
"""Number of free stands; the others are held."""

PROFILE = 25
"""Number of the stand in a current that changes with depth."""

CURRENT = "[stream_profile]\ndepth = [0, 10, 50]\nvelocity = [[0.5, 0, 0], [0.2, 0.1, 0], [0, 0, 0]]\n"

KINDS = (Features(), EVERYTHING, Features(), BARE)

POSE = "pivot = [0.1, -0.2, 0.3]\nposition = [0.3, 0.1, 0.2]\nangles = [0.1, 0.2, 0.3]\n"
HOLDS = (
    "freedoms = []\n",
    'freedoms = ["pitch"]\n' + POSE,
    'freedoms = ["x"]\n',
    "axis = [1, 2, 4]\n" + POSE,
    "slide = [1, -2, 2]\n",
    'freedoms = ["x", "z", "pitch"]\n' + POSE,
    'freedoms = ["roll", "pitch", "yaw"]\n' + POSE,
    "basis = [[1, 0.2, 0, 0, 0, 1], [0, 1, 1, 0.3, 0, 0]]\n",
)
FRICTION = "[[hold.friction]]\nviscous = 0.4\ncoulomb = 0.3\nbreakaway = 0.5\nstribeck_speed = 0.2\nsmoothing = 0.01\n"
STOPS = "[[hold.stop]]\nat = 0.5\nstiffness = 900.0\ndamping = 40.0\n[[hold.stop]]\nat = -0.4\nstiffness = 900.0\n"


def stand_of(number: int) -> Stand:
    """The stand of this number."""
    features = replace(KINDS[number % 4], angles=SEQUENCES[number % 3], flow=number % 5 == 0)
    stand = random_stand(np.random.default_rng(9000 + number), COUNTS[number % 10], features, f"random{number:02}")
    if number == PROFILE:
        return loads(dumps(replace(stand, stream=None)) + CURRENT)
    if number < FREE:
        return with_all_inputs(stand) if number % 3 == 0 else stand
    kind = HOLDS[number % 8]
    ends = FRICTION + STOPS if kind.startswith(("axis", "slide")) or kind in HOLDS[1:3] else ""
    return loads(f"{dumps(replace(stand, tasks=()))}\n[hold]\n{kind}{ends}")


if __name__ == "__main__":
    STANDS.mkdir(exist_ok=True)
    for k in range(60):
        text = dumps(stand_of(k))
        assert dumps(loads(text)) == text
        (STANDS / f"random{k:02}.toml").write_text(text, encoding="utf-8", newline="\n")
