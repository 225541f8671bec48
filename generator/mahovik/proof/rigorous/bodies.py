"""Each body in the carrier: its Theta, its transfer L to E1 about O1, its twist."""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb, arb_mat

from mahovik.core.stand.model import Body, Flywheel, Instrument, Stand
from mahovik.core.stand.state import State
from mahovik.proof.rigorous.ball import block, column, cross, identity, matrix, number, zeros
from mahovik.proof.rigorous.rotation import fixed_rotation, flywheel_rotation
from mahovik.proof.rigorous.screw import f, transfer


@dataclass(frozen=True, eq=False)
class PlacedBody:
    """A body, L (6x6) to E1 about O1, Theta (6x6) about its own origin."""

    body: Body
    L: arb_mat
    Theta: arb_mat

    def twist(self, V: arb_mat) -> arb_mat:
        """Lk^T V (6; m/s, rad/s), in its own frame."""
        return self.L.transpose() * V


@dataclass(frozen=True, eq=False)
class Spinning(PlacedBody):
    """A flywheel at its phase, with its speed phi_dot (rad/s) relative to its mount."""

    phi_dot: arb

    def twist(self, V: arb_mat) -> arb_mat:
        """Ls^T V + f phi_s' (6; m/s, rad/s), in Es."""
        return self.L.transpose() * V + f() * self.phi_dot


def spatial_inertia(body: Body) -> arb_mat:
    """Theta = [[m E, -m <rc>], [m <rc>, J]] (6x6), J about the frame's origin: J = Jc - m <rc> <rc>."""
    m, rc, J = number(body.mass), cross(column(body.center_of_mass)), matrix(body.inertia)
    if body.inertia_about == "center_of_mass":
        J = J - rc * rc * m
    return block([[identity(3) * m, -(rc * m)], [rc * m, J]])


def added_mass(stand: Stand) -> arb_mat:
    """Lambda_1 + sum_p Lambda_p (6x6), about O1 in E1."""
    given = (stand.carrier.added_mass, *(p.added_mass for p in stand.instruments))
    return sum((matrix(Lambda) for Lambda in given if Lambda is not None), zeros(6, 6))


def instrument_transfer(p: Instrument) -> arb_mat:
    """Lp (6x6)."""
    return transfer(column(p.position), fixed_rotation(p.angles))


def flywheel_transfer(stand: Stand, s: Flywheel, phi: float) -> arb_mat:
    """Ls (6x6) at the phase phi; on an instrument Ls = Lp L_{s in p}."""
    own = transfer(column(s.position), flywheel_rotation(s, phi))
    bearers = [p for p in stand.instruments if p.name == s.mount]
    return instrument_transfer(bearers[0]) * own if bearers else own


def fixed_bodies(stand: Stand) -> tuple[PlacedBody, ...]:
    """Carrier and instruments, in the file's order."""
    carrier = PlacedBody(stand.carrier, identity(6), spatial_inertia(stand.carrier))
    return (carrier, *(PlacedBody(p, instrument_transfer(p), spatial_inertia(p)) for p in stand.instruments))


def flywheels(stand: Stand, state: State) -> tuple[Spinning, ...]:
    """Flywheels at the phases and speeds of the state, in the file's order."""
    return tuple(
        Spinning(s, flywheel_transfer(stand, s, phi), spatial_inertia(s), number(phi_dot))
        for s, phi, phi_dot in zip(stand.flywheels, state.phi, state.phi_dot, strict=True)
    )
