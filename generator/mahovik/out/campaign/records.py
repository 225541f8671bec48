"""All that was observed of a block, for functions of the user: named arrays of one sample."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.out.campaign.observe import Chunk
from mahovik.out.campaign.pose import Array
from mahovik.out.campaign.signals import sensors

KEPT = ("t", "state", "V_dot", "phi_ddot", "tau", "readings", "loads")


class Records:
    """Arrays of all times of a block."""

    def __init__(self, stand: Stand) -> None:
        self._stand = stand
        self._kept: dict[str, list[Array]] = {name: [] for name in KEPT}
        self._whole: dict[str, Array] = {}

    def add(self, chunk: Chunk) -> None:
        """Keep a chunk."""
        for name in KEPT:
            self._kept[name].append(getattr(chunk, name).copy())

    def sample(self, j: int) -> dict[str, Any]:
        """The arrays of sample j, times first.

        t (T); position (T, 3), attitude (T, 4), V, V_dot (T, 6), phi, phi_dot, phi_ddot, tau (T, N): as in Python;
        `force NAME`, `gyro NAME` (T, 3): readings of instruments and points; `mount NAME` (T, 6): of flywheels.
        """
        if not self._whole:
            self._whole = {name: np.concatenate(parts) for name, parts in self._kept.items()}
        whole, N = self._whole, len(self._stand.flywheels)
        state = whole["state"][:, :, j]
        found = {
            "t": whole["t"], "position": state[:, :3], "attitude": state[:, 3:7], "V": state[:, 7:13],
            "phi": state[:, 13 : 13 + N], "phi_dot": state[:, 13 + N :],
            **{name: whole[name][:, :, j] for name in ("V_dot", "phi_ddot", "tau")},
        }  # fmt: skip
        for k, name in enumerate(sensors(self._stand)):
            own = whole["readings"][:, 24 * k : 24 * k + 24, j]
            found |= {f"force {name}": own[:, 18:21], f"gyro {name}": own[:, 15:18]}
        for s, wheel in enumerate(self._stand.flywheels):
            found[f"mount {wheel.name}"] = whole["loads"][:, 6 * s : 6 * s + 6, j]
        return {name: np.ascontiguousarray(values) for name, values in found.items()}
