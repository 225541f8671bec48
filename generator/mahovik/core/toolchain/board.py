"""A board: test programs built for a target with its startup, linker script and console, and run on its emulator."""

from __future__ import annotations

import shlex
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from mahovik.core.emit.templates import source_text, template
from mahovik.core.toolchain import process
from mahovik.core.toolchain.compiler import BITS, WARNINGS
from mahovik.core.toolchain.targets import Target
from mahovik.errors import ToolchainError
from mahovik.writing import write_all

_FILES = {
    "cortex-m": ("cortex-m/startup.c", "cortex-m/board.c", "cortex-m/link.ld", "board_stack.c", "board.h"),
    "riscv": ("riscv/startup.S", "riscv/board.c", "riscv/link.ld", "board_stack.c", "board.h"),
    "hosted": ("hosted/board.c", "board.h"),
}


def board_files(target: Target) -> dict[str, str]:
    """The board's own files, text by file name: C, startup, linker scripts."""
    files = {Path(name).name: source_text(f"board/{name}") for name in _FILES[target.family]}
    if target.code is not None and target.data is not None:
        memories = {"code": _memory(target.code.origin, target.code.length)}
        memories["data"] = _memory(target.data.origin, target.data.length)
        files["memory.ld"] = template("board/memory.ld.j2").render(board=target.title, **memories)
    return files


def compile_flags(target: Target) -> tuple[str, ...]:
    """Flags of every compilation of the stand's C, beside the compiler's command and the optimisation."""
    return (*BITS, *((f"-DBOARD_MHZ={target.mhz}u",) if target.mhz else ()))


def link_flags(target: Target) -> tuple[str, ...]:
    """Flags of linking, in the folder of the linker scripts."""
    if target.family == "hosted":
        return ()
    return ("-nostartfiles", "-T", "link.ld", "-Wl,--no-warn-rwx-segments")


def require(target: Target) -> None:
    """Raises ToolchainError that says what to install where compiler or emulator is missing, or cannot run here."""
    missing = target.missing_commands()
    if missing:
        raise ToolchainError(
            f"{target.name}: no {', '.join(missing)}: `make targets` in the repository, "
            f"or on Debian `apt-get install {' '.join(target.packages)}`"
        )
    if unable := target.obstacle():
        raise ToolchainError(f"{target.name}: {unable}")


def build(
    target: Target,
    sources: Mapping[str, str],
    scratch: Path,
    optimisation: str | None = None,
    extra: Sequence[str] = (),
) -> Path:
    """Builds C texts, one with `main`, with the board's files in `scratch`; returns the program's file.

    `optimisation` is the target's own unless given; `extra` flags are for the C texts alone. Raises ToolchainError,
    ValueError for a text with the name of a file of the board.
    """
    require(target)
    level = optimisation or target.optimisation
    support = board_files(target)
    if clash := sorted(support.keys() & sources.keys()):
        raise ValueError(f"{', '.join(clash)}: the board has a file of that name")
    write_all(scratch, {**support, **sources})
    objects = [
        *(compile_one(target, name, scratch, level, extra) for name in sources if name.endswith(".c")),
        *(compile_one(target, name, scratch, "-O2", board=True) for name in support if name.endswith((".c", ".S"))),
    ]
    program = scratch / "program.elf"
    _run([*target.link, *(o.name for o in objects), *link_flags(target), "-o", program.name], scratch, "linking")
    return program


def compile_one(
    target: Target, name: str, scratch: Path, optimisation: str, extra: Sequence[str] = (), board: bool = False
) -> Path:
    """One C file of `scratch` as an object; `board` for files of the board itself. Raises ToolchainError."""
    made = scratch / f"{Path(name).stem}.o"
    command = target.link if board else target.compiler
    flags = (*compile_flags(target), *WARNINGS, optimisation, *extra)
    _run([*command, *flags, "-I.", "-c", name, "-o", made.name], scratch, name)
    return made


def run(target: Target, elf: Path, timeout: float = 60) -> str:
    """Runs a program on the target's emulator, and returns what it printed.

    Raises ToolchainError in one line where it cannot be started, crashes, does not end or ends with a status.
    """
    require(target)
    command = [*target.emulator, str(elf)]
    try:
        done = process.run(command, elf.parent, timeout)
    except subprocess.TimeoutExpired:
        raise ToolchainError(f"{target.name}: no end within {timeout:g} s") from None
    except OSError as error:
        raise ToolchainError(f"{target.name}: {command[0]} cannot be run: {error.strerror}") from error
    printed = done.stdout
    if done.returncode != 0:
        said = (done.stderr.strip() or printed.strip()).splitlines()
        last = f": {said[-1]}" if said else ""
        raise ToolchainError(f"{target.name}: the program {_ending(done.returncode)}{last}")
    return printed


def version(command: str) -> str:
    """Name and version of a compiler or emulator, "arm-none-eabi-gcc 12.2.1". Raises ToolchainError."""
    words = _run([command, "--version"], Path.cwd(), "--version").splitlines()[0].replace(",", " ").split()
    number = next((w for w in reversed(words) if w[0].isdigit() and w.count(".") >= 2), None)
    number = next((w for w in words if w[0].isdigit() and w.count(".") >= 2 and w.replace(".", "").isdigit()), number)
    return f"{command} {number or '?'}"


def build_version(target: Target) -> str:
    """Compiler with version and optimisation, as tables show it. Raises ToolchainError."""
    return f"{version(target.compiler[0])} {target.optimisation}"


def selftest_main(name: str, sweep: int) -> str:
    """C of a `main` that runs the self-test of a stand with `sweep` states, and prints to the board's console."""
    return template("board/selftest_main.c.j2").render(name=name, sweep=sweep)


def _ending(status: int) -> str:
    if status == 99:
        return "crashed (fault handler)"
    return f"was killed by signal {-status}" if status < 0 else f"ended with status {status}"


def _memory(origin: int, length: int) -> dict[str, str]:
    return {"origin": f"0x{origin:08X}", "length": f"{length // 1024}K"}


def _run(command: Sequence[str], folder: Path, what: str) -> str:
    done = process.run(command, folder)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        words = ("error:", "undefined reference", "overflowed")
        first = next(
            (line for line in lines if any(word in line for word in words)), "".join(lines[:1]) or "no message"
        )
        raise ToolchainError(f"{shlex.join(command[:1])} refused {what}: {first}")
    return done.stdout
