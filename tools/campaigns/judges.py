"""The C of the example stands against Pinocchio, MuJoCo and Basilisk, which are given the same stand."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence

from campaigns import Row, Rows, Table
from mahovik.core.stand import Stand, load
from mahovik.proof.verify.judges.basilisk_judge import BasiliskJudge, Model
from mahovik.proof.verify.judges.basilisk_rotor import BasiliskRotorJudge
from mahovik.proof.verify.judges.basilisk_wheel import basilisk_stand, spacecraft_stand
from mahovik.proof.verify.judges.compare import JUDGES, MOTION, QUANTITIES, compare_with_judges, verify_judges
from mahovik.proof.verify.judges.rigid import bare_stand
from mahovik.proof.verify.report import Report
from mahovik.stands import names, path

OPTIONS = {"states": 200}

WORDS = (*QUANTITIES.values(), MOTION)
EXACT = ("pinocchio", "mujoco", "basilisk, reduced wheels", "basilisk, rotors on hinges")
ASYMMETRIC, SIMPLE = "basilisk, two transverse moments", "basilisk, unbalance as a force"
ACCEPTED = 1e-11


def by_wheels(stand: Stand, states: int, model: Model = "JitterFullyCoupled", asymmetric: bool = False) -> Report:
    """The C of a stand with wheels of Basilisk, against it."""
    reduced = basilisk_stand(stand, asymmetric)
    return compare_with_judges(reduced, [BasiliskJudge(reduced, model, asymmetric)], count=states)


def by_rotors(stand: Stand, states: int) -> Report:
    """The C of a stand with its flywheels as they are, against Basilisk's rotors on hinges."""
    free = spacecraft_stand(stand)
    return compare_with_judges(free, [BasiliskRotorJudge(free)], count=states)


def largest(reports: Sequence[Report], judge: str, quantity: str) -> float | None:
    """The largest difference over stands; None where no stand has the quantity."""
    rows = (row for report in reports for row in report.rows)
    return max((row.value for row in rows if (row.judged, row.quantity) == (judge, quantity)), default=None)


def measure(options: Namespace) -> Iterator[tuple[str | float | None, ...]]:
    """A row for each quantity: the largest difference over the example stands, judge by judge."""
    stands = [bare_stand(load(path(name))) for name in names()]
    by_two = [verify_judges(stand, count=options.states, names=tuple(JUDGES)) for stand in stands]
    columns = [(by_two, judge) for judge in JUDGES]
    columns.append(([by_wheels(stand, options.states) for stand in stands], "basilisk"))
    columns.append(([by_rotors(stand, options.states) for stand in stands], BasiliskRotorJudge.name))
    columns.append(([by_wheels(stand, options.states, asymmetric=True) for stand in stands], "basilisk"))
    columns.append(([by_wheels(stand, options.states, "JitterSimple") for stand in stands], "basilisk"))
    for quantity in WORDS:
        yield quantity, *(largest(reports, judge, quantity) for reports, judge in columns)


def agrees(row: Row) -> bool:
    """Whether all judges agree whose models are exact."""
    return all(row[judge] is None or row[judge] <= ACCEPTED for judge in EXACT)


def claim(rows: Rows) -> str:
    """The largest differences of a state and of a motion."""
    *of_state, motion = (max(row[judge] or 0.0 for judge in EXACT) for row in rows)
    return (
        f"The C agrees with Pinocchio, MuJoCo and Basilisk where their models are exact: largest difference of a state "
        f"{max(of_state):.1e}, of a motion of 2 s {motion:.1e}"
    )


NOTE = """The largest difference over the example stands and their random and extreme states. The judges know no fluid,
suspension or legs, which were taken out. Basilisk is given a free spacecraft without gravity: `JitterFullyCoupled` with
flywheels reduced to what its wheel has (a static unbalance, a dynamic one across it, one transverse moment of inertia),
and its rotor on a hinge, `spinningBodyOneDOF`, with flywheels as they are.

### Where its model is not exact

The last two columns. **Two transverse moments of inertia**: its wheel takes `Jt` and `Jg`, but its equations hold for
`Jt = Jg`: the terms of their difference are missing, in the rate of the wheel's tensor as it turns and in the torque
about its axis. It does not refuse such a wheel. **Unbalance as a force**: `JitterSimple` lets `U_s` and `U_d` times the
square of the speed act on the carrier, whose mass and inertia do not turn with the wheels."""

TABLES = {
    "judges": Table(
        measure,
        {"generated C against": "{}", **dict.fromkeys((*EXACT, ASYMMETRIC, SIMPLE), "{:.0e}")},
        claim,
        agrees,
        NOTE,
    )
}
