"""The fuzz harness of a stand's C: bytes of libFuzzer become arguments of every public function.

It is printed from the signatures of the program, so a new public function is fuzzed without further work.
"""

from __future__ import annotations

from typing import Any

from mahovik.contract.functions import row_of
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.calls import functions_in_tables, passed_text
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import pointer_arguments
from mahovik.core.emit.log_format import RECORDED
from mahovik.core.lower.test_inputs import options_plan
from mahovik.core.program.function import Function, Program
from mahovik.core.stand.structure import Identities


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
