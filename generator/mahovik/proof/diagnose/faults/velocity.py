"""Faults in the velocity terms of (4)-(9): Phi K, K*, J phi'."""

from __future__ import annotations

import numpy as np

from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Spinning
from mahovik.proof.reference.screw import Phi, cross, f, spin


class NoRate(Fault):
    """K* is missing: the change of K as the flywheels turn."""

    name = "K* missing"
    equation = "(5), (6)"
    look = "K* V in (5): sum of Ls ([<e>] Theta_s - Theta_s [<e>]) Ls^T phi_s'"

    def wheel_rate(self, k: Spinning) -> Array:
        return np.zeros((6, 6))


class RateReversed(Fault):
    """K* has the wrong sign."""

    name = "K*, sign"
    equation = "(6)"
    look = "[<e>] Theta_s - Theta_s [<e>], in this order"

    def wheel_rate(self, k: Spinning) -> Array:
        return -super().wheel_rate(k)


class HalfRate(Fault):
    """Half of K* is missing: [<e>] Theta_s is there, - Theta_s [<e>] is not."""

    name = "second half of K* missing"
    equation = "(6)"
    look = "both factors of Ls Theta_s Ls^T turn: (6) has two terms"

    def wheel_rate(self, k: Spinning) -> Array:
        return np.asarray(k.L @ spin @ k.Theta @ k.L.T * k.phi_dot)


class OtherHalfRate(Fault):
    """Half of K* is missing: - Theta_s [<e>] is there, [<e>] Theta_s is not."""

    name = "first half of K* missing"
    equation = "(6)"
    look = "both factors of Ls Theta_s Ls^T turn: (6) has two terms"

    def wheel_rate(self, k: Spinning) -> Array:
        return np.asarray(-k.L @ k.Theta @ spin @ k.L.T * k.phi_dot)


class NotSquared(Fault):
    """phi' is not squared in the terms of unbalance: Ls [<e>] Theta_s f phi' instead of phi'^2."""

    name = "phi' not squared"
    equation = "(5)"
    look = "the last term of (5), which the print has without the square"

    def spinning(self, k: Spinning) -> Array:
        return np.asarray(k.L @ spin @ k.Theta @ f)


class NoSpinTerm(Fault):
    """The terms with phi'^2 are missing: the unbalance has no centripetal part."""

    name = "phi'^2 terms missing"
    equation = "(5), (9)"
    look = "Ls [<e>] phi' in J_s"

    def spinning(self, k: Spinning) -> Array:
        return np.zeros(6)


class SpinTermReversed(Fault):
    """The terms with phi'^2 have the wrong sign: the unbalance pulls inward where it should pull outward."""

    name = "phi'^2 terms, sign"
    equation = "(5), (9)"
    look = "the order of factors in <e> rc: it is e1 x rc"

    def spinning(self, k: Spinning) -> Array:
        return -super().spinning(k)


class NoGyroscopicCoupling(Fault):
    """The gyroscopic terms of the flywheels' own spin are missing: Phi Ls Theta_s f phi' of J_s."""

    name = "gyroscopic terms of spin missing"
    equation = "(9)"
    look = "omega x h of each flywheel in J_s"

    def turning(self, k: Spinning) -> Array:
        return np.zeros(6)


class GyroscopicCouplingReversed(Fault):
    """The gyroscopic terms of the flywheels' own spin have the wrong sign."""

    name = "gyroscopic terms of spin, sign"
    equation = "(9)"
    look = "omega x h, not h x omega, in J_s"

    def turning(self, k: Spinning) -> Array:
        return -super().turning(k)


class CouplingBiasReversed(Fault):
    """J phi' has the wrong sign as a whole."""

    name = "J phi', sign"
    equation = "(8), (9)"
    look = "J phi' stands on the left of (8)"

    def turning(self, k: Spinning) -> Array:
        return -super().turning(k)

    def spinning(self, k: Spinning) -> Array:
        return -super().spinning(k)


class NoCouplingBias(Fault):
    """J phi' is missing altogether."""

    name = "J phi' missing"
    equation = "(8), (9)"
    look = "the terms of phi' that do not come with K"

    def turning(self, k: Spinning) -> Array:
        return np.zeros(6)

    def spinning(self, k: Spinning) -> Array:
        return np.zeros(6)


class NoConvection(Fault):
    """Phi K is missing: V* is treated as if E1 did not turn."""

    name = "Phi K missing"
    equation = "(4), (9)"
    look = "Phi Z in (4): Z is written in axes that move"

    def convected(self, V: Array) -> Array:
        return np.zeros((6, 6))


class ConvectionReversed(Fault):
    """Phi K has the wrong sign."""

    name = "Phi K, sign"
    equation = "(4), (9)"
    look = "Phi Z stands on the left of (4): omega x p, v x p + omega x h"

    def convected(self, V: Array) -> Array:
        return -super().convected(V)


class NoVelocityMoment(Fault):
    """v x p is missing in Phi: the lower left block <v>."""

    name = "v x p missing"
    equation = "(4)"
    look = "Phi = [[<omega>, 0], [<v>, <omega>]]: O1 moves, so the moment of momentum has a term v x p"

    def Phi(self, V: Array) -> Array:
        found = Phi(V)
        found[3:, :3] = 0.0
        return found


class NoForceConvection(Fault):
    """omega x p is missing: V* is taken as the acceleration of O1, not as the derivative of components in E1."""

    name = "omega x p missing"
    equation = "(4)"
    look = "the upper left block <omega> of Phi in Phi K"

    def convected(self, V: Array) -> Array:
        found = Phi(V)
        found[:3, :3] = 0.0
        return found @ self.K


class NoMomentConvection(Fault):
    """omega x h is missing: the gyroscopic moment of the carrier with its flywheels locked."""

    name = "omega x h missing"
    equation = "(4)"
    look = "the lower right block <omega> of Phi in Phi K"

    def convected(self, V: Array) -> Array:
        found = Phi(V)
        found[3:, 3:] = 0.0
        return found @ self.K


class GyroscopicMomentReversed(Fault):
    """omega x h of the carrier has the wrong sign."""

    name = "omega x h, sign"
    equation = "(4)"
    look = "omega x h, not h x omega, in Phi K"

    def convected(self, V: Array) -> Array:
        found = Phi(V)
        found[3:, 3:] = cross(-V[3:])
        return found @ self.K


class ReactionReversed(Fault):
    """I phi'' has the wrong sign: the flywheels' acceleration pushes the carrier the wrong way."""

    name = "I phi'', sign"
    equation = "(8)"
    look = "I phi'' stands on the left of (8)"

    def reaction(self) -> Array:
        return -super().reaction()


class AccelerationUnused(Fault):
    """phi'' of the flywheels is not used."""

    name = "phi'' not used"
    equation = "(8)"
    look = "whether phi_ddot reaches the equations"

    def acceleration(self, s: object, phi_ddot: float) -> float:
        return 0.0


class ReactionMissing(Fault):
    """I phi'' is missing in the carrier's equation."""

    name = "I phi'' missing"
    equation = "(8)"
    look = "what accelerated flywheels do to the carrier"

    def reaction(self) -> Array:
        return np.zeros(6)
