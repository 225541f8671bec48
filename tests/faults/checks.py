"""The named checks on emitted C. Each says how a fault showed, and nothing where it finds none."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from faults.drivers import NULLS, nulls, routines
from faults.emitted import Emitted, Host, Planted, files_of, first_error, stand_of, states_of
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.manifest import manifest
from mahovik.errors import ToolchainError
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.compare import Row, same_bits
from mahovik.proof.verify.harness import check_bits, judge
from mahovik.proof.verify.refusals import check_refusals, good_inputs, raw_call
from mahovik.proof.verify.selftest_log import problems, read_log
from toolchain.tools import FIRMWARE_WARNINGS, require

if TYPE_CHECKING:
    from mahovik.proof.verify.c_backend import CBackend

Run = Callable[[Emitted], str]


@dataclass(frozen=True)
class Check:
    """A check by its name. `meaning`: what it does; `where`: where the project runs it."""

    name: str
    meaning: str
    where: str
    run: Run


CHECKS: dict[str, Check] = {}


def check(name: str, meaning: str, where: str) -> Callable[[Run], Run]:
    """Enters a function among the checks."""

    def enter(run: Run) -> Run:
        CHECKS[name] = Check(name, meaning, where, run)
        return run

    return enter


@check("compilers", "gcc and clang with the strict warnings", "`tests/emit/test_compilers.py`, every `verify`")
def compilers(made: Emitted) -> str:
    for compiler, package, flags in (
        ("gcc", "gcc", ("-O2", "-c", "-o", "/dev/null")),
        ("clang", "clang", ("-fsyntax-only",)),
    ):
        command: list[str | Path] = [
            require(compiler, package),
            *FIRMWARE_WARNINGS,
            "-ffp-contract=off",
            *made.flags,
            *flags,
        ]
        done = subprocess.run([*command, str(made.source)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return f"{compiler}: {first_error(done.stderr)}"
    return ""


@check("self-test", "the delivered self-test on this machine", "`NAME_selftest.c`, on any target")
def self_test(made: Emitted) -> str:
    done = ran(made, "-O0")
    if done.returncode < 0:
        return f"ended by signal {-done.returncode}"
    (log,) = read_log(done.stdout, made.name)
    found = problems(log)
    return found[0] if found else ""


@check("sanitizers", "the self-test with AddressSanitizer and UBSan", "`tests/lower/test_undefined.py`")
def sanitizers(made: Emitted) -> str:
    done = ran(made, "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    return "" if done.returncode in (0, 1) and not done.stderr else first_error(done.stderr)


@check("memory", "the self-test under valgrind: nothing read that was not written", "`tests/lower/test_undefined.py`")
def memory(made: Emitted) -> str:
    program = made.program(f"verification/{made.name}_selftest.c", "-O1", "-g")
    command: list[str | Path] = [require("valgrind", "valgrind"), "-q", "--error-exitcode=9", program]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    return "" if done.returncode in (0, 1) else done.stderr.strip().splitlines()[0].partition("== ")[2]


def ran(made: Emitted, *flags: str) -> subprocess.CompletedProcess[str]:
    program = made.program(f"verification/{made.name}_selftest.c", *flags)
    return subprocess.run([program], capture_output=True, text=True, check=False, timeout=120)


@check("bits", "compiled C = interpreter, bit for bit", "every `verify`")
def same_as_interpreter(made: Emitted) -> str:
    like = cast("CBackend", made.backend)  # has of it all that `check_bits` asks for, and no generated text of its own
    return finding(check_bits(like, states_of(made.host), None))


@check("comparison", "C, reference and second derivation", "every `verify`")
def comparison(made: Emitted) -> str:
    backend, host = made.backend, made.host
    rows = judge(stand_of(host), backend, states_of(host), backend.wants, BOUNDS[host.real], second=second_of(host))
    found = [row.quantity for row in rows if row.failed]
    return f"{', '.join(found[:6])}{' ...' if len(found) > 6 else ''}"


@cache
def second_of(host: Host) -> Second:
    """The second derivation of a host's stand."""
    return Second(stand_of(host))


@check("refusals", "one bad number at a time: status, outputs untouched", "every `verify`")
def bad_numbers(made: Emitted) -> str:
    backend = made.backend
    return finding(check_refusals(backend.program, good_inputs(backend, states_of(made.host)), raw_call(backend)))


def finding(row: Row) -> str:
    """Finding of a row of the harness, empty if it passed."""
    return "" if not row.failed else f"{row.reason} ({row.state})"


@check("null pointers", "every pointer argument NULL in turn", "`tests/lower/test_motion.py`, fuzzing")
def null_pointers(made: Emitted) -> str:
    (made.folder / NULLS).write_text(nulls(made.backend.program, made.name))
    done = subprocess.run([made.program(NULLS)], capture_output=True, text=True, check=False, timeout=60)
    return done.stdout.strip() if done.returncode == 0 else f"ended by signal {-done.returncode}"


@check(
    "no stand's table",
    "tables without mass or with a negative moment of inertia are refused",
    "`tests/lower/test_unphysical.py`",
)
def unphysical_tables(made: Emitted) -> str:
    backend = made.backend
    given = backend.arguments(states_of(made.host)[0][1]) | {"phi_ddot": [0.0] * len(stand_of(made.host).flywheels)}
    for name in ("forward", "forward_jacobian"):  # each has pivots of its own
        function = backend.program.function(name)
        names = {a.name for a in function.arguments}
        for axis in range(3):
            table = backend.library.value(function, "table")
            table["inertia"] = [-1e3 if i == axis else 1e3 if i < 3 else 0.0 for i in range(6)]
            inputs = {n: v for n, v in (given | {"table": table}).items() if n in names}
            status, untouched = backend.library.probe(function, inputs)
            if status != STATUS_VALUES["NOT_POSITIVE_DEFINITE"] or not untouched:
                return f"{name} with J{axis + 1}{axis + 1} < 0: status {status}"
    return ""


@check("singular attitude", "angles at and near the singularity are refused", "`tests/lower/test_refusals.py`")
def singular_attitude(made: Emitted) -> str:
    backend = made.backend
    given = backend.arguments(states_of(made.host)[0][1])
    for off in (0.0, 1e-9, -5e-7):
        status, untouched = backend.library.probe(
            backend.program.function("generalized"),
            {"table": backend.library.default("default"), "x": given["x"], "angles": [0.3, np.pi / 2 + off, 0.1]}
            | {name: given[name] for name in ("phi_ddot", "wrench") if name in given},
        )
        if status != STATUS_VALUES["SINGULAR_ATTITUDE"] or not untouched:
            return f"theta = pi/2 {off:+g}: status {status}"
    return ""


@check("wrap", "angles next to odd multiples of pi", "`tests/lower/test_phases.py`")
def wrapping(made: Emitted) -> str:
    backend = made.backend
    for turn in (n + off for n in (0, 2000, 500_000, 1_200_000, 1_500_000) for off in range(1, 200, 2)):
        for ulps in range(-3, 4):
            phi = float(turn * np.pi + ulps * np.spacing(turn * np.pi))
            wrapped = backend.library.run(backend.program.function("wrap"), {"phi": phi})[1]["wrapped"]
            if abs(wrapped) > np.pi or abs(np.sin(wrapped) - np.sin(phi)) > 1e-13 or np.cos(wrapped) > 0:
                return f"wrap({phi!r}) = {wrapped!r}"
    return ""


@check("time steps", "order of convergence of step, steps that cannot be refused", "`tests/lower/test_motion.py`")
def time_steps(made: Emitted) -> str:
    backend = made.backend
    given = {**backend.arguments(states_of(made.host)[0][1]), "table": backend.library.default("default")}
    given["locked"] = [0] * len(stand_of(made.host).flywheels)
    step = backend.program.function("step")
    for bad in ({"dt": 0.0}, {"dt": -1e-3}, {"order": 3}):
        inputs = given | {"dt": 1e-3, "order": 4} | bad
        status, _ = backend.library.probe(step, {a.name: inputs[a.name] for a in step.arguments if a.direction == "in"})
        if status != STATUS_VALUES["BAD_ARGUMENT"]:
            return f"status {status} for {', '.join(f'{name} = {value}' for name, value in bad.items())}"
    for order in (2, 4):
        ends = [_moved(backend, given, order, count) for count in (8, 16, 32)]
        found = float(np.log2(np.linalg.norm(ends[1] - ends[0]) / np.linalg.norm(ends[2] - ends[1])))
        if not abs(found - order) < 0.5:
            return f"order {order} converges with {found:.1f}"
    return ""


def _moved(backend: Planted, given: dict[str, Any], order: int, count: int) -> np.ndarray:
    """V and phi' after 4 ms in this many steps."""
    x, step = given["x"], backend.program.function("step")
    for _ in range(count):
        inputs = given | {"x": x, "dt": 0.004 / count, "order": order}
        status, out = backend.library.run(step, {a.name: inputs[a.name] for a in step.arguments if a.direction == "in"})
        assert status >= 0
        x = out["next"]
    return np.array([*x["V"], *x["phi_dot"]])


@check("in place", "results that may overlap an input, over that input", "here alone")
def in_place(made: Emitted) -> str:
    backend, ffi = made.backend, made.backend.library.ffi
    call, table = backend.library.function("forward"), backend.library.default("default")
    state = backend.arguments(states_of(made.host)[0][1])
    x = ffi.new(f"{made.name}_state *", {n: list(map(float, v)) for n, v in state["x"].items()})
    phi_ddot = ffi.new(f"{made.name}_real[]", list(map(float, state["phi_ddot"])))
    apart = ffi.new(f"{made.name}_real[6]")
    first = call(table, x, phi_ddot, apart)
    second = call(table, x, phi_ddot, x.V)
    return "" if (first, list(apart)) == (second, list(x.V)) else "forward with its result over x->V"


@check("object", "symbols: nothing from elsewhere, no data that can change", "`tests/emit/test_compilers.py`")
def bare_object(made: Emitted) -> str:
    found = symbols(made, require("gcc", "gcc"), "-O2")
    wanted = {name for kind, name in found if kind == "U"} - {"memcpy", "memmove", "memset"}
    changing = {name for kind, name in found if kind in "DdBbC"}
    return f"wants {', '.join(sorted(wanted))}" if wanted else f"data {', '.join(sorted(changing))}" if changing else ""


@check("no double", "objects and literals of a float stand", "`tests/emit/test_float_purity.py`")
def no_double(made: Emitted) -> str:
    arm = require("arm-none-eabi-gcc", "gcc-arm-none-eabi libnewlib-arm-none-eabi")
    found = symbols(made, arm, "-O2", "-mthumb", "-mcpu=cortex-m3", "-mfloat-abi=soft")
    helpers = sorted(name for _, name in found if re.fullmatch(r"__aeabi_(c?d|[a-z]+2d).*", name))
    text = re.sub(r"/\*.*?\*/", "", made.source.read_text(), flags=re.DOTALL)
    bare = [n for n in re.findall(r"(?<![\w.])\d+\.\d+(?:e[-+]?\d+)?\w*", text) if not n.endswith("F")]
    return f"calls {helpers[0]}" if helpers else f"literal {bare[0]}" if bare else ""


def symbols(made: Emitted, compiler: str, *flags: str) -> list[tuple[str, str]]:
    """(kind, name) of what nm lists of the object."""
    thing = made.folder / "stand.o"
    command = [compiler, "-std=c99", "-w", "-ffp-contract=off", *flags, "-c", str(made.source), "-o", str(thing)]
    subprocess.run(command, check=True, capture_output=True)
    done = subprocess.run([require("nm", "binutils"), str(thing)], check=True, capture_output=True, text=True)
    return [(kind, name) for kind, name in re.findall(r"(\w) (\S+)$", done.stdout, re.MULTILINE)]


@check("routines", "sine, cosine, root and arc tangent of the C against libm", "`tests/routines`")
def mathematics(made: Emitted) -> str:
    main = f"{made.name}_within.c"  # includes the source: its routines are static
    (made.folder / main).write_text(routines(made.name, made.host.real))
    done = subprocess.run([made.program(main, "-O1")], capture_output=True, text=True, check=False, timeout=60)
    return done.stdout.strip()


@check("manifest", "SHA-256 of the delivered files", "`manifest.json`, `mahovik generate --check`")
def listed(made: Emitted) -> str:
    hashes = json.loads(manifest(stand_of(made.host), made.host.real, files_of(made.host)))["files"]
    for name, text in made.files.items():
        if hashlib.sha256(text.encode()).hexdigest() != hashes[name]:
            return f"{name} is not what manifest.json lists"
    return ""


@check("prepare", "the table that the C makes of its own parameters is its own table", "`tests/lower/test_prepare.py`")
def prepared(made: Emitted) -> str:
    backend = made.backend
    table = backend.library.value(backend.program.function("forward"), "table")  # laws are no business of prepare
    given = {"parameters": backend.library.default("default_parameters"), "table": table}
    status, out = backend.library.run(backend.program.function("prepare"), given)
    different = [name for name in table if not same_bits(out["table"][name], table[name])]
    return f"status {status}" if status else ", ".join(different)


def outcome(name: str, made: Emitted) -> str:
    """Finding of a check on C; the compiler's refusal, if the check is about something else."""
    try:
        return CHECKS[name].run(made)
    except ToolchainError as error:
        return f"does not compile: {error}"
