"""`verify`: the C, the literal reference and the second derivation, three ways."""

from __future__ import annotations

from importlib.metadata import version

from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Tell, judged, program
from mahovik.proof.evidence.rows import of_report


def _states(subject: Subject) -> int:
    return 2000 if subject.full else 200


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.core.toolchain.board import version as compiler
    from mahovik.proof.verify.harness import verify_c
    from mahovik.proof.verify.report import as_json, as_junit, conclusion, worst_lines

    def progress(done: int, total: int) -> None:
        tell(f"state {done} of {total}")

    found = verify_c(subject.stand, seed=1, count=_states(subject), real=subject.real, progress=progress)
    files = {"report.json": as_json(found), "junit.xml": as_junit(found), "worst.jsonl": worst_lines(found)}
    tools = (compiler("gcc"), f"NumPy {version('numpy')}", f"CasADi {version('casadi')}", f"SymPy {version('sympy')}")
    return Outcome(judged(found.passed), conclusion(found), tools, of_report(found), files=files)


PIECE = Piece(
    name="comparison",
    title="Three derivations",
    shows=(
        "At random and extreme states every quantity of the C agrees with the literal equations (1)-(13) of the paper "
        "in NumPy, and with a second derivation that knows only energies, by CasADi's differentiation; the three share "
        "no formula. Bad inputs are refused and leave outputs untouched; the interpreter of the program has the same "
        "bits."
    ),
    limits=(
        "States between the sampled ones; that the equations describe a machine that bends, leaks or slips. Errors are "
        "relative to the natural scale: the largest terms that a quantity is a sum of."
    ),
    command=lambda s: f"mahovik verify {s.stand_file} --states {_states(s)}{s.option}",
    run=_run,
    needs=lambda _: (program("gcc"),),
)
