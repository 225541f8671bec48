"""`verify --rigorous`: the true error of the C, by ball arithmetic."""

from __future__ import annotations

from importlib.metadata import version

from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Table, Tell, judged, module, program


def _states(subject: Subject) -> int:
    return 300 if subject.full else 60


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.proof.verify.rounding.measure import measure_rounding
    from mahovik.proof.verify.rounding.report import as_json, conclusion

    def progress(done: int, total: int) -> None:
        tell(f"state {done} of {total}")

    found = measure_rounding(subject.stand, count=_states(subject), real=subject.real, progress=progress)
    rows = tuple(
        (
            line.row.quantity,
            line.row.want,
            str(line.row.states),
            f"{line.ulps:.2g}",
            f"{line.row.worst:.1e}",
            f"{line.typical:.1e}",
            line.row.verdict,
        )
        for line in found.lines
    )
    table = Table(("quantity", "by", "states>", "ulp>", "of scale>", "relative>", "verdict"), rows)
    tools = (f"python-flint {version('python-flint')}",)
    return Outcome(
        judged(found.report.passed), conclusion(found), tools, table, files={"rounding.json": as_json(found)}
    )


PIECE = Piece(
    name="rounding",
    title="Rounding, bounded",
    shows=(
        "At each sampled state the exact answer of the literal equations is enclosed by ball arithmetic, so that the "
        "error of the C is known and not estimated: from the numbers of the stand file and the state to the answer."
    ),
    limits="States that were not sampled: it is a measurement with a rigorous ruler, not a bound for all inputs.",
    command=lambda s: f"mahovik verify {s.stand_file} --rigorous --states {_states(s)}{s.option}",
    run=_run,
    needs=lambda _: (program("gcc"), module("flint", "pip install 'mahovik[rigorous]'")),
)
