"""Processors that emitted C is built for and run on: compiler, emulator, memories.

Figures of the boards: QEMU's documentation of the MPS2, MPS3 and RISC-V `virt` machines. The embedded boards are run
by their own startup and linker scripts, which stand in templates/board/.
"""

from __future__ import annotations

import shutil
from dataclasses import dataclass, replace
from pathlib import Path


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
