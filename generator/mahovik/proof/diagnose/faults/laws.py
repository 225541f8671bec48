"""Faults in the laws of `laws/`, (7): each folder lists its own."""

from __future__ import annotations

from mahovik.laws import LAWS, part
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.diagnose.law_fault import LawFault
from mahovik.proof.reference.array import Array


def _fault(law: str, row: LawFault) -> type[Fault]:
    """The equations with one law replaced."""

    def law_wrench(self: Fault, name: str) -> Array:
        return row.wrench(self.stand, self.state, self.pose) if name == law else Fault.law_wrench(self, name)

    words = {"name": row.name, "equation": "(7)", "look": row.look, "__doc__": row.words, "__module__": __name__}
    return type(f"{law}_{row.name}", (Fault,), {**words, "law_wrench": law_wrench})


FAULTS = tuple(_fault(law, row) for law in LAWS if (faults := part(law, "faults")) is not None for row in faults.FAULTS)
