"""Faults in the fluid: added mass, damping, stream."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np

from mahovik.core.stand.model import Body, Carrier, Instrument
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Placed, Spinning
from mahovik.proof.reference.screw import Phi, force_at
from mahovik.proof.reference.wrenches import linear_damping, quadratic_damping

AnyBody = TypeVar("AnyBody", bound=Body)


class NoAddedMass(Fault):
    """Added mass is missing altogether."""

    name = "added mass missing"
    equation = "(2)"
    look = "Lambda_1 + sum of Lambda_p in K"

    def fluid(self, body: Carrier | Instrument) -> Array:
        return np.zeros((6, 6))


class NoAddedMassOfInstruments(Fault):
    """The added mass of the instruments is missing; that of the carrier is there."""

    name = "added mass of instruments missing"
    equation = "(2)"
    look = "sum of Lambda_p in K"

    def fluid(self, body: Carrier | Instrument) -> Array:
        return np.zeros((6, 6)) if isinstance(body, Instrument) else super().fluid(body)


class AddedMassInOwnAxes(Fault):
    """The added mass of the instruments is taken in their own frame, and carried to O1 once too often."""

    name = "added mass of instruments in their axes"
    equation = "(2)"
    look = "Lambda_p is about O1 in E1, for an instrument as well"

    def fluid(self, body: Carrier | Instrument) -> Array:
        L = self.fixed_transfer(body)
        return L @ super().fluid(body) @ L.T


class NoAddedMassInPhiK(Fault):
    """Added mass is missing in Phi K: its Coriolis and Munk terms are not there; K has it."""

    name = "added mass missing in Phi K"
    equation = "(9)"
    look = "M = Phi K + K* with the whole K"

    def convected(self, V: Array) -> Array:
        return super().convected(V) - self.Phi(V) @ self.Lambda


class AddedMassReversedInPhiK(Fault):
    """The Coriolis terms of added mass have the wrong sign."""

    name = "Coriolis terms of added mass, sign"
    equation = "(9)"
    look = "Phi Lambda V_r on the left of (8)"

    def convected(self, V: Array) -> Array:
        return super().convected(V) - 2 * self.Phi(V) @ self.Lambda


class AddedMassOnlyInPhiK(Fault):
    """Added mass is missing in K V*: its Coriolis terms are there, its inertia is not."""

    name = "added mass missing before V*"
    equation = "(8)"
    look = "K before V* with Lambda"

    def mass_matrix(self) -> Array:
        return self.K_bodies

    def convected(self, V: Array) -> Array:
        return self.Phi(V) @ (self.K_bodies + self.Lambda)


class NoMunkMoment(Fault):
    """The Munk moment is missing: v x p of the added mass."""

    name = "Munk moment missing"
    equation = "(4), (9)"
    look = "the block <v> of Phi, times Lambda"

    def convected(self, V: Array) -> Array:
        lower = Phi(V)
        lower[:3] = 0.0
        lower[3:, 3:] = 0.0
        return super().convected(V) - lower @ self.Lambda


class DiagonalAddedMass(Fault):
    """Of the added mass only the diagonal is used."""

    name = "added mass only diagonal"
    equation = "(2)"
    look = "the off-diagonal elements of Lambda"

    def fluid(self, body: Carrier | Instrument) -> Array:
        return np.diag(np.diag(super().fluid(body)))


class AddedMassUncoupled(Fault):
    """The blocks of added mass that couple translation and rotation have the wrong sign."""

    name = "coupling of added mass, sign"
    equation = "(2)"
    look = "the off-diagonal blocks of Lambda: linear part first, about O1"

    def fluid(self, body: Carrier | Instrument) -> Array:
        found = super().fluid(body).copy()
        found[:3, 3:] *= -1.0
        found[3:, :3] *= -1.0
        return found


class AddedMassHasWeight(Fault):
    """Added mass is given weight."""

    name = "added mass with weight"
    equation = "(7)"
    look = "added mass is in K and Phi K only, never in the weight"
    bodies = "fixed"

    def weight(self, body: Body, gravity: Array) -> Array:
        P = super().weight(body, gravity)
        if not isinstance(body, Carrier | Instrument) or body.added_mass is None:
            return P
        return P + force_at(np.trace(np.array(body.added_mass)[:3, :3]) / 3 * gravity, np.zeros(3))


class DampingReversed(Fault):
    """Damping has the wrong sign: it drives."""

    name = "damping, sign"
    equation = "(7)"
    look = "wrench -(linear V_r), -(quadratic (V_r |V_r|)), + terms"
    bodies = "all"

    def damping(self, k: Placed, V_r: Array) -> Array:
        return -super().damping(k, V_r)


class NoLinearDamping(Fault):
    """Linear damping is missing."""

    name = "linear damping missing"
    equation = "(7)"
    look = "`linear` of `damping`"
    bodies = "all"

    def damping(self, k: Placed, V_r: Array) -> Array:
        P = super().damping(k, V_r)
        return P if k.body.damping is None else P - linear_damping(k.body.damping, V_r)


class NoQuadraticDamping(Fault):
    """Quadratic damping is missing."""

    name = "quadratic damping missing"
    equation = "(7)"
    look = "`quadratic` of `damping`"
    bodies = "all"

    def damping(self, k: Placed, V_r: Array) -> Array:
        P = super().damping(k, V_r)
        return P if k.body.damping is None else P - quadratic_damping(k.body.damping, V_r)


class QuadraticWithoutSign(Fault):
    """Quadratic damping takes V^2 instead of V |V|: it does not follow the direction of motion."""

    name = "quadratic damping without |V|"
    equation = "(7)"
    look = "V_r |V_r|, element by element"
    bodies = "all"

    def damping(self, k: Placed, V_r: Array) -> Array:
        P = super().damping(k, V_r)
        if k.body.damping is None or k.body.damping.quadratic is None:
            return P
        wrong = -np.array(k.body.damping.quadratic) @ (V_r * V_r)
        return P - quadratic_damping(k.body.damping, V_r) + wrong


class NoDampingTerms(Fault):
    """The hydrodynamic derivatives (`terms` of `damping`) are missing."""

    name = "damping terms missing"
    equation = "(7)"
    look = "`terms` of `damping`"
    bodies = "all"

    def read_body(self, body: AnyBody) -> AnyBody:
        read = super().read_body(body)
        return read if read.damping is None else replace(read, damping=replace(read.damping, terms=()))


class DampingTermsReversed(Fault):
    """The hydrodynamic derivatives (`terms` of `damping`) have the wrong sign."""

    name = "damping terms, sign"
    equation = "(7)"
    look = "`terms` are added as published: wrench += value * product"
    bodies = "all"

    def read_body(self, body: AnyBody) -> AnyBody:
        read = super().read_body(body)
        if read.damping is None:
            return read
        terms = tuple(replace(term, value=-term.value) for term in read.damping.terms)
        return replace(read, damping=replace(read.damping, terms=terms))


class WheelDampingWithoutSpin(Fault):
    """The damping of the flywheels takes the twist of their mount: without f phi'."""

    name = "flywheel damping without phi'"
    equation = "(7)"
    look = "V_s = Ls^T V + f phi'"

    def twist_in_fluid(self, k: Placed) -> Array:
        return np.asarray(k.L.T @ self.V_r)


class DampingAboutO1(Fault):
    """Damping of instruments and flywheels takes the twist of O1, not of their own origin."""

    name = "damping with the velocity of O1"
    equation = "(7)"
    look = "V_k = L^T V with <O> in L"
    bodies = "all"

    def twist_in_fluid(self, k: Placed) -> Array:
        V = super().twist_in_fluid(k)
        C = k.L[:3, :3]
        return np.concatenate([C.T @ self.V_r[:3], V[3:]])


class DampingIgnoresStream(Fault):
    """Damping ignores the stream: it takes the twist relative to E0."""

    name = "stream ignored in damping"
    equation = "(7)"
    look = "damping takes V_r = V - (C^T u, 0)"
    bodies = "all"

    def twist_in_fluid(self, k: Placed) -> Array:
        return k.twist(self.V)


class NoStream(Fault):
    """The stream is ignored."""

    name = "stream ignored"
    equation = "V_r"
    look = "V_r = V - (C^T u, 0) in M, J and damping"

    def stream(self) -> Array:
        return np.zeros(3)


class StreamReversed(Fault):
    """The stream flows the other way."""

    name = "stream, sign"
    equation = "V_r"
    look = "V_r = V - (C^T u, 0); u is where the fluid goes to"

    def stream(self) -> Array:
        return -super().stream()


class StreamNotTurned(Fault):
    """The stream is not turned into the carrier's axes."""

    name = "stream not turned into E1"
    equation = "V_r"
    look = "C^T u"

    def stream(self) -> Array:
        return np.array(self.stand.stream or (0.0, 0.0, 0.0))


class StreamRateIgnoredEverywhere(Fault):
    """The turning of the stream in E1 is ignored in the flywheels' equations too: V* is taken for V_r*."""

    name = "omega x u missing, drives too"
    equation = "V_r*"
    look = "V* = V_r* - (omega x C^T u, 0), wherever V_r stands for V"

    def stream_rate(self) -> Array:
        return np.zeros(6)

    def load(self, k: Spinning, phi_ddot: float) -> Array:
        return self.on_flywheel(k, self.V_r, self.given_V_dot(), phi_ddot)


class StreamRateIgnored(Fault):
    """The turning of the stream in E1 is ignored in the carrier's equation: V* is taken for V_r*."""

    name = "omega x u missing"
    equation = "V_r*"
    look = "V* = V_r* - (omega x C^T u, 0)"

    def stream_rate(self) -> Array:
        return np.zeros(6)
