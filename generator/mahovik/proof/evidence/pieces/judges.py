"""`verify --judges`: multibody programs of others."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Tell, Verdict, judged, module, program
from mahovik.proof.evidence.rows import of_report

_PACKAGES = (("Pinocchio", "pin"), ("MuJoCo", "mujoco"), ("Basilisk", "bsk"))


def _states(subject: Subject) -> int:
    return 200 if subject.full else 50


def _command(subject: Subject) -> str:
    return f"mahovik verify {subject.stand_file} --judges --bare --states {_states(subject)}"


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.proof.verify.judges.compare import verify_judges
    from mahovik.proof.verify.report import as_json, conclusion

    if subject.real != "double":
        return Outcome(Verdict.NOTHING, "the judges calculate in double: collect the evidence of the C in double")
    if not any(body.mass > 0.0 for body in subject.stand.bodies):
        return Outcome(Verdict.NOTHING, "no body of the stand has a mass")
    tell("equations and motions")
    found = verify_judges(subject.stand, count=_states(subject), bare=True)
    without = f"The stand was judged without {', '.join(found.left_out)}: the judges do not know these."
    notes = (without,) if found.left_out else ()
    tools = tuple(f"{title} {_version(package)}" for title, package in _PACKAGES if _version(package))
    files = {"report.json": as_json(found)}
    return Outcome(judged(found.passed), conclusion(found), tools, of_report(found), notes, files)


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


PIECE = Piece(
    name="judges",
    title="Programs of others",
    shows=(
        "Mass matrix, bias forces, accelerations, joint forces and a free motion agree with Pinocchio, MuJoCo and, for "
        "stands that its model can be, Basilisk: nobody of these projects knows this one."
    ),
    limits=(
        "Suspension, legs, fluid and stream, which they do not have: the stand is judged without. For these the three "
        "derivations above speak."
    ),
    command=_command,
    run=_run,
    needs=lambda _: (
        program("gcc"),
        module("pinocchio", "pip install 'mahovik[judges]'"),
        module("mujoco", "pip install 'mahovik[judges]'"),
    ),
)
