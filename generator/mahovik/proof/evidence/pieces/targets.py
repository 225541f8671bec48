"""`verify --targets`: the same bits on processors."""

from __future__ import annotations

from mahovik.proof.evidence.piece import Need, Outcome, Piece, Subject, Table, Tell, judged, program


def _names(subject: Subject) -> str:
    return "all" if subject.full else {"double": "host,m7,rv64gc", "float": "host,m4,rv64gc"}[subject.real]


def tools_of(names: str, real: str) -> tuple[Need, ...]:
    """Compilers and emulators of targets."""
    from mahovik.proof.verify.targets import asked

    found: dict[str, Need] = {}
    for target, _ in asked(names, (real,)):
        packages = " ".join(target.packages)
        for command in (target.compiler[0], target.link[0], *target.emulator[:1]):
            found.setdefault(command, program(command, f"apt-get install {packages}" if packages else ""))
    return tuple(found.values())


def _run(subject: Subject, tell: Tell) -> Outcome:
    from mahovik.proof.verify.targets import asked, verify_targets
    from mahovik.proof.verify.targets_report import as_json

    def progress(done: int, total: int) -> None:
        tell(f"{done} of {total}")

    tell("compile and run")
    found = verify_targets(subject.stand, asked(_names(subject), (subject.real,)), progress=progress)
    rows = tuple((r.target, r.title, r.built_with, f"{r.verdict} {r.reason}".strip()) for r in found.rows)
    tools = tuple(dict.fromkeys(r.built_with for r in found.rows if r.verdict == "ok"))
    table = Table(("target", "processor", "compiler", "verdict"), rows)
    return Outcome(judged(found.passed), found.conclusion, tools, table, files={"targets.json": as_json(found)})


PIECE = Piece(
    name="targets",
    title="The same bits on processors",
    shows="The self-test and a sweep give on each of these, on emulators, the bits that they give on the host.",
    limits="Real silicon: run the self-test on the board, and judge its log by `mahovik judge-log`.",
    command=lambda s: f"mahovik verify {s.stand_file} --targets {_names(s)} --real {s.real}",
    run=_run,
    needs=lambda s: tools_of(_names(s), s.real),
)
