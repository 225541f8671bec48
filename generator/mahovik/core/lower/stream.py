"""The stream where the carrier is, by the depth of O1."""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.library import Library, unit_square
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import OK, RANGE, Reals, reals, result
from mahovik.core.program.vector import dot


def add_functions(lib: Library) -> None:
    """The stream by depth, and the check of the depth, where the stand has a profile.

    Stations increase and `down` has length one, within 1e-3 of its square. The velocity at O1 is in the range of a
    stream, and a shear in that of an angular velocity, so that no product overflows.
    """
    last = lib.layout.structure.stream_stations - 1
    if last < 0:
        return

    @lib.kernel()
    def stream_at(
        table: Any = lib.table, x: Any = lib.x, u: Reals = result("velocity of the fluid, in E0", 3, unit="m/s")
    ) -> None:
        """Velocity of the fluid at the depth of O1."""
        profile = table.stream_profile
        depth = dot(profile.down, x.position)
        u[:] = table.stream + profile.top
        for k in range(last):
            thick = profile.depth[k + 1] - profile.depth[k]
            above = reals()  # part of the layer that is above O1
            above = depth - profile.depth[k]
            above = above if above > 0 else 0.0
            above = above if above < thick else thick
            u += profile.shear[k] * above

    @lib.kernel()
    def check_depth(table: Any = lib.table, x: Any = lib.x) -> Status:
        """Is the profile of the stream in its ranges, and the depth of O1 within it?"""
        profile, within = table.stream_profile, lib["within"]
        within(profile.down, 3, 2)
        down2 = dot(profile.down, profile.down)
        if not unit_square(down2):
            return RANGE
        within(profile.depth, last + 1, lib.limit("MAX_POSITION"))
        within(profile.top, 3, lib.limit("MAX_VELOCITY"))
        for k in range(last):
            if not (profile.depth[k + 1] > profile.depth[k]):
                return RANGE
            within(profile.shear[k], 3, lib.limit("MAX_SPEED"))
        depth = dot(profile.down, x.position)
        if not (depth >= profile.depth[0] and depth <= profile.depth[last]):
            return RANGE
        flow = reals(3)  # stream in E0, at this depth
        stream_at(table, x, flow)
        within(flow, 3, lib.limit("MAX_VELOCITY"))
        return OK
