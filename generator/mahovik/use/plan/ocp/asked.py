"""Whether what is asked of the optimal control problem means something, before anything is searched. No CasADi here."""

from __future__ import annotations

from importlib.util import find_spec

from mahovik.core.stand.model import Stand
from mahovik.errors import UsageError
from mahovik.use.plan.ocp.partition import Plus, partition_of
from mahovik.use.plan.wishes import Wishes


def plus_asked(stand: Stand, asked: Wishes) -> Plus | None:
    """The six dependent flywheels that were asked for, None: the best. UsageError: it means nothing on this stand."""
    if asked.method == "fourier":
        if asked.partition is not None:
            raise UsageError("--partition goes with --method ocp-partition or ocp; the method is fourier")
        return None
    N, shown = len(stand.flywheels), f"--method {asked.method}"
    if N < 6:
        raise UsageError(f"{shown}: the stand has {N} flywheels; (13) needs six that follow; use --method fourier")
    for wheel in stand.flywheels:
        if wheel.damping is not None:
            raise UsageError(f'{shown}: flywheel "{wheel.name}" has damping of its own; use --method fourier')
    plus = None if asked.partition is None else partition_of(asked.partition, stand)
    if find_spec("casadi") is None:
        raise UsageError(f"{shown}: CasADi is not installed: pip install casadi, or use --method fourier")
    return plus
