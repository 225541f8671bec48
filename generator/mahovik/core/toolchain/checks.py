"""What compilers, an analyser, cppcheck with MISRA C:2012 and libFuzzer are asked of a delivered folder.

cppcheck reads the C once as it is delivered: a folder has one element type, so there is nothing to configure.
"""

from __future__ import annotations

import shlex

from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.manifest import with_manifest
from mahovik.core.emit.names import VERIFICATION
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.emit.selftest import fuzz_harness
from mahovik.core.emit.templates import template
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import identities
from mahovik.core.toolchain.compiler import BITS

WARNINGS = (
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Wshadow",
    "-Wundef",
    "-Wcast-qual",
    "-Wfloat-equal",
    "-Werror",
)
"""Options of both compilers: a warning is an error."""

ANALYSER = ("clang", "-std=c99", "--analyze", "--analyzer-output", "text", "-Xclang", "-analyzer-werror")

CPPCHECK = (
    "cppcheck",
    "-q",
    "--addon=misra",
    "--enable=warning,portability,performance,style",
    # it reads no headers of the C library; without any -D it leaves out, without a word, a file that ends in #error
    *(f"-D{macro}" for macro in ("FLT_RADIX=2", "FLT_EVAL_METHOD=0", "FLT_MANT_DIG=24", "DBL_MANT_DIG=53")),
    "-DINT_MAX=2147483647",
    "--inconclusive",
    "--std=c99",
    "--suppress=missingIncludeSystem",
    "--template={id}:{file}:{line}",
)

DEVIATIONS = {
    "2.3": "a type whose only use is that it does not compile with a header of another element type",
    "2.4": "tags of structs and enums that are used by their typedef alone",
    "8.7": "functions of the header that no other file of the folder calls: they are the interface",
    "8.9": "tables that one function of the recorder reads stand at the top of its file",
    "8.14": "`restrict`: results of internal functions overlap no argument, and the compiler may know",
    "9.3": "a struct that begins as a copy of another, which the addon takes for a part of a list",
    "10.1": "a bit is chosen between by `?:`, an unsigned constant shifted by an int",
    "10.3": "the outcome of a comparison is kept as an int, 0 or 1, and chooses between reals",
    "10.4": "statuses are or-ed as bits, an int beside an enumerator; a size beside the constant 0",
    "10.6": "a constant of 32 bits chosen into a word of 64",
    "10.8": "a difference of ints, in 0 to 30, as the width of a shift",
    "12.1": "precedence of * over +, of comparison over &&: formulas as the model writes them, without more brackets",
    "12.3": "two variables in one declaration, sine and cosine of one phase; and declarations that the addon takes for "
    "the comma operator",
    "13.3": "an index that is used and moved on",
    "14.4": "a bit of a mask as a condition",
    "15.5": "a function returns where a check fails, before anything is written",
    "17.8": "an argument passed by value is shifted out byte by byte; zeros take the place of a null array",
    "19.2": "a union reads the bits of a real; defined in C99 (6.5.2.3, footnote 82)",
}
"""Rules of MISRA C:2012 that the emitted C does not keep, as the addon counts them, with the reason."""

STANDING_FINDINGS = {
    "incorrectLogicOperator": "`a > 0` or `a <= 0` is false of NaN, and that is what is asked",
    "oppositeExpression": "the same line",
    "variableScope": "a local array that stands before the branch which alone reads it",
}
"""Findings of cppcheck itself that stay, with the reason."""


# -- fuzzing by libFuzzer ----------------------------------------------------------------------------------------------

SANITIZERS = (
    "-fno-sanitize-recover=all",  # without it a fault is printed and the exit status is 0
    "-fsanitize=fuzzer,undefined,address,float-divide-by-zero",  # the last is not in `undefined`
    "-fno-sanitize-coverage=trace-cmp",  # a harness that draws from tables need not guess constants: half as fast again
)
FLAGS = ("-std=c99", "-g", "-O2", *BITS, "-Wall", "-Wextra", *SANITIZERS)
"""Compiler flags of a harness and what it calls."""

LIMITS = ("-len_control=0", "-max_len=1024", "-timeout=10", "-rss_limit_mb=0", "-malloc_limit_mb=64")
"""Options of a run: long inputs from the start; an input that takes seconds, or one large allocation, is a finding.

The limit of resident memory is off: libFuzzer reads the kernel's peak, which begins with the memory of the process that
started it, so that a large parent alone would be a finding.
"""


def sources(name: str) -> tuple[str, ...]:
    """Files that are compiled and linked."""
    return (f"{name}.c", f"{VERIFICATION}{name}_recorder.c", f"{name}_fuzz.c")


def fuzz_project(stand: Stand, real: str) -> dict[str, str]:
    """The project's files, text by file name. Raises StandError, UsageError."""
    generated = generate_all(stand, real)
    name = stand.name
    words = {
        "name": name,
        "NAME": name.upper(),
        "real": real,
        "flags": shlex.join(FLAGS),
        "limits": shlex.join(LIMITS),
        "sources": " ".join(sources(name)),
    }
    files = {
        **generated.files,
        **recorder_files(stand, generated),
        f"{name}_fuzz.c": fuzz_harness(generated.program, identities(stand)),
        "Makefile": template("fuzz.mk.j2").render(**words),
    }
    return with_manifest(stand, generated, files, "fuzz")
