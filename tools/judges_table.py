"""What outside judges say of the example stands: writes docs/results/judges.md, and its short table into README.md.

python tools/judges_table.py [--states 200]
"""

from __future__ import annotations

from collections.abc import Sequence

import campaign

from mahovik.core.stand import Stand, load
from mahovik.proof.verify.judges.basilisk_judge import BasiliskJudge, Model
from mahovik.proof.verify.judges.basilisk_wheel import with_its_wheels
from mahovik.proof.verify.judges.compare import ALL, JUDGES, MOTION, QUANTITIES, verify_by, verify_judges
from mahovik.proof.verify.judges.rigid import missing, stripped
from mahovik.proof.verify.report import Report
from mahovik.stands import names, path

BLOCK = campaign.Block("README.md", "judges: tools/judges_table.py")
WORDS = (*QUANTITIES.values(), MOTION)
ITS_WORDS = (*(QUANTITIES[key] for key in ("K", "V_dot", "phi_ddot")), MOTION)
"""What Basilisk offers."""

NOTE = (
    "Basilisk: of stands whose flywheels are cut to what its reaction wheel can be; "
    "[the cases where it is\nnot exact](docs/results/judges.md#where-its-model-is-not-exact) are shown as well.\n"
)

BASILISK = """
Its reaction wheel (`JitterFullyCoupled`) has a static unbalance, a dynamic one across it, and one transverse moment of
inertia; its spacecraft is free, without uniform gravity. The flywheels of each stand are cut to such wheels, gravity is
left out, and nothing else. Of a stand file, `mahovik verify --judges` says in a line what Basilisk has not. It gives
its mass properties and the accelerations for drive torques, at states without a run-time wrench; the motion is by its
own integrator.

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


def worst(reports: Sequence[Report], judge: str, quantity: str) -> str:
    """The largest difference over stands; nothing where no stand has the quantity."""
    found = [row.worst for r in reports for row in r.rows if (row.want, row.quantity) == (judge, quantity)]
    return f"{max(found):.0e}" if found else ""


def short(reports: Sequence[Report], versions: Sequence[str]) -> str:
    """Quantities by judges: the worst of all stands."""
    rows = [[quantity, *(worst(reports, judge, quantity) for judge in ALL)] for quantity in WORDS]
    return campaign.table(["generated C against", *versions], rows) + "\n" + NOTE


def by_stand(reports: Sequence[Report], judge: str, words: Sequence[str]) -> str:
    """Quantities by stands."""
    rows = [[quantity, *(worst([r], judge, quantity) for r in reports)] for quantity in words]
    return campaign.table(["quantity", *(r.stand for r in reports)], rows)


def page(reports: Sequence[Report], dry: Sequence[str], versions: Sequence[str], states: int, basilisk: str) -> str:
    """The whole page."""
    text = (
        "# Outside judges\n\n"
        "Written by `python tools/judges_table.py`. The generated C against multibody programs of others, given the "
        "same stand:\nthe largest difference relative to the natural scale "
        "([what that is](../verification.md#the-natural-scale)), over "
        f"{states} random and extreme states a stand.\n"
        f"They know no fluid, suspension or legs; these were taken out of {', '.join(dry)}.\n"
    )
    for judge, version in zip(JUDGES, versions, strict=False):
        text += f"\n## {version}\n\n" + by_stand(reports, judge, WORDS)
    return text + f"\n## {versions[-1]}\n" + basilisk


def of_basilisk(exact: Sequence[Report], asymmetric: Sequence[Report], simple: Sequence[Report]) -> str:
    """Its part of the page: where it is exact, and the two cases where it is not."""
    tables = [by_stand(reports, "basilisk", ITS_WORDS) for reports in (exact, asymmetric, simple)]
    equal, balanced = (
        ", ".join(f"`{report.stand}`" for report in reports if report.passed) for reports in (asymmetric, simple)
    )
    return (
        BASILISK + tables[0] + NOT_EXACT.format(equal=equal, asymmetric=tables[1], balanced=balanced, simple=tables[2])
    )


def by_basilisk(stand: Stand, states: int, model: Model = "JitterFullyCoupled", asymmetric: bool = False) -> Report:
    """The C of a stand with wheels of Basilisk, against it."""
    its = with_its_wheels(stand, asymmetric)
    return verify_by(its, [BasiliskJudge(its, model, asymmetric)], count=states)


def main() -> None:
    """Run the judges, write both files. Exit status 1 where one disagrees."""
    states = campaign.parser(__doc__, states=200).parse_args().states
    stands = [load(path(name)) for name in names()]
    rigid = [stripped(stand) for stand in stands]
    reports = [verify_judges(stand, count=states, names=tuple(JUDGES)) for stand in rigid]
    exact = [by_basilisk(stand, states) for stand in rigid]
    asymmetric = [by_basilisk(stand, states, asymmetric=True) for stand in rigid]
    simple = [by_basilisk(stand, states, "JitterSimple") for stand in rigid]
    versions = [
        word.strip()
        for report in (reports[0], exact[0])
        for word in report.judged.removeprefix("generated C against ").split(",")
    ]
    dry = [f"`{stand.name}`" for stand in stands if missing(stand)]
    text = page(reports, dry, versions, states, of_basilisk(exact, asymmetric, simple))
    (campaign.ROOT / "docs" / "results" / "judges.md").write_text(text, encoding="utf-8")
    BLOCK.write(short([*reports, *exact], versions))
    raise SystemExit(0 if all(report.passed for report in (*reports, *exact)) else 1)


if __name__ == "__main__":
    main()
