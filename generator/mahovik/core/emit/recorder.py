"""C of the flight recorder: a stand's steps, logged so that `mahovik replay` can repeat them bit for bit.

The emitted header describes the format of a log; `use/simulate/replay.py` reads it.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.emit.calls import nested_loops, over_rows
from mahovik.core.emit.code import Code
from mahovik.core.emit.declaration import pointer_arguments, prototype
from mahovik.core.emit.generate import Generated
from mahovik.core.emit.layout import wrap_statement
from mahovik.core.emit.log_format import CHANGING, FORMAT, MAGIC, RECORDED, STEP, logged_members, table_bytes
from mahovik.core.emit.names import VERIFICATION, Names
from mahovik.core.lower.golden import fnv1a
from mahovik.core.lower.layout import Layout
from mahovik.core.program.call import Argument
from mahovik.core.program.cost import stack_bound
from mahovik.core.program.function import Function, Program
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.errors import UsageError


def source_hash(files: dict[str, str], name: str) -> int:
    """Hash of the header and source that flew."""
    return fnv1a((files[f"{name}.h"] + files[f"{name}.c"]).encode("utf-8"))


_FRAMES = 352
"""Stack of the recorder's own functions, bytes: an upper bound for the deepest chain of calls, without the record."""


def recorder_files(stand: Stand, generated: Generated) -> dict[str, str]:
    """Header and source of the recorder by file name, in VERIFICATION. Raises UsageError where there is no step."""
    if not logging(generated.program):
        raise UsageError(
            f"with_ recorder (or that of the folder): the C of {stand.name} has no step, expected one of "
            f"{', '.join(RECORDED)}"
        )
    code = Code(generated.program, identities(stand))
    values = _values(generated, code)
    place = f"{VERIFICATION}{stand.name}_recorder"
    return {f"{place}.{kind}": code.render(f"recorder.{kind}.j2", **values) for kind in ("h", "c")}


def _values(generated: Generated, code: Code) -> dict[str, Any]:
    """Values of the templates beside the facts of the program."""
    layout, program, names, name = generated.layout, generated.program, code.names, generated.program.name
    size, count, wrenches = program.precision.width // 8, len(layout.structure.flywheels), len(layout.inputs)
    members = [(f.name, names.length(f.shape[0])) for f in layout.state.fields]
    table = table_bytes(layout, generated.values.table)
    fixed = 7 + 9 + count * size
    state = sum(int(f.shape[0]) for f in layout.state.fields) * size
    steps = logging(program)
    changing = size + 4 + 2 * state + 3 * size * layout.stream + (count + 7) // 8
    longest = fixed + changing + 6 * wrenches * size
    flags = [(member.upper(), 1 << place, f"{member} was written") for place, (member, _) in enumerate(members)]
    flags += [(flag, bit, meaning) for flag, (bit, meaning) in CHANGING.items()]
    return {
        "source": f"{source_hash(generated.files, name):08x}",
        "table_bytes": len(table),
        "table_hash": f"{fnv1a(table):08x}",
        "longest": longest,
        "shortest": fixed,
        "format": FORMAT,
        "magic": [f"0x{byte:02x}" for byte in MAGIC],
        "step": f"0x{STEP:02x}",
        "flags": flags,
        "members": members,
        "flywheels": names.constant("N") if count else 0,
        "wrenches": names.constant("WRENCHES") if wrenches else 0,
        "stream": layout.stream,
        "rounding": names.length(layout.carry.fields[0].shape[0]),
        "name_bytes": [f"0x{byte:02x}" for byte in name.encode("ascii")],
        "put_functions": [
            {"struct": struct.name, "lines": [line for f in struct.fields for line in _put_statements(f, names)]}
            for struct in Struct(layout.table.name, layout.table.purpose, logged_members(layout)).inner_structs()
        ],
        "start_prototype": prototype(_start(layout), names),
        "start_stack": _round_stack(longest + _FRAMES),
        "functions": [_step(f, names) | {"stack": _round_stack(_stack(f, program) + longest)} for f in steps],
    }


def _recorder() -> Argument:
    return Argument("log", Struct("recorder", "A log in progress.", ()), (), "inout")


def _start(layout: Layout) -> Function:
    arguments = (_recorder(), Argument("table", layout.table), Argument("x", layout.state))
    return Function("recorder_start", "", arguments, (), returns=Kind.STATUS, public=True)


def logging(program: Program) -> list[Function]:
    """The steps with a log, without bodies: the result of each replaces its state."""
    return [_logging(f) for f in program.functions if f.public and f.name in RECORDED]


def _logging(f: Function) -> Function:
    arguments = [Argument("x", a.type, (), "inout") if a.name == "x" else a for a in f.arguments if a.name != "next"]
    return Function(f"recorder_{f.name}", "", (_recorder(), *arguments), (), returns=Kind.STATUS, public=True)


def _stack(logged: Function, program: Program) -> int:
    """Bound of the stack of a step with a log, without the record."""
    return stack_bound(program.function(logged.name.removeprefix("recorder_")), program) + _FRAMES


def _round_stack(stack: int) -> int:
    return -(-stack // 16) * 16


def _step(f: Function, names: Names) -> dict[str, Any]:
    """Values of the template for a step with a log."""
    taken = [a.name for a in f.arguments[1:]]
    condition = " || ".join(f"{a.name} == NULL" for a in pointer_arguments(f))
    text = f"if ({condition} || log->write == NULL) {{ return {names.constant('BAD_ARGUMENT')}; }}"
    return {
        "name": f.name.removeprefix("recorder_"),
        "prototype": prototype(f, names),
        "null_check": wrap_statement(text, "    "),
        "drive": next((n for n in ("tau", "phi_ddot") if n in taken), ""),
        "driven": "phi_ddot" in taken,
        "flags": names.constant("RECORD_DRIVEN") if "phi_ddot" in taken else "0",
        "locked": "locked" in taken,
        "passed": [*taken, "x"],
    }


def _put_statements(f: Field, names: Names) -> list[str]:
    """Statements that write one member: rows of reals at once, integers one by one, structs by their own function."""
    place = f"from->{f.name}"
    if f.type is Kind.REAL:
        reals = names.function("record_put_reals")
        return over_rows(names, place, f.shape, lambda row, size: f"{reals}(page, {row}, {size});")
    if isinstance(f.type, Struct):
        put, prefix = names.function(f"record_put_{f.type.name}"), "&"
    else:
        put, prefix = names.function("record_put"), f"({names.function('record_word')})"
    last = "" if isinstance(f.type, Struct) else ", 4"
    return nested_loops(names, place, f.shape, lambda e, _: [f"{put}(page, {prefix}{e}{last});"])
