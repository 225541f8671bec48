"""States at which one motor decides `EXCESSIVE`: `judge` finds a wrong number of any motor by them."""

from __future__ import annotations

import pytest

from mahovik.core.stand import loads
from mahovik.core.stand.model import Stand
from mahovik.proof import reference
from mahovik.proof.verify.compare import ordinary
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.motors import motor_states
from mahovik.proof.verify.scales import Scales
from mahovik.stands import path

SATELLITE, EXCITERS = (path(name).read_text(encoding="utf-8") for name in ("sat4", "two_exciters"))


def statuses(stand: Stand, other: Stand) -> dict[str, str]:
    """Status of another stand at the states of one."""
    drawn = motor_states(stand, Scales(stand), ordinary(draw(stand, 1, 6), 4))
    return {name: reference.evaluate(other, state, ("inverse",))["status"] for name, state in drawn}


@pytest.mark.parametrize(
    ("text", "right", "wrong", "at"),
    [
        (SATELLITE, "torque = 0.2,", "torque = 0.15,", "motor of rw1 driving at 0 rad/s, within"),
        (SATELLITE, '"6000 rpm"', '"5000 rpm"', "motor of rw1 driving at 314.159 rad/s, within"),
        (SATELLITE, "coulomb = 5e-4", "coulomb = 6e-4", "motor of rw1 driving at 0.3 rad/s, within"),
        (EXCITERS, "[900, 1.973]", "[900, 1.963]", "motor of a driving at 94.2478 rad/s, within"),
    ],
)
def test_a_wrong_number_of_a_motor_changes_a_status(text: str, right: str, wrong: str, at: str) -> None:
    stand = loads(text)
    expected, found_there = statuses(stand, stand), statuses(stand, loads(text.replace(right, wrong, 1)))
    assert {"EXCESSIVE" in status for status in expected.values()} == {False, True}
    assert f"{at} its limit" in {name for name, status in found_there.items() if status != expected[name]}
