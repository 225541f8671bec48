"""Faults in cross-flow drag, (7)."""

from __future__ import annotations

from mahovik.proof.diagnose.edits import minus, wrench, zero
from mahovik.proof.diagnose.fault import Fault

KIND = "cross-flow drag"

# fmt: off
FAULTS = (
    Fault("cross-flow drag missing", "(7)", "all", [wrench(zero, KIND)],
          "Cross-flow drag is missing",
          "`cross_flow` of a body"),
    Fault("cross-flow drag, sign", "(7)", "all", [wrench(minus, KIND)],
          "Cross-flow drag has the wrong sign: it drives",
          "-(density/2) integral (C_y h |v| v, C_z b |w| w) dx"),
)
# fmt: on
