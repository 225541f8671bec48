"""The pieces of (2)-(9) at one state, as sums over bodies. SI, in E1 about O1 unless said otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from flint import arb_mat

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.rigorous.ball import column, cross, part, zeros
from mahovik.proof.rigorous.bodies import PlacedBody, Spinning, added_mass, fixed_bodies, flywheels
from mahovik.proof.rigorous.rotation import carrier_rotation
from mahovik.proof.rigorous.screw import ANGULAR, Phi, f, screw_of_parts, spin, transfer
from mahovik.proof.rigorous.stream import stream_at
from mahovik.proof.rigorous.twists import twist, twists
from mahovik.proof.rigorous.wrenches import external_wrenches


@dataclass(frozen=True, eq=False)
class Pieces:
    """Terms of the equations.

    held         whether the carrier is held
    L1           6x6: transfer from E1 to E0
    S            6xm: twists of a held carrier at unit speeds of its freedoms; None of a free or clamped carrier
    V, V_r       6: twist of E1 relative to E0, and to the fluid, V_r = V - (C^T u, 0)
    V_dot        6: the given derivative of the components of V
    drift        6: (omega x C^T u, 0), so that V* = V_r* - drift
    fixed        carrier and instruments
    flywheels    flywheels at their phases
    bodies       6x6: K without added mass
    Lambda       6x6: all added mass
    K, K_dot, M  6x6, (2), (6), (9); M at V_r
    I, J         6 by flywheel, (9); J at V_r
    P            wrench by body, 6 each, in the body's frame about its origin
    F            6, (7)
    """

    held: bool
    L1: arb_mat
    S: arb_mat | None
    V: arb_mat
    V_r: arb_mat
    V_dot: arb_mat
    drift: arb_mat
    fixed: tuple[PlacedBody, ...]
    flywheels: tuple[Spinning, ...]
    bodies: arb_mat
    Lambda: arb_mat
    K: arb_mat
    K_dot: arb_mat
    M: arb_mat
    I: tuple[arb_mat, ...]
    J: tuple[arb_mat, ...]
    P: Mapping[str, arb_mat]
    F: arb_mat

    @property
    def bias(self) -> arb_mat:
        """M V + sum_s J_s phi_s' (6; N, N m) of (8), at V_r."""
        return sum((J * s.phi_dot for J, s in zip(self.J, self.flywheels, strict=True)), self.M * self.V_r)


def pieces(stand: Stand, state: State) -> Pieces:
    """The pieces of `stand` at `state`, at the working precision. StateError where a law is undefined."""
    C = carrier_rotation(stand, state)
    u = C.transpose() * stream_at(stand, state.position)
    V = twist(stand, state.V, state.u)
    V_r = V - screw_of_parts(u, zeros(3))
    fixed, spinning = fixed_bodies(stand), flywheels(stand, state)
    everywhere = (*fixed, *spinning)
    e = spin()
    bodies = sum((k.L * k.Theta * k.L.transpose() for k in everywhere), zeros(6, 6))
    Lambda = added_mass(stand)
    K = bodies + Lambda
    K_dot = sum(
        (s.L * (e * s.Theta - s.Theta * e) * s.L.transpose() * s.phi_dot for s in spinning),
        zeros(6, 6),
    )
    P = external_wrenches(stand, state, C, V, V_r, everywhere)
    return Pieces(
        held=stand.hold is not None,
        L1=transfer(column(state.position), C),
        S=twists(stand),
        V=V,
        V_r=V_r,
        V_dot=twist(stand, state.V_dot, state.u_dot),
        drift=screw_of_parts(cross(part(V, ANGULAR)) * u, zeros(3)),
        fixed=fixed,
        flywheels=spinning,
        bodies=bodies,
        Lambda=Lambda,
        K=K,
        K_dot=K_dot,
        M=Phi(V_r) * K + K_dot,
        I=tuple(s.L * s.Theta * f() for s in spinning),
        J=tuple((Phi(V_r) * s.L + s.L * e * s.phi_dot) * s.Theta * f() for s in spinning),
        P=P,
        F=sum((k.L * P[k.body.name] for k in everywhere), zeros(6)),
    )
