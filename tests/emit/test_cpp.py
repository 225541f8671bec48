"""The header for C++17: no warning of any compiler, every function there, and the bits of the C."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from emit.stands import generated, stand, write
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.emit.cpp import cpp_example, cpp_header, namespace
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.stand.random import BARE, random_stand
from toolchain.tools import compile_c, require, run

STRICT = (
    *("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Wold-style-cast"),
    *("-Wundef", "-Wcast-qual", "-Werror"),
)
COMPILERS = (("g++", "g++", "c++17"), ("clang++", "clang", "c++20"))
NAMES = ("everything6", "bare0", "held3", "edge2")

USER = """#include "{name}.hpp"
#include "{name}.hpp"

int main()
{{
    namespace stand = mahovik::{name};
    stand::State x;
    stand::assign(x.V, {{0, 0, 0, 0, 0, 1}});
    const stand::Reals<6> V = stand::array_of(x.V);
    static_assert(stand::has(stand::Status::limited, stand::Status::limited), "a constant expression");
    return static_cast<int>(V[5]) - 1;
}}
"""


def check(name: str, made: Generated, folder: Path, compilers: tuple[tuple[str, str, str], ...]) -> None:
    """Each compiler takes the header, twice, with all warnings as errors."""
    write({**made.files, **cpp_header(stand(name), made), **cpp_example(stand(name), made)}, folder)
    user = folder / "user.cpp"
    user.write_text(USER.format(name=name))
    for compiler, package, standard in compilers:
        run(require(compiler, package), f"-std={standard}", *STRICT, "-fsyntax-only", user)
    run(require("g++", "g++"), "-std=c++17", *STRICT, "-fsyntax-only", folder / "example.cpp")


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_no_warning(name: str, tmp_path: Path) -> None:
    check(name, generated(name), tmp_path, COMPILERS)


@pytest.mark.parametrize("name", NAMES)
def test_every_function_and_status_is_there(name: str) -> None:
    made = generated(name)
    text = cpp_header(stand(name), made)[f"{name}.hpp"]
    defined = re.findall(r"^inline Status (\w+)\(", text, re.MULTILINE)
    assert defined == [f.name for f in made.program.functions if f.public]
    listed = re.findall(r"^    ([a-z_]+) = (-?\d+),? +/\*", text, re.MULTILINE)
    assert {word.upper(): int(value) for word, value in listed} == STATUS_VALUES


CALLS = """#include "bench8.hpp"
#include <cstring>
namespace stand = mahovik::bench8;

template <class T> bool same(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof(T)) == 0; }

int main()
{
    stand::State x;
    stand::assign(x.position, {0.1, -0.2, 0.3});
    stand::assign(x.V, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6});
    stand::assign(x.phi_dot, {100, -90, 80, -70, 60, -50, 40, -30});
    const bench8_state& c = x;
    const stand::Reals<stand::N> given{1, 2, 3, 4, 5, 6, 7, 8};
    stand::Reals<6> a{};
    stand::Reals<6> b{};
    int wrong = 0;

    wrong += stand::forward(stand::default_table, x, given, a) != stand::Status::ok;
    wrong += bench8_forward(&bench8_default, &c, given.data(), b.data()) != BENCH8_OK;
    wrong += !same(a, b) || a[1] == 0;

    stand::State next;
    bench8_state c_next;
    const stand::Ints<stand::N> locked{0, 1};
    wrong += stand::step(stand::default_table, x, given, locked, 1e-3, 4, next) != stand::Status::ok;
    wrong += bench8_step(&bench8_default, &c, given.data(), locked.data(), 1e-3, 4, nullptr, &c_next) != BENCH8_OK;
    wrong += !same<bench8_state>(next, c_next) || next.phi_dot[0] == x.phi_dot[0];
    wrong += stand::array_of(next.phi)[1] != c_next.phi[1];

    stand::InverseResult out{};
    stand::InverseOptions options = stand::default_options;
    options.limit[0] = 1e-3;
    const stand::Status status = stand::inverse(stand::default_table, x, {0, 0, 0, 1, 1, 1}, options, out);
    wrong += stand::refused(status) || !stand::has(status, stand::Status::limited) || out.limited[0] != 1;

    double wrapped = 0;
    wrong += stand::wrap(7.0, wrapped) != stand::Status::ok || wrapped > 1;
    const double before = wrapped;
    const stand::Status far = stand::wrap(1e9, wrapped);
    wrong += !stand::refused(far) || std::strcmp(stand::word(far), "RANGE") != 0 || wrapped != before;
    wrong += stand::step(stand::default_table, x, given, locked, 1e-3, 3, x) != stand::Status::bad_argument;
    return wrong;
}
"""


@pytest.mark.slow
def test_calls_have_the_bits_of_the_c(tmp_path: Path) -> None:
    made = generated("bench8")
    source = write({**made.files, **cpp_header(stand("bench8"), made)}, tmp_path)
    user, thing, program = tmp_path / "user.cpp", tmp_path / "stand.o", tmp_path / "user"
    user.write_text(CALLS)
    compile_c(require("gcc", "gcc"), source, "-O1", "-c", "-o", thing)
    run(require("g++", "g++"), "-std=c++17", "-Wall", "-Werror", "-fno-exceptions", user, thing, "-o", program)
    run(program)


def test_a_status_that_is_ignored_is_a_warning(tmp_path: Path) -> None:
    made = generated("bench8")
    write({**made.files, **cpp_header(stand("bench8"), made)}, tmp_path)
    user = tmp_path / "user.cpp"
    user.write_text('#include "bench8.hpp"\nvoid f(double& x) { mahovik::bench8::wrap(1, x); }\n')
    with pytest.raises(AssertionError, match="nodiscard"):
        run(require("g++", "g++"), "-std=c++17", "-Wall", "-Werror", "-fsyntax-only", user)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["std", "near", "N"])
def test_names_that_clash(name: str, tmp_path: Path) -> None:
    stand = random_stand(np.random.default_rng(5), 2, BARE, name)
    made = generate_all(stand)
    write({**made.files, **cpp_header(stand, made)}, tmp_path)
    user = tmp_path / "user.cpp"
    user.write_text(f'#include "{name}.hpp"\nmahovik::{namespace(stand)}::State x;\n')
    run(require("g++", "g++"), "-std=gnu++17", "-Dnear=", *STRICT, "-fsyntax-only", user)
