"""The dictionary: every fault that a program is searched for."""

from __future__ import annotations

from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.diagnose.faults import drive, fluid, laws, mounting, velocity, wrenches
from mahovik.proof.diagnose.faults.inertia import INERTIA_FAULTS, UNBALANCE_FAULTS
from mahovik.proof.diagnose.faults.reading import ANSWER_FAULTS, READING_FAULTS
from mahovik.proof.diagnose.faults.stream import PROFILE_FAULTS, STREAM_FAULTS

DICTIONARY: tuple[Fault, ...] = (
    *INERTIA_FAULTS,
    *UNBALANCE_FAULTS,
    *mounting.FAULTS,
    *velocity.FAULTS,
    *laws.ON_BODIES,
    *wrenches.FAULTS,
    *fluid.FAULTS,
    *STREAM_FAULTS,
    *PROFILE_FAULTS,
    *laws.ON_CARRIER,
    *drive.FAULTS,
    *READING_FAULTS,
    *ANSWER_FAULTS,
)
"""All faults, by subject. Of faults that a stand cannot tell apart the earlier is named first."""
