"""Stands whose wheels are small for the drawn torques: right C is not refused, whatever the seed."""

from __future__ import annotations

import pytest

from mahovik.core.stand import Stand, loads
from mahovik.proof.verify.harness import verify_c
from mahovik.proof.verify.report import conclusion
from toolchain.quick import quick

WHEEL = """
[[flywheel]]
name = "{name}"
mass = "{mass}"
angles = {angles}
spin_inertia = "{spin}"
transverse_inertia = "{across}"
unbalance = {{ static = "{static}", static_at = "40 deg", dynamic = "{dynamic}" }}
motor = {{ torque = "0.5 mN m", speed = "8000 rpm" }}
"""


def small(carrier: str, count: int, **wheel: str) -> Stand:
    """A stand of `count` wheels of this kind on a carrier of this mass."""
    head = f'schema = 1\nname = "small"\ncarrier = {{ mass = "{carrier}", inertia = [0.0022, 0.0022, 0.0021] }}\n'
    angles = ("[0, 0]", "[1.5707963, 0]", "[0, -1.5707963]")
    return loads(head + "".join(WHEEL.format(name=f"w{i}", angles=angles[i], **wheel) for i in range(count)))


PICO = {"mass": "5 g", "spin": "0.9 g cm^2", "across": "0.5 g cm^2", "static": "0.1 g mm", "dynamic": "0 g mm^2"}
NANO = {"mass": "20 g", "spin": "12 g cm^2", "across": "7 g cm^2", "static": "0.2 g mm", "dynamic": "1 g mm^2"}
CASES = quick(1, [("1.3 kg", 1, PICO, 1), ("4 kg", 3, NANO, 2), ("1.3 kg", 1, PICO, 2), ("4 kg", 3, NANO, 5)])


@pytest.mark.slow
@pytest.mark.parametrize(("carrier", "count", "wheel", "seed"), CASES)
def test_right_c_passes(carrier: str, count: int, wheel: dict[str, str], seed: int) -> None:
    found = verify_c(small(carrier, count, **wheel), seed=seed, count=12)
    assert found.passed, conclusion(found)
