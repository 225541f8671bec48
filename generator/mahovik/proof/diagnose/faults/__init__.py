"""The dictionary: every fault that a program is searched for."""

from __future__ import annotations

from types import ModuleType

from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.diagnose.faults import answers, drive, fluid, inertia, laws, mounting, reading, unbalance, velocity
from mahovik.proof.diagnose.faults import weight as weights

MODULES: tuple[ModuleType, ...] = (
    inertia,
    unbalance,
    mounting,
    velocity,
    weights,
    fluid,
    laws,
    drive,
    reading,
    answers,
)


def _of(module: ModuleType) -> list[type[Fault]]:
    if module is laws:
        return list(laws.FAULTS)
    own = [each for each in vars(module).values() if isinstance(each, type) and each.__module__ == module.__name__]
    return [each for each in own if issubclass(each, Fault) and "name" in vars(each)]


DICTIONARY: tuple[type[Fault], ...] = tuple(fault for module in MODULES for fault in _of(module))
"""All faults, by subject. Of faults that a stand cannot tell apart the earlier is named first."""
