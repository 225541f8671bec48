"""Faults in the stream: its sign, its axes, its turning in E1, its profile by depth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Stand, StreamProfile
from mahovik.proof.diagnose.edits import pieces, stand, vector
from mahovik.proof.diagnose.fault import Case, Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pieces import Pieces

ByDepth = Callable[[StreamProfile, float], Array]
"""Velocity (3; m/s, in E0) that a wrong program takes from a profile at a depth (m)."""


def drives_at_V_r(at: Pieces, case: Case) -> Pieces:
    """The pieces with V_r for V where flywheels are concerned."""
    return replace(at, V=at.V_r) if case.want in ("torque", "mounts") else at


def instead_of_profile(velocity: ByDepth) -> Edit:
    """Edit of the stream: this velocity instead of that between two stations, where the profile has the depth."""

    def edit(right: Stand, case: Case) -> Stand:
        profile = right.profile
        if profile is None:
            return right
        depth = float(np.array(profile.down) @ np.array(case.state.position) / np.linalg.norm(profile.down))
        if not profile.depth[0] <= depth <= profile.depth[-1]:
            return right
        u = np.array(right.stream or (0.0, 0.0, 0.0)) + velocity(profile, depth)
        return replace(right, stream=tuple(u.tolist()), profile=None)

    return Edit("stand", edit)


def nearest(profile: StreamProfile, depth: float) -> Array:
    """Velocity of the nearest station."""
    return np.array(profile.velocity[int(np.abs(np.array(profile.depth) - depth).argmin())])


def above(profile: StreamProfile, depth: float) -> Array:
    """Velocity of the last station that is not deeper."""
    return np.array(profile.velocity[int(np.searchsorted(profile.depth, depth, side="right")) - 1])


def mean(profile: StreamProfile, depth: float) -> Array:
    """Mean over all depths."""
    stations, velocity = np.array(profile.depth), np.array(profile.velocity)
    layers = np.diff(stations)[:, None] * (velocity[1:] + velocity[:-1]) / 2
    return np.asarray(layers.sum(axis=0) / (stations[-1] - stations[0]))


STEADY_IN_E1 = pieces(lambda at: replace(at, u=np.zeros(3)))
"""No turning of the stream in E1: V* for V_r*."""
# fmt: off
PROFILE_FAULTS = (
    Fault("stream profile, nearest station", "V_r", "all", [instead_of_profile(nearest)],
          "The stream is that of the nearest station of its profile, not linear between two",
          "`stream_profile`: linear by depth between stations"),
    Fault("stream profile, station above", "V_r", "all", [instead_of_profile(above)],
          "The stream is that of the station above, constant down to the next one, not linear between two",
          "`stream_profile`: linear by depth between stations"),
    Fault("stream profile, first station", "V_r", "all", [instead_of_profile(lambda profile, depth: nearest(profile,
          profile.depth[0]))],
          "The profile of the stream is ignored: its velocity is that of the first station at all depths",
          "`stream_profile`: the depth of O1"),
    Fault("stream profile, mean", "V_r", "all", [instead_of_profile(mean)],
          "The profile of the stream is ignored: its velocity is the mean over the depth everywhere",
          "`stream_profile`: the depth of O1"),
)
STREAM_FAULTS = (
    Fault("stream ignored", "V_r", "all", [stand(stream=None, profile=None)],
          "The stream is ignored",
          "V_r = V - (C^T u, 0) in M, J and damping"),
    Fault("stream, sign", "V_r", "all", [vector("stream", lambda u, C: -u)],
          "The stream flows the other way",
          "V_r = V - (C^T u, 0); u is where the fluid goes to"),
    Fault("stream not turned into E1", "V_r", "all", [vector("stream", lambda u, C: C @ u)],
          "The stream is not turned into the carrier's axes",
          "C^T u"),
    Fault("omega x u missing, drives too", "V_r*", "all", [STEADY_IN_E1, Edit("pieces", drives_at_V_r)],
          "The turning of the stream in E1 is ignored in the flywheels' equations too: V* is taken for V_r*",
          "V* = V_r* - (omega x C^T u, 0), wherever V_r stands for V"),
    Fault("omega x u missing", "V_r*", "all", [STEADY_IN_E1],
          "The turning of the stream in E1 is ignored in the carrier's equation: V* is taken for V_r*",
          "V* = V_r* - (omega x C^T u, 0)"),
)
