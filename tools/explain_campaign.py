"""Plant faults in programs of random stands, ask `judge --explain` for them, write docs/results/diagnosis.md.

python tools/explain_campaign.py [--stands 6] [--jobs 2] [--write]

Exit status 1 where fewer than 95 % of single faults are named first, or a correct program is given a fault.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import campaign
import numpy as np
from explain_planting import Answers, Plant, answers_of, derived, edited, interpreted, literal, renumbered, rewritten

from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import EVERYTHING, SEQUENCES, Features, random_stand
from mahovik.proof.diagnose.diagnosis import Clinic, Diagnosis
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import Faulty, Part
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import CBackend, with_all_inputs
from mahovik.proof.verify.states import Request

BLOCK = campaign.Block("docs/results/diagnosis.md", "campaign: tools/explain_campaign.py --write")

COUNTS = (2, 1, 1, 3, 4, 2, 3, 5, 2, 8)
"""Flywheels of the stands, in turn."""

WHOLE, ALONE, ROUNDED = "in every body it concerns", "in one flywheel alone", "with answers rounded to float"
FORWARD = "in a program that offers `forward` only"
PART, TWO = "a part of it, 20 to 80 %", "two at once, both named"
SINGLE = (
    WHOLE, ALONE, ROUNDED, FORWARD, "stand edited", "states edited", "answers edited", "second derivation rewritten",
    "derivation rewritten", "numbers of the program",
)  # fmt: skip
"""Kinds of planting of one whole fault; those of the last lines are made without the dictionary's code."""

LEAST = 0.95
"""Of single faults that must be named first."""


@dataclass(frozen=True)
class Outcome:
    """Of one planted fault: named first `alone`, or with `equals` that the stand cannot tell from it, or else."""

    fault: str
    kind: str
    verdict: str


def campaign_stands(count: int) -> Iterator[Stand]:
    """The first `count` stands: always the same ones; every second with everything that a stand can have."""
    for number in range(count):
        features = replace(Features() if number % 2 else EVERYTHING, angles=SEQUENCES[number % 3])
        rng = np.random.default_rng(1000 + number)
        yield with_all_inputs(random_stand(rng, COUNTS[number % len(COUNTS)], features, f"random{number}"))


def verdict(found: Diagnosis, planted: Sequence[str]) -> str:
    """How a diagnosis answers to the planted names."""
    if found.outcome == "equal":
        return "unseen"
    if found.outcome != "named":
        return "none"
    named = [sorted(part.fault.name for part in cause.parts) for cause in found.causes]
    if sorted(planted) not in named:
        return "other"
    return "alone" if len(named) == 1 else "equals"


def of_dictionary(stand: Stand, rng: np.random.Generator, some: int) -> Iterator[Plant]:
    """The faults themselves: all; some of them in one flywheel alone; some as a float program would answer."""
    for fault in DICTIONARY:
        yield Plant(fault.name, WHOLE, Faulty(stand, (Part(fault),)).answer)
    turning = [fault for fault in DICTIONARY if fault.of_flywheels]
    for k in rng.choice(len(turning), min(some, len(turning)), replace=False):
        wheel = stand.flywheels[int(rng.integers(len(stand.flywheels)))].name
        yield Plant(turning[k].name, ALONE, Faulty(stand, (Part(turning[k], wheel),)).answer)
    seen = [fault for fault in DICTIONARY if visible(stand, fault)]  # of the others nothing but rounding is there
    for k in rng.choice(len(seen), some, replace=False):
        yield Plant(seen[k].name, ROUNDED, rounded(Faulty(stand, (Part(seen[k]),)).answer))


def freer(stand: Stand, rng: np.random.Generator, some: int) -> Iterator[tuple[list[str], str, Answers]]:
    """Parts of faults, mixed into the answers; and two faults in one program."""
    right = Faulty(stand).answer
    for k in rng.choice(len(DICTIONARY), some, replace=False):
        wrong = Faulty(stand, (Part(DICTIONARY[k]),)).answer
        yield [DICTIONARY[k].name], PART, mixed(right, wrong, float(rng.uniform(0.2, 0.8)))
    for _ in range(some):
        a, b = (DICTIONARY[int(k)] for k in rng.choice(len(DICTIONARY), 2, replace=False))
        if all(visible(stand, fault) for fault in (a, b)):
            yield [a.name, b.name], TWO, Faulty(stand, (Part(a), Part(b))).answer


def visible(stand: Stand, fault: Any) -> bool:
    """Whether a fault has any effect on a stand."""
    return bool(np.any(~(np.abs(clinics(stand).predictions.error((Part(fault),), False)) < 1e-9)))


_clinics: dict[Stand, Clinic] = {}


def clinics(stand: Stand) -> Clinic:
    """The clinic of the stand at hand: its predictions are kept."""
    if stand not in _clinics:
        _clinics.clear()
        _clinics[stand] = Clinic(stand)
    return _clinics[stand]


def rounded(answers: Answers) -> Answers:
    """Answers with seven digits."""

    def to_float(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {name: to_float(each) for name, each in value.items()}
        if isinstance(value, str):  # a status
            return value
        return np.asarray(value, dtype=np.float32).astype(np.float64)

    return lambda request: to_float(answers(request))


def mixed(right: Answers, wrong: Answers, share: float) -> Answers:
    """right + share (wrong - right), number by number."""

    def mix(a: Any, b: Any) -> Any:
        if isinstance(a, Mapping):
            return {name: mix(a[name], b[name]) for name in a if name in b}
        return np.asarray(a) + share * (np.asarray(b) - np.asarray(a))

    def answer(request: Request) -> Mapping[str, Any]:
        found: Mapping[str, Any] = mix(right(request), wrong(request))
        return found

    return answer


def correct(stand: Stand) -> Iterator[tuple[str, Answers]]:
    """Programs without a fault."""
    yield "literal reference", literal(stand)
    yield "second derivation", answers_of(Second(stand))
    if len(stand.flywheels) < 2:  # it takes long to make: of some stands only
        yield "interpreter of the program", answers_of(interpreted(stand))
        yield "generated C, double", answers_of(CBackend(stand, "double"))
        yield "generated C, float", answers_of(CBackend(stand, "float"))


def examined(number: int, some: int = 8) -> tuple[str, list[Outcome], list[Outcome]]:
    """Everything that is planted on the stand of that number: outcomes, and those of correct programs."""
    *_, stand = campaign_stands(number + 1)
    rng = np.random.default_rng(number)
    clinic = clinics(stand)
    plants: list[Plant] = [*of_dictionary(stand, rng, some), *renumbered(stand), *edited(stand)]
    found = [Outcome(p.fault, p.kind, verdict(clinic.diagnose(p.answers), [p.fault])) for p in plants]
    dearer = {0: (rewritten,), 1: (derived,), 4: (rewritten,)}  # they take long to make: of some stands only
    for others in dearer.get(number, ()):
        found += [Outcome(p.fault, p.kind, verdict(clinic.diagnose(p.answers), [p.fault])) for p in others(stand)]
    for names, kind, answers in freer(stand, rng, some):
        found.append(Outcome(" + ".join(names), kind, verdict(clinic.diagnose(answers), names)))
    forward = Clinic(stand, wants=("forward",))
    for k in rng.choice(len(DICTIONARY), 2 * some, replace=False):
        fault = DICTIONARY[k]
        answers = Faulty(stand, (Part(fault),)).answer
        found.append(Outcome(fault.name, FORWARD, verdict(forward.diagnose(answers), [fault.name])))
    right = [Outcome(name, "correct", clinic.diagnose(answers).outcome) for name, answers in correct(stand)]
    return f"{stand.name}: {len(stand.flywheels)} flywheels", found, right


def counted(outcomes: Sequence[Outcome]) -> tuple[int, int, int, int]:
    """Seen, named first alone, named first with equals, of a set of outcomes; and the part named first, in percent."""
    seen = [each for each in outcomes if each.verdict != "unseen"]
    alone, equals = (sum(each.verdict == word for each in seen) for word in ("alone", "equals"))
    return len(seen), alone, equals, len(seen) - alone - equals


def rate(outcomes: Sequence[Outcome]) -> float:
    """Of those that can be seen, the part that is named first."""
    seen, alone, equals, _ = counted(outcomes)
    return (alone + equals) / seen if seen else 1.0


KINDS_HEAD = ("planted", "visible", "named first", "with equals", "not", "rate")
RIGHT_HEAD = ("correct program", "stands", "given a fault")
DICTIONARY_HEAD = ("fault", "equation", "what the program does", "planted", "named first")


def summary(stands: int, found: Sequence[Outcome], right: Sequence[Outcome]) -> str:
    """The results as Markdown: by kind of planting, of correct programs, fault by fault."""
    single = [each for each in found if each.kind in SINGLE]
    seen, alone, equals, _ = counted(single)
    text = (
        f"{stands} random stands. Of {seen} single faults that the stand lets one see, {alone + equals} were named "
        f"first ({rate(single):.1%}),\n"
        f"{equals} of them together with others that no state of the stand tells apart.\n\n"
    )
    rows = []
    for kind in (*SINGLE, PART, TWO):
        of_it = [each for each in found if each.kind == kind]
        if of_it:
            rows.append((kind, *map(str, counted(of_it)), f"{rate(of_it):.0%}"))
    text += campaign.table(KINDS_HEAD, rows) + "\n"
    rows = []
    for name in dict.fromkeys(each.fault for each in right):
        of_it = [each for each in right if each.fault == name]
        rows.append((name, str(len(of_it)), str(sum(each.verdict not in ("equal", "rounding") for each in of_it))))
    text += campaign.table(RIGHT_HEAD, rows) + "\n"
    rows = []
    for fault in DICTIONARY:
        seen, alone, equals, _ = counted([each for each in single if each.fault == fault.name])
        words = (each.replace("|", "\\|") for each in (fault.name, fault.equation, fault.words))
        rows.append((*words, str(seen), str(alone + equals)))
    return text + campaign.table(DICTIONARY_HEAD, rows, 3)


def main() -> None:
    """Run it."""
    given = campaign.parser(__doc__, stands=6, jobs=campaign.cores(), write=False).parse_args()
    found: list[Outcome] = []
    right: list[Outcome] = []
    for line, outcomes, of_correct in campaign.each(examined, given.jobs, range(given.stands)):
        single = [each for each in outcomes if each.kind in SINGLE]
        print(f"{line}: {rate(single):.1%} of {counted(single)[0]} single faults named first", flush=True)
        for each in outcomes:
            if each.verdict in ("other", "none"):
                print(f"  {each.kind}: {each.fault}: {each.verdict}", flush=True)
        found += outcomes
        right += of_correct
    text = summary(given.stands, found, right)
    print(f"\n{text}", end="")
    if given.write:
        BLOCK.write(text)
    false = [each for each in right if each.verdict not in ("equal", "rounding")]
    raise SystemExit(1 if false or rate([each for each in found if each.kind in SINGLE]) < LEAST else 0)


if __name__ == "__main__":
    main()
