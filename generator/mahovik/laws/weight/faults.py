"""Faults in gravity and weight, (7)."""

from __future__ import annotations

from mahovik.proof.diagnose.edits import FORCE, MOMENT, stand, vector, without_moment, wrench, zero
from mahovik.proof.diagnose.fault import Fault

# fmt: off
FAULTS = (
    Fault("gravity, sign", "(7)", "all", [vector("gravity", lambda g, C: -g)],
          "Gravity has the wrong sign",
          "`gravity` is the acceleration of free fall in E0, third component -9.81 where z is up"),
    Fault("gravity ignored", "(7)", "all", [stand(gravity=(0.0, 0.0, 0.0))],
          "Gravity is ignored",
          "`gravity` of the stand file"),
    Fault("gravity not turned into E1", "(7)", "all", [vector("gravity", lambda g, C: C @ g)],
          "Gravity is not turned into the carrier's axes: it always has its components of E0",
          "C^T g"),
    Fault("gravity turned by C", "(7)", "all", [vector("gravity", lambda g, C: C @ C @ g)],
          "Gravity is turned by C where C^T is right",
          "C^T g: C carries from E1 to E0"),
    Fault("weight of flywheels missing", "(7)", "flywheels", [wrench(zero, "weight")],
          "The weight of the flywheels is missing",
          "the weight of every body, flywheels too"),
    Fault("weight at the hub", "(7)", "flywheels", [wrench(without_moment, "weight")],
          "The weight of the flywheels acts at the hub Os, not at their centre of mass",
          "the moment rc x m g of each flywheel: its line of action moves with the phase"),
    Fault("moment of weight missing", "(7)", "fixed", [wrench(without_moment, "weight")],
          "The weight of carrier and instruments acts at the origin of their frame: its moment is missing",
          "rc x m g of carrier and instruments"),
    Fault("moment of weight, sign", "(7)", "all", [wrench(lambda P, k, at: P * (FORCE - MOMENT), "weight")],
          "The moment of the weight of all bodies has the wrong sign",
          "rc x m g, not m g x rc"),
    Fault("weight of carrier missing", "(7)", "fixed", [wrench(zero, "weight")],
          "The weight of carrier and instruments is missing; that of the flywheels is there",
          "the weight of every body"),
)
