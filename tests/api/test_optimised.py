"""Libraries of the Python interface as users get them have the bits of those that the other tests build."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from api.models import stand
from mahovik.core.toolchain import arrays
from mahovik.out.api.model import Model, build
from toolchain.build_cache import SHIPPED

COUNT = 9
"""States: a group of lanes, and one more."""


def answers(model: Model) -> dict[str, bytes]:
    """Bits of the results, for equal states, of functions with and without tables of each stand."""
    rng, n = np.random.default_rng(3), len(model.flywheels)
    x = model.states(
        COUNT,
        V=rng.normal(size=(COUNT, 6)),
        phi=rng.normal(size=(COUNT, n)),
        phi_dot=rng.normal(size=(COUNT, n)) * 50.0,
    )
    tau = rng.normal(size=(COUNT, n)) * 0.1
    tables = model.tables({"carrier.mass": np.linspace(1.0, 1.1, COUNT) * model.stand.carrier.mass})
    found = {
        "coupled": model.coupled(x, tau)["V_dot"],
        "step": model.step(x, 1e-4, tau).array,
        "tables": model.coupled(x, tau, tables=tables)["V_dot"],
    }
    return {name: values.tobytes() for name, values in found.items()}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["demo3", "general"])
def test_optimisation_changes_no_bit(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = answers(build(stand(name)))
    monkeypatch.setenv("MAHOVIK_CACHE", str(tmp_path))  # where no library lies yet
    for flags, value in SHIPPED.items():
        monkeypatch.setattr(arrays, flags, value)
    assert answers(build(stand(name))) == expected
