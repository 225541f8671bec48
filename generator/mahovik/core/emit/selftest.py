"""The self-test of a stand's C, golden vectors and a sweep, for the host and for the real board; its fuzz harness.

Both are printed from the signatures of the program, so a new public function is tested without further work.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mahovik.contract.functions import row_of
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.calls import functions_in_tables, passed_text
from mahovik.core.emit.code import INDENT, Code
from mahovik.core.emit.declaration import pointer_arguments
from mahovik.core.emit.layout import wrap_statement
from mahovik.core.emit.literal import members
from mahovik.core.emit.log_format import RECORDED
from mahovik.core.emit.names import member
from mahovik.core.lower import test_inputs
from mahovik.core.lower.golden import CASES, FAR, LISTED, SWEPT, Golden, is_prepared, tested_functions
from mahovik.core.lower.test_inputs import options_plan
from mahovik.core.lower.trials import ALL, CHANGED, Path
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.structure import Identities

_SPECIAL = {"inf": "infinite", "nan": "not_a_number"}
"""Constants of the self-test for numbers that no literal of C99 is."""


def selftest(program: Program, golden: Golden, identities: Identities) -> str:
    """Text of `<stand>_selftest.c`."""
    return _SelfTest(Code(program, identities), golden).text()


class _SelfTest:
    """Collects the parts that the template puts in order."""

    def __init__(self, code: Code, golden: Golden) -> None:
        self._code, self._golden, self._names = code, golden, code.names
        self._tested = tested_functions(code.program)

    def text(self) -> str:
        """The whole file."""
        code, drawn, golden = self._code, test_inputs.inputs(self._code.program), self._golden
        words = functions_in_tables(code, self._tested, golden.options_plan)
        answers = [row | self._answers(row["name"]) for row in words.pop("functions")]
        return code.render(
            "selftest.c.j2",
            **words,
            functions=answers,
            inputs=[self._case_initialiser(case, drawn) for case in golden.inputs],
            left_out=[self._names.function(f.name) for f in code.public if f not in self._tested],
            judged=len(CASES) + 2,
            to_integer=code.real(1.5 * 2.0 ** (code.precision.significand - 1)),
            cases=CASES,
            far=FAR,
            seed=f"0x{test_inputs.SEED:x}u",
            swept=SWEPT,
            listed=LISTED,
            options_every=test_inputs.OPTIONS_EVERY,
            options_last=test_inputs.OPTIONS_EVERY - 1,
            omitted_every=test_inputs.OMITTED_EVERY,
            omitted_last=test_inputs.OMITTED_EVERY - 1,
            own_memory=False,
            **self._trials(),
        )

    def _answers(self, name: str) -> dict[str, Any]:
        """Values of the template for what is known of one function."""
        answers = self._golden.answers[name]
        return {
            "cases": [(a.status, f"0x{a.hash:08x}u", len(a.listed)) for a in answers],
            "numbers": [
                wrap_statement(", ".join(map(self._code.hex, a.listed)) + ",", INDENT) for a in answers if a.listed
            ],
            "sweep": f"0x{self._golden.sweep[name]:08x}u",
        }

    # ---- trials ----

    def _bits(self, value: float) -> str:
        """Bits of a number as a literal."""
        size = self._code.precision.width // 8
        return f"0x{int.from_bytes(np.array(value, f'<f{size}').tobytes(), 'little'):x}u"

    def _trials(self) -> dict[str, Any]:
        """Values of the template for the trials: statements of each change, and a row for each answer."""
        numbers = {f.name: k for k, f in enumerate(self._tested)}
        changes = list(dict.fromkeys(tuple(trial.changes.items()) for trial in self._golden.trials))
        values = {str(value) for trial in changes for _, value in trial}
        prepares, rows = "prepare" in numbers, []
        for trial in self._golden.trials:
            words = [0] * (len(numbers) // 32 + 1)
            for name in trial.functions:
                words[numbers[name] // 32] |= 1 << numbers[name] % 32
            called = ", ".join(f"0x{word:x}u" for word in words)
            made = any(is_prepared(f, trial.changes) for f in self._tested if f.name in trial.functions)
            prepared = f"{int(made)}, " if prepares else ""
            at = changes.index(tuple(trial.changes.items()))
            rows.append(f"{{ {at}, {trial.status}, {prepared}0x{trial.hash:08x}u, {{ {called} }} }},")
        return {
            "changes": [[line for path, value in trial for line in self._change(path, value)] for trial in changes],
            "trials": rows,
            "specials": {_SPECIAL[x]: self._bits(float(x)) for x in _SPECIAL if x in values},
            "words": len(numbers) // 32 + 1,
            "prepares": prepares,
        }

    def _change(self, path: Path, value: float) -> list[str]:
        """Statements that put a value into a place."""
        root = str(path[0])
        arguments = (a for f in self._tested for a in f.arguments if a.name == root)
        type_ = next(arguments).type
        place = root if root in CHANGED else f"in.{root}"
        loop = ""
        for part in path[1:]:
            if part == ALL:
                place, loop = f"{place}[s]", f"for (int s = 0; s < {self._names.constant('N')}; ++s) "
            elif isinstance(part, int):
                place = f"{place}[{part}]"
            else:
                assert isinstance(type_, Struct)
                type_ = next(f.type for f in type_.fields if f.name == part)
                place = f"{place}.{member(part)}"
        if str(value) in _SPECIAL:
            text = f"{_SPECIAL[str(value)]}.real"
        else:
            text = str(int(value)) if type_ is Kind.INT else self._code.hex(value)
        return [f"{loop}{{ {place} = {text}; }}" if loop else f"{place} = {text};"]

    # ---- golden numbers ----

    def _case_initialiser(self, case: dict[str, Any], drawn: Sequence[Argument]) -> list[str]:
        """Initialiser of one case of golden inputs."""
        fields = (*(Field(a.name, a.type, a.shape) for a in drawn), Field(test_inputs.MASS_FACTOR, Kind.REAL))
        return list(members(Struct("inputs", "", fields), case, self._code.hex, {}, INDENT * 2))


# -- fuzz harness: bytes of libFuzzer become arguments of every public function ----------------------------------------


def fuzz_harness(program: Program, identities: Identities) -> str:
    """Text of `<stand>_fuzz.c`. Raises ValueError for a public function without status: the harness asks for it."""
    code = Code(program, identities)
    precision, table = code.precision, next(s for s in program.structs if s.name == "table")
    return code.render(
        "fuzz.c.j2",
        **functions_in_tables(code, code.public, options_plan(program)),
        own_memory=True,
        promises=[_promise(f) for f in code.public],
        recorders=[_recorder(code, f) for f in code.public if f.name in RECORDED],
        epsilon=code.real(precision.epsilon),
        smallest=code.real(precision.smallest),
        subnormal=code.real(precision.smallest * precision.epsilon),
        bounds=[macro for macro, _, _ in code.limits if macro != code.names.constant("LARGEST")],
        largest=code.names.constant("LARGEST"),
        stream=bool(table.field("stream")),
    )


def _promise(f: Function) -> tuple[str, str, int]:
    """Documented statuses, a bit each of the negative ones; may it ignore arguments."""
    values = {STATUS_VALUES[s] for s in (*f.statuses, *(("BAD_ARGUMENT",) if pointer_arguments(f) else ()))}
    refusals = " | ".join(f"1u << {-v}" for v in sorted(values) if v < 0) or "0u"
    bits = " | ".join(f"{v}u" for v in sorted(values) if v > 0) or "0u"
    return (refusals, bits, int(bool(row_of(f.name).unread)))


def _recorder(code: Code, f: Function) -> dict[str, Any]:
    """The recorder's step, with the arguments of the step itself: of another state, then of the state."""
    names = [a.name for a in f.arguments]
    passed = [passed_text(code.names, f, a) for a in f.arguments if a.name not in ("table", "x", "next", "carry")]

    def step(state: str) -> str:
        return f"{code.names.function(f'recorder_{f.name}')}({', '.join(['&log', 'a[0]', state, *passed, 'carry'])})"

    places = {role: names.index(name) for role, name in (("state", "x"), ("next", "next"), ("carry", "carry"))}
    return {"name": f.name, "first": step("&other"), "second": step("&x"), "number": code.public.index(f), **places}
