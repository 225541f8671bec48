"""Self-tests of stands: delivered, tampered with, compiled and run on this machine."""

import re
import subprocess
from functools import cache
from pathlib import Path

from emit.stands import stand, write
from mahovik.core.emit.delivery import selftest_files
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.proof.verify.selftest import SelfTestLog, read_log
from toolchain.tools import compile_c


@cache
def generate_with_selftest(name: str, real: str = "double") -> tuple[Generated, dict[str, str]]:
    """Program and numbers of a stand, and its files with the self-test."""
    generated = generate_all(stand(name), real)
    return generated, {**generated.files, **selftest_files(stand(name), generated)}


def run_selftest(
    files: dict[str, str], name: str, folder: Path, compiler: str = "gcc", optimisation: str = "-O0", *flags: str
) -> tuple[int, str]:
    """Compile header, source and self-test with the strict warnings; return exit status and output."""
    write(files, folder)
    program = folder / "selftest"
    sources = (folder / f"verification/{name}_selftest.c", folder / f"{name}.c")
    flags = (f"-D{name.upper()}_SELFTEST_MAIN", *flags)
    compile_c(compiler, sources[0], optimisation, *flags, sources[1], "-o", program)
    done = subprocess.run([program], capture_output=True, text=True, check=False, timeout=120)
    return done.returncode, done.stdout


def failed(files: dict[str, str], name: str, folder: Path) -> tuple[set[str], SelfTestLog]:
    """Names of the functions that a self-test finds wrong, and its log; the exit status must agree."""
    status, printed = run_selftest(files, name, folder)
    (run,) = read_log(printed, "selftest")
    names = {f for f, line in run.functions.items() if line.startswith("FAIL")}
    assert run.failures == len(names)
    assert status == (1 if names else 0)
    return names, run


def replaced(text: str, old: str, new: str) -> str:
    """The text with its first `old`, which must be there, replaced."""
    assert old in text
    return text.replace(old, new, 1)


def in_function(source: str, name: str, function: str, pattern: str, new: str) -> str:
    """The source with the first match of a pattern in the body of one function replaced."""
    body = re.search(rf"^(?:\w+_CODE )?\w+ {name}_{function}\(.*?\n}}\n", source, re.DOTALL | re.MULTILINE)
    assert body is not None
    edited, count = re.subn(pattern, new, body[0], count=1)
    assert count == 1, body[0]
    return source[: body.start()] + edited + source[body.end() :]
