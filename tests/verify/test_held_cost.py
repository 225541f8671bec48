"""Instructions of `forward` of held carriers beside that of the free one, of the same three flywheels."""

from __future__ import annotations

import pytest
from held_cost import instructions

from toolchain.tools import require


@pytest.mark.slow
def test_few_freedoms_take_fewer_instructions() -> None:
    require("valgrind", "valgrind")
    require("gcc", "gcc")
    free, hinge, pivot = (instructions(name)["forward"] for name in ("free", "hinge", "pivot"))
    assert hinge <= 0.55 * free
    assert pivot <= 0.80 * free
