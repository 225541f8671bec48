"""The stream of a stand where only a uniform one can be taken."""

from __future__ import annotations

from mahovik.core.stand.model import Stand, Vec3
from mahovik.errors import StandError


def uniform_stream(stand: Stand) -> Vec3:
    """u (m/s) in E0, zero without a stream. StandError where it changes with depth."""
    if stand.profile is not None:
        raise StandError(
            [
                f"stand {stand.name}: stream_profile: found a stream that changes with depth, expected a uniform one: "
                "write its velocity at the depth that matters as `stream`, without [stream_profile]"
            ]
        )
    return stand.stream or (0.0, 0.0, 0.0)
