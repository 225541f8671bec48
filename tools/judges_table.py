"""What outside judges say of the example stands: writes docs/results/judges.md, and its short table into README.md.

python tools/judges_table.py [--states 200]
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import campaign
from kept import Campaign, Columns, Figures, Rows

from mahovik.core.stand import Stand, load
from mahovik.proof.verify.judges.basilisk_judge import BasiliskJudge, Model
from mahovik.proof.verify.judges.basilisk_rotor import BasiliskRotorJudge
from mahovik.proof.verify.judges.basilisk_wheel import basilisk_stand, spacecraft_stand
from mahovik.proof.verify.judges.compare import JUDGES, MOTION, QUANTITIES, compare_with_judges, verify_judges
from mahovik.proof.verify.judges.rigid import bare_stand, missing
from mahovik.proof.verify.report import Report
from mahovik.stands import names, path

WORDS = (*QUANTITIES.values(), MOTION)
ITS_WORDS = (*(QUANTITIES[key] for key in ("K", "V_dot", "phi_ddot")), MOTION)
"""What Basilisk offers."""

NOTE = (
    "Basilisk: stands whose flywheels are reduced to what its reaction wheel can represent; "
    "[the cases where it is\nnot exact](docs/results/judges.md#where-its-model-is-not-exact) are shown as well. "
    "Its rotors on a\nhinge take every flywheel as it is.\n"
)

BASILISK = """
Its reaction wheel (`JitterFullyCoupled`) has a static unbalance, a dynamic one across it, and one transverse moment of
inertia; its spacecraft is free, without uniform gravity. The flywheels of each stand are reduced to such wheels,
and gravity is left out. For a stand file, `mahovik verify --judges` says in one line what Basilisk cannot
represent. It gives its mass properties and the accelerations for drive torques, at states without a run-time wrench;
the motion is by its own integrator.

"""

ROTORS = """
Its rotor on a hinge (`spinningBodyOneDOF`) has any mass, centre of mass and tensor: it takes each flywheel as it is.
Only gravity is left out, and run-time wrenches.

"""

NOT_EXACT = """
### Where its model is not exact

**Two transverse moments of inertia.** Its wheel takes `Jt` and `Jg`, but its equations hold for `Jt = Jg`: the terms of
their difference are missing, in the rate of the wheel's tensor as it turns and in the torque about its axis. It does
not refuse such a wheel. The stands are those above with both transverse moments of each flywheel kept; where they are
equal, as in {equal}, the model is exact.

{asymmetric}
**Unbalance as a force on the carrier.** `JitterSimple` lets `U_s` and `U_d` times the square of the speed act on the
carrier, whose mass and inertia do not turn with the wheels. The stands are those of the first table; where the
flywheels are balanced, as in {balanced}, the model is exact.

{simple}"""


def by_stand(reports: Sequence[Report], judge: str, words: Sequence[str]) -> list[dict[str, Any]]:
    """The largest difference: quantities by stands; None where a stand does not have the quantity."""
    return [
        {"quantity": quantity}
        | {
            report.stand: max((r.worst for r in report.rows if (r.want, r.quantity) == (judge, quantity)), default=None)
            for report in reports
        }
        for quantity in words
    ]


def table(rows: Rows) -> str:
    """Quantities by stands."""
    return Columns({key: "{}" if key == "quantity" else "{:.0e}" for key in rows[0]}).text(rows)


def short(found: Figures) -> str:
    """Quantities by judges: the worst of all stands."""
    of_judges = [*found["judges"], found["basilisk"], found["rotors"]]
    columns = dict.fromkeys(found["versions"], "{:.0e}")
    rows = []
    for quantity in WORDS:
        numbers = [
            [row[stand] for row in rows_of if row["quantity"] == quantity for stand in row if stand != "quantity"]
            for rows_of in of_judges
        ]
        rows.append((quantity, *(max((x for x in each if x is not None), default=None) for each in numbers)))
    head = Columns({"generated C against": "{}", **columns})
    return f"{head.text(head.rows(rows))}\n{NOTE}"


def page(found: Figures) -> str:
    """The tables of all judges, and the two cases where the model of Basilisk is not exact."""
    text = (
        "The largest difference relative to the natural scale "
        "([what that is](../verification.md#the-natural-scale)), over "
        f"{found['states']} random and extreme states per stand.\n"
        f"They know no fluid, suspension or legs; these were taken out of {_list(found['dry'])}.\n"
    )
    *versions, basilisk, rotors = found["versions"]
    for version, rows in zip(versions, found["judges"], strict=True):
        text += f"\n## {version}\n\n{table(rows)}"
    text += f"\n## {basilisk}\n{BASILISK}{table(found['basilisk'])}" + NOT_EXACT.format(
        equal=_list(found["equal"]),
        asymmetric=table(found["asymmetric"]),
        balanced=_list(found["balanced"]),
        simple=table(found["simple"]),
    )
    return f"{text}\n## {rotors}\n{ROTORS}{table(found['rotors'])}"


def _list(stands: Sequence[str]) -> str:
    return ", ".join(f"`{name}`" for name in stands)


CAMPAIGN = Campaign(
    "judges",
    campaign.Block("docs/results/judges.md", "figures: tools/judges_table.py"),
    page,
    also=((campaign.Block("README.md", "judges: tools/judges_table.py"), short),),
)


def by_basilisk(stand: Stand, states: int, model: Model = "JitterFullyCoupled", asymmetric: bool = False) -> Report:
    """The C of a stand with wheels of Basilisk, against it."""
    its = basilisk_stand(stand, asymmetric)
    return compare_with_judges(its, [BasiliskJudge(its, model, asymmetric)], count=states)


def by_rotors(stand: Stand, states: int) -> Report:
    """The C of a stand with its flywheels as they are, against Basilisk's rotors on hinges."""
    its = spacecraft_stand(stand)
    return compare_with_judges(its, [BasiliskRotorJudge(its)], count=states)


def main() -> None:
    """Run the judges, write both files. Exit status 1 where one disagrees."""
    states = campaign.parser(__doc__, states=200).parse_args().states
    stands = [load(path(name)) for name in names()]
    rigid = [bare_stand(stand) for stand in stands]
    reports = [verify_judges(stand, count=states, names=tuple(JUDGES)) for stand in rigid]
    exact = [by_basilisk(stand, states) for stand in rigid]
    asymmetric = [by_basilisk(stand, states, asymmetric=True) for stand in rigid]
    simple = [by_basilisk(stand, states, "JitterSimple") for stand in rigid]
    rotors = [by_rotors(stand, states) for stand in rigid]
    versions = [
        word.strip()
        for report in (reports[0], exact[0], rotors[0])
        for word in report.judged.removeprefix("generated C against ").split(",")
    ]
    CAMPAIGN.keep(
        {
            "states": states,
            "dry": [stand.name for stand in stands if missing(stand)],
            "versions": versions,
            "judges": [by_stand(reports, judge, WORDS) for judge in JUDGES],
            "basilisk": by_stand(exact, "basilisk", ITS_WORDS),
            "rotors": by_stand(rotors, BasiliskRotorJudge.name, ITS_WORDS),
            "equal": [report.stand for report in asymmetric if report.passed],
            "asymmetric": by_stand(asymmetric, "basilisk", ITS_WORDS),
            "balanced": [report.stand for report in simple if report.passed],
            "simple": by_stand(simple, "basilisk", ITS_WORDS),
        }
    )
    raise SystemExit(0 if all(report.passed for report in (*reports, *exact, *rotors)) else 1)


if __name__ == "__main__":
    main()
