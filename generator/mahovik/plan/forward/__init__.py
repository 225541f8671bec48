"""(8) forward in time for given flywheel motions, for many at once: rest, the carrier's course, its sensitivity."""

from mahovik.plan.forward.carrier import Carrier, apart, carrier_at
from mahovik.plan.forward.drive import Drive, drive
from mahovik.plan.forward.equilibrium import Equilibrium, equilibrium
from mahovik.plan.forward.integrate import simulate
from mahovik.plan.forward.sensitivity import Linearised, linearise, sensitivity

__all__ = [
    "Carrier",
    "Drive",
    "Equilibrium",
    "Linearised",
    "apart",
    "carrier_at",
    "drive",
    "equilibrium",
    "linearise",
    "sensitivity",
    "simulate",
]
