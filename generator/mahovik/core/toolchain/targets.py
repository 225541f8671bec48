"""Processors that emitted C is built for and run on: compiler, emulator, memories.

Figures of the boards: QEMU's documentation of the MPS2, MPS3 and RISC-V `virt` machines. The embedded boards are run
by their own startup and linker scripts, which stand in templates/board/.
"""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from mahovik.core.emit.templates import source_text, template
from mahovik.core.toolchain import process
from mahovik.core.toolchain.compiler import BITS, WARNINGS
from mahovik.errors import ToolchainError
from mahovik.writing import write_all

_NUMBER = re.compile(r"(?:^|[\s-])(\d+(?:\.\d+)+)(?=[\s,]|-[a-z]|$)")


@dataclass(frozen=True)
class Memory:
    """A stretch of the board's memory: first address, and length in bytes."""

    origin: int
    length: int


@dataclass(frozen=True)
class Target:
    """One processor and compiler, as `name` on the command line.

    `family` is "cortex-m", "riscv" or "hosted": a folder of templates/board. `compiler` is the command with the flags
    of the processor; `linker` likewise, where clang compiles and gcc links (its board files are compiled by the
    linker's gcc); `emulator` is the command before the program's file, empty where the program runs as it is. `real`
    is the widest type that the hardware calculates with, "" where there is no FPU. `mhz` is the clock of the emulated
    board, which SysTick counts. `needs` are words in the flags of /proc/cpuinfo that a program of this target wants.
    `packages` are those of Debian that have compiler and emulator.
    """

    name: str
    title: str
    family: str
    compiler: tuple[str, ...]
    emulator: tuple[str, ...] = ()
    linker: tuple[str, ...] = ()
    optimisation: str = "-O2"
    real: str = "double"
    code: Memory | None = None
    data: Memory | None = None
    mhz: int = 0
    needs: tuple[str, ...] = ()
    packages: tuple[str, ...] = ()

    @property
    def link(self) -> tuple[str, ...]:
        """The command that compiles board files and links."""
        return self.linker or self.compiler

    def missing_commands(self) -> tuple[str, ...]:
        """Commands that are not installed."""
        wanted = (self.compiler[0], self.link[0], *self.emulator[:1])
        return tuple(dict.fromkeys(command for command in wanted if shutil.which(command) is None))

    def obstacle(self) -> str:
        """Why this machine can build the target but not run it; "" where it can."""
        if not self.needs:
            return ""
        flags = _processor_flags()
        lacking = [word for word in self.needs if word not in flags]
        return f"this processor has no {', '.join(lacking)}" if lacking else ""


def _processor_flags() -> frozenset[str]:
    """Features of the host's processor, as named by Linux; empty elsewhere."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return frozenset()
    processor_flags = next((line for line in lines if line.startswith("flags")), "")
    return frozenset(processor_flags.partition(":")[2].split())


_KIB = 1024
_ARM = ("arm-none-eabi-gcc", "-mthumb")
_ARM_PACKAGES = ("gcc-arm-none-eabi", "libnewlib-arm-none-eabi", "qemu-system-arm")
_RISCV = ("riscv64-unknown-elf-gcc", "--specs=picolibc.specs", "-mcmodel=medany")
_RISCV_PACKAGES = ("gcc-riscv64-unknown-elf", "picolibc-riscv64-unknown-elf", "qemu-system-misc")
_SEMIHOSTING = (
    *("-display", "none", "-monitor", "none", "-serial", "none"),
    *("-chardev", "stdio,id=console", "-semihosting-config", "enable=on,target=native,chardev=console"),
    *("-icount", "shift=0"),
)
"""Text to stdout; one instruction a nanosecond, so that counts are the same in every run."""


def _cortex(
    name: str, title: str, flags: str, machine: str, code: int, data: int, mhz: int, real: str, length: int = 4096
) -> Target:
    return Target(
        name,
        title,
        "cortex-m",
        (*_ARM, *flags.split()),
        ("qemu-system-arm", "-M", machine, *_SEMIHOSTING, "-kernel"),
        real=real,
        code=Memory(code, length * _KIB),
        data=Memory(data, 256 * _KIB),
        mhz=mhz,
        packages=_ARM_PACKAGES,
    )


def _riscv(name: str, title: str, arch: str, abi: str, real: str) -> Target:
    system = "qemu-system-riscv64" if arch.startswith("rv64") else "qemu-system-riscv32"
    return Target(
        name,
        title,
        "riscv",
        (*_RISCV, f"-march={arch}", f"-mabi={abi}"),
        (system, "-M", "virt", "-bios", "none", *_SEMIHOSTING, "-kernel"),
        real=real,
        code=Memory(0x80000000, 4096 * _KIB),
        data=Memory(0x80400000, 256 * _KIB),
        packages=_RISCV_PACKAGES,
    )


_M55 = "-mcpu=cortex-m55 -mfloat-abi=hard -fno-tree-vectorize"
"""The vector unit of the M55 flushes subnormal floats to zero, so loops must not use it."""

_EMBEDDED = (
    _cortex("m3", "Cortex-M3, no FPU", "-mcpu=cortex-m3 -mfloat-abi=soft", "mps2-an385", 0, 0x20000000, 25, ""),
    _cortex(
        "m4",
        "Cortex-M4F, float FPU",
        "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard",
        *("mps2-an386", 0, 0x20000000, 25, "float"),
    ),
    _cortex(
        "m7",
        "Cortex-M7, double FPU",
        "-mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard",
        *("mps2-an500", 0, 0x20000000, 25, "double"),
    ),
    _cortex(
        "m33",
        "Cortex-M33, float FPU",
        "-mcpu=cortex-m33 -mfpu=fpv5-sp-d16 -mfloat-abi=hard",
        *("mps2-an505", 0x10000000, 0x38000000, 20, "float"),
    ),
    _cortex("m55", "Cortex-M55, double FPU", _M55, "mps3-an547", 0x10000000, 0x30000000, 32, "double", 512),
    _riscv("rv32imac", "RV32IMAC, no FPU", "rv32imac", "ilp32", ""),
    _riscv("rv32imafc", "RV32IMAFC, float FPU", "rv32imafc", "ilp32f", "float"),
    _riscv("rv32gc", "RV32GC, double FPU", "rv32gc", "ilp32d", "double"),
    _riscv("rv64imac", "RV64IMAC, no FPU", "rv64imac", "lp64", ""),
    _riscv("rv64gc", "RV64GC, double FPU", "rv64gc", "lp64d", "double"),
)

_AARCH64 = Target(
    "aarch64",
    "AArch64, Linux",
    "hosted",
    ("aarch64-linux-gnu-gcc", "-static"),
    ("qemu-aarch64",),
    packages=("gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross", "qemu-user"),
)


_UNFUSED = "-fno-tree-slp-vectorize"
"""gcc 12 makes `vfmaddsub` of neighbouring sums and differences of products, despite -ffp-contract=off, where it
vectorises straight code for an x86-64 with FMA: two roundings become one. Loops over lanes it leaves as they are."""


def _host(name: str, title: str, command: str, optimisation: str, march: str = "", needs: str = "") -> Target:
    flags = [f"-march={march}"] if march else []
    flags += [_UNFUSED] if march and command == "gcc" else []
    packages = ("clang",) if command == "clang" else ("gcc", "libc6-dev")
    return Target(
        name,
        title,
        "hosted",
        (command, *flags),
        optimisation=optimisation,
        needs=tuple(needs.split()),
        packages=packages,
    )


_V3 = "avx avx2 bmi1 bmi2 f16c fma abm movbe"
_V4 = f"{_V3} avx512f avx512bw avx512cd avx512dq avx512vl"

_HOSTS = (
    _host("host", "this machine", "gcc", "-O2"),
    _host("host-gcc-O0", "this machine", "gcc", "-O0"),
    _host("host-gcc-O1", "this machine", "gcc", "-O1"),
    _host("host-gcc-O3", "this machine", "gcc", "-O3"),
    _host("host-gcc-v3", "x86-64-v3: AVX2, FMA", "gcc", "-O2", "x86-64-v3", _V3),
    _host("host-gcc-v4", "x86-64-v4: AVX-512", "gcc", "-O3", "x86-64-v4", _V4),
    _host("host-gcc-native", "this machine, all it has", "gcc", "-O3", "native"),
    _host("host-clang", "this machine", "clang", "-O2"),
    _host("host-clang-v3", "x86-64-v3: AVX2, FMA", "clang", "-O2", "x86-64-v3", _V3),
)


def _by_clang(target: Target, triple: str, flags: str) -> Target:
    """The stand's C compiled by clang, without any C library's headers; board and linking as they are."""
    return replace(
        target,
        name=f"{target.name}-clang",
        compiler=("clang", f"--target={triple}", "-ffreestanding", *flags.split()),
        linker=target.compiler,
        packages=("clang", *target.packages),
    )


def _embedded_target(name: str) -> Target:
    return next(target for target in _EMBEDDED if target.name == name)


_CLANG = (
    _by_clang(_embedded_target("m4"), "thumbv7em-none-eabihf", "-mcpu=cortex-m4"),
    _by_clang(_embedded_target("m7"), "thumbv7em-none-eabihf", "-mcpu=cortex-m7"),
    _by_clang(_embedded_target("rv64gc"), "riscv64-unknown-elf", "-march=rv64gc -mabi=lp64d -mcmodel=medany"),
)

TARGETS: dict[str, Target] = {target.name: target for target in (*_HOSTS, *_EMBEDDED, *_CLANG, _AARCH64)}
"""All targets by name, in the order of tables."""


# -- programs for a target, with its startup, linker script and console, on its emulator -------------------------------

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
    """Name and version of a program, "arm-none-eabi-gcc 12.2.1". Raises ToolchainError where it cannot be run."""
    number = _NUMBER.search(_run([command, "--version"], Path.cwd(), "--version"))
    return f"{command} {number[1] if number else '?'}"


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
