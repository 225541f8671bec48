"""Emitted C under the strict warnings of several compilers, and what is left in its objects."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from emit.stands import NAMES, float_texts, generated, stand, write
from mahovik.core.emit.generate import generate
from mahovik.core.program.expression import Place
from mahovik.core.program.walk import expressions
from mahovik.core.stand.random import BARE, EVERYTHING, Features, random_stand
from toolchain.quick import quick
from toolchain.tools import SSE, compile_c, require, require_32_bit, run

FLOAT_NAMES = ("bench8", "everything6", "bare0", "hung5")
FIRST = ("everything6", "hung5")


@pytest.fixture(scope="module", params=quick(len(FIRST), sorted(NAMES, key=lambda name: name not in FIRST)))
def source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The C file of a stand, its header beside it."""
    return write(generated(request.param).files, tmp_path_factory.mktemp(request.param))


@pytest.fixture(scope="module", params=quick(1, FLOAT_NAMES))
def float_source(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """C of an example in float, written."""
    return write(float_texts(stand(request.param))[3], tmp_path_factory.mktemp(request.param))


def symbols(thing: Path, *options: str) -> list[tuple[str, str]]:
    """Kind and name of the symbols of an object, as nm lists them."""
    lines = run(require("nm", "binutils"), *options, thing).splitlines()
    return [(line.split()[-2], line.split()[-1]) for line in lines]


def check_object(source: Path, tmp_path: Path) -> None:
    """gcc -O2 has no complaint, the object needs no library and defines nothing but names of its stand."""
    thing = tmp_path / "stand.o"
    compile_c(require("gcc", "gcc"), source, "-O2", "-c", "-o", thing)
    assert {name for _, name in symbols(thing, "-u")} <= {"memcpy", "memmove", "memset"}
    defined = [(kind, name) for kind, name in symbols(thing, "--defined-only") if not name.startswith(".")]
    assert defined
    assert [name for _, name in defined if not name.startswith(f"{source.stem}_")] == []
    assert {kind for kind, _ in defined} <= set("TtRr")  # code, constants, and no data that could change
    header = source.with_suffix(".h").read_text()
    for _, name in symbols(thing, "--defined-only", "--extern-only"):
        assert re.search(rf"\b{name}\b", header), f"{name} is no static, and not in the header"


@pytest.mark.slow
def test_gcc_at_full_warnings_and_bare_objects(source: Path, tmp_path: Path) -> None:
    check_object(source, tmp_path)


@pytest.mark.slow
def test_gcc_with_float(float_source: Path, tmp_path: Path) -> None:
    check_object(float_source, tmp_path)


def test_clang(source: Path) -> None:
    compile_c(require("clang", "clang"), source, "-fsyntax-only")


def test_clang_with_float(float_source: Path) -> None:
    compile_c(require("clang", "clang"), float_source, "-fsyntax-only")


def test_32_bits(source: Path) -> None:
    compile_c(require_32_bit(), source, *SSE, "-fsyntax-only")


def test_header_alone_and_twice_in_c_and_cpp(source: Path, tmp_path: Path) -> None:
    twice = f'#include "{source.stem}.h"\n#include "{source.stem}.h"\n'
    user = tmp_path / "user.c"
    user.write_text(twice)
    compile_c(require("gcc", "gcc"), user, f"-I{source.parent}", "-fsyntax-only")
    user = tmp_path / "user.cpp"
    user.write_text(twice)
    flags = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", f"-I{source.parent}")
    run(require("g++", "g++"), *flags, "-fsyntax-only", user)


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_after_complex_and_tgmath(source: Path, compiler: str) -> None:
    """Macros of the standard library, such as I, replace no word of header or source."""
    macros = ("-include", "complex.h", "-include", "tgmath.h")
    compile_c(require(compiler, compiler), source, *macros, "-fsyntax-only")


def test_cpp_calls_the_c(tmp_path: Path) -> None:
    source = write(generated("bench8").files, tmp_path)
    user, thing, program = tmp_path / "user.cpp", tmp_path / "stand.o", tmp_path / "user"
    user.write_text("""#include "bench8.h"
int main()
{
    bench8_state x = {};
    const bench8_real phi_ddot[BENCH8_N] = {};
    bench8_real V_dot[6];
    x.attitude[0] = 1.0;
    return bench8_forward(&bench8_default, &x, phi_ddot, V_dot) == BENCH8_OK ? 0 : 1;
}
""")
    compile_c(require("gcc", "gcc"), source, "-c", "-o", thing)
    run(require("g++", "g++"), "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", user, thing, "-o", program)
    run(program)


def test_a_header_of_another_stand_is_refused(tmp_path: Path) -> None:
    source = write(generated("bench8").files, tmp_path)
    header = source.with_suffix(".h")
    header.write_text(re.sub(r"(PHYSICS +0x)[0-9a-f]{8}", r"\g<1>00000001", header.read_text()))
    with pytest.raises(AssertionError, match="are of different stands"):
        compile_c(require("gcc", "gcc"), source, "-fsyntax-only")


CLASHES = """
n N ok range h structure physics w1 W1 w1_1 W1_1 max_phase largest not_finite code const_ real
wrenches wrench_carrier w wrench_w WRENCH_W WRENCHES_0 x stand status phi s c V F out i j k
NULL EOF INT32_MAX errno main abs uint64_t
"""
"""Names of flywheels: like our own, like one another in capitals, like variables of the C, like names of libc."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "features"), quick(1, [("B", EVERYTHING), ("bench", BARE), ("c", EVERYTHING), ("x_", BARE)])
)
def test_names_that_clash(name: str, features: Features, tmp_path: Path) -> None:
    names = CLASHES.split()
    given = random_stand(np.random.default_rng(5), len(names), features, name)
    wheels = zip(given.flywheels, names, strict=True)
    given = replace(given, flywheels=tuple(replace(w, name=n, wrench_input=features is EVERYTHING) for w, n in wheels))
    source = write(generate(given), tmp_path)
    compile_c(require("gcc", "gcc"), source, "-fsyntax-only")


def test_no_local_is_named_like_a_global_of_some_stand() -> None:
    """A local `mass_table` would hide the type of a stand called `mass`."""
    program = generated("everything6").program
    taken = {f.name for f in program.functions} | {s.name for s in program.structs}
    taken |= {"default", "default_parameters", "status", "real", "word", "bits_of", "real_of"}
    local = {e.root.name for f in program.functions for e in expressions(f.body) if isinstance(e, Place)}
    hidden = {(name, t) for name in local for t in taken if name.endswith(f"_{t}")}
    # `wrench` of a stand called `mount` is mount_wrench, as is the result of mounts, which does not call it
    assert hidden == {("mount_wrench", "wrench")}
