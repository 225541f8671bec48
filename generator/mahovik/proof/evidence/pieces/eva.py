"""Frama-C Eva, by the script and the drivers that travel with the C."""

from __future__ import annotations

from mahovik.proof.evidence.piece import Outcome, Piece, Subject, Table, Tell, judged, program

_QUICK = ("any_wrap", "any_forward", "any_torque", "normal_prepare", "routine_sincos", "routine_sqrt")

_LIMITS = {False: 300, True: 1800}
"""Seconds a driver may take, quick and full."""


def _drivers(subject: Subject) -> list[str]:
    from mahovik.core.emit.eva import drivers
    from mahovik.core.emit.generate import generate_all

    every = drivers(generate_all(subject.stand, subject.real).program)
    claimed = [f"{each.set}_{each.function}" for each in every if each.claimed]
    return claimed if subject.full else [name for name in claimed if name in _QUICK]


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.core.toolchain.eva import proved, version

    script, logs = subject.c / f"{subject.stand.name}_eva.sh", subject.scratch / "eva"
    wanted, proofs = _drivers(subject), []
    tell(wanted[0])
    for proof in proved(script, wanted, _LIMITS[subject.full], logs):
        proofs.append(proof)
        tell(f"{len(proofs)} of {len(wanted)} drivers")
    rows = tuple((p.function, p.set, "no end" if p.alarms is None else str(p.alarms), str(p.unproved)) for p in proofs)
    bad = [f"{p.set}_{p.function}" for p in proofs if not p.holds]
    alarms = sum(p.alarms or 0 for p in proofs)
    figure = f"0 alarms in {len(proofs)} drivers" if not bad else f"{alarms} alarms, {len(bad)} drivers without proof"
    notes = (f"Not proved: {', '.join(bad)}.",) if bad else ()
    if not subject.full:
        notes = (*notes, "A selection of the drivers: `--full`, or the script itself, runs all that is claimed.")
    files = {each.name: each.read_text(encoding="utf-8", errors="replace") for each in sorted(logs.iterdir())}
    table = Table(("function", "inputs", "alarms>", "unproved>"), rows)
    good = not bad and len(proofs) == len(wanted)
    return Outcome(judged(good), figure, (f"Frama-C {version()}",), table, notes, files)


def _command(subject: Subject) -> str:
    chosen = "" if subject.full else f" {' '.join(_drivers(subject))}"
    return f"sh c/{subject.stand.name}_eva.sh{chosen}"


PIECE = Piece(
    name="eva",
    title="No undefined behaviour, by Frama-C Eva",
    shows=(
        "For whole sets of inputs at once, no operation that C leaves undefined: no index out of an array, nothing "
        "read before it was written, no overflow of integers. In `normal` and `any` also: results are finite, and "
        "written where the status is not negative, untouched where it is."
    ),
    limits=(
        "`inverse` and the Jacobians, of which nothing is claimed; tables that firmware prepares of other parameters. "
        "Sine, cosine, square root and arc tangent are seen by a contract, which Eva does not prove."
    ),
    command=_command,
    run=_run,
    needs=lambda _: (program("frama-c", "apt-get install frama-c-base"),),
)
