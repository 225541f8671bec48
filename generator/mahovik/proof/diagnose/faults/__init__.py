"""The dictionary: every fault that a program is searched for."""

from __future__ import annotations

from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.diagnose.faults import (
    answers,
    drive,
    fluid,
    inertia,
    laws,
    mounting,
    reading,
    unbalance,
    velocity,
    weight,
)

DICTIONARY: tuple[Fault, ...] = (
    *inertia.FAULTS,
    *unbalance.FAULTS,
    *mounting.FAULTS,
    *velocity.FAULTS,
    *weight.FAULTS,
    *fluid.FAULTS,
    *laws.FAULTS,
    *drive.FAULTS,
    *reading.FAULTS,
    *answers.FAULTS,
)
"""All faults, by subject. Of faults that a stand cannot tell apart the earlier is named first."""
