"""An attitude loop of eye4, and its C in this process: structs and calls by ctypes."""

from __future__ import annotations

import ctypes as ct
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.emit.templates import source_text
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.out.export.project import ExportedAttitude, attitude_sources
from mahovik.stands import path
from mahovik.use.control.attitude import LoopOptions
from toolchain.tools import compile_c

Array = NDArray[np.float64]
N = 4
DEFAULT = LoopOptions()


def stand() -> Stand:
    """A satellite of 80 kg whose carrier takes a run-time wrench."""
    return load(path("eye4"))


@cache
def exported(real: str = "double", options: LoopOptions = DEFAULT) -> ExportedAttitude:
    """C of the loop, of the stand and of the example."""
    return attitude_sources(stand(), options, real)


def written(made: ExportedAttitude, folder: Path) -> Path:
    """All sources in a folder, with the console of this machine; returns the folder."""
    for name, text in {**made.files, "board.h": "", "board.c": ""}.items():
        (folder / name).write_text(text, encoding="ascii")
    for name in ("board.h", "hosted/board.c"):
        (folder / Path(name).name).write_text(source_text(f"board/{name}"), encoding="ascii")
    return folder


def example(folder: Path, *flags: str, name: str = "eye4") -> dict[str, str]:
    """Lines that the example prints, compiled with the strict warnings, by their first words."""
    sources = [folder / f"{name}.c", folder / f"{name}_attitude.c", folder / "board.c"]
    compile_c("gcc", folder / "main.c", "-O2", f"-I{folder}", *flags, *sources, "-o", folder / "main")
    done = subprocess.run([folder / "main"], capture_output=True, text=True, check=False, timeout=60)
    lines = done.stdout.splitlines()
    assert done.returncode == (lines[-1] != "failures 0"), done.stdout
    return {line.partition(" " if ":" not in line else ":")[0]: line for line in lines if line[:7] != "samples"} | {
        line.rpartition(" ")[0]: line for line in lines if line[:7] == "samples"
    }


# -- structs -----------------------------------------------------------------------------------------------------------

_SETTINGS = (
    *("period", "bandwidth", "damping", "integral", "integral_most", "closing_rate", "slew_rate", "slew_acceleration"),
    *(("preferred", N), "preferred_rate", "avoid", ("viscous", N), ("coulomb", N), ("coulomb_speed", N)),
    *(("wanted_momentum", 3), "dump_rate", "dump_torque", "dump_begin", "dump_end"),
)


def _struct(name: str, *members: Any) -> Any:
    """A struct of doubles; a member is a name, a name with a number, or a name with a type."""
    fields = []
    for member in members:
        key, kind = (member, ct.c_double) if isinstance(member, str) else member
        fields.append((key, ct.c_double * kind if isinstance(kind, int) else kind))
    return type(name, (ct.Structure,), {"_fields_": fields})


Config = _struct("Config", *_SETTINGS)
Course = _struct("Course", ("start", 4), ("axis", 3), "angle", "duration")
Loop = _struct("Loop", ("course", Course), ("tick", ct.c_int), ("integral", 3), ("dumping", ct.c_int))
Reference = _struct("Reference", ("attitude", 4), ("rate", 3), ("acceleration", 3))
Demand = _struct("Demand", ("error", 3), ("rate_error", 3), ("wanted", 3), ("limited", ct.c_int))
State = _struct("State", ("position", 3), ("attitude", 4), ("V", 6), ("phi", N), ("phi_dot", N))
Result = _struct(
    "Result",
    *(("tau", N), ("moment", 3), ("momentum", 3), ("reference", Reference), ("demand", Demand), ("residual", 3)),
    *("share", ("limited", ct.c_int * N)),
)


class Attitude:
    """The functions of the loop, the settings of the export, the tables."""

    def __init__(self, folder: Path) -> None:
        name = folder / "loop.so"
        flags = ("-O1", "-DEYE4_PLAIN_NAMES", "-fPIC", "-shared")
        compile_c("gcc", folder / "eye4_attitude.c", *flags, folder / "eye4.c", "-o", name)
        self._library = ct.CDLL(str(name))
        self.table = ct.addressof(ct.c_double.in_dll(self._library, "eye4_default"))
        self._mean = (ct.c_double * 2000)()
        assert self.call("mean_table", ct.c_void_p(self.table), self._mean) == 0

    def config(self, **changed: Any) -> Any:
        """The settings of the export, with some changed."""
        made = Config.from_buffer_copy(Config.in_dll(self._library, "eye4_attitude_default"))
        for key, value in changed.items():
            kind = dict(Config._fields_)[key]
            setattr(made, key, value if kind is ct.c_double else kind(*value))
        return made

    def call(self, function: str, *arguments: Any) -> int:
        """Status of a function of the loop."""
        return int(self._library[f"eye4_attitude_{function}"](*arguments))

    def step(self, config: Any, loop: Any, x: Any, failed: tuple[int, ...] | None, out: Any, mean: bool = True) -> int:
        """`attitude_step`, with the mean table or the table itself."""
        flags = None if failed is None else (ct.c_int * N)(*failed)
        table = self._mean if mean else ct.c_void_p(self.table)
        return self.call("step", ct.byref(config), table, ct.byref(loop), ct.byref(x), flags, ct.byref(out))

    def play(self, x: Any, tau: Array, failed: tuple[int, ...], moment: Array, dt: float) -> int:
        """One step of the balanced plant; flywheels with flag 2 are locked, with flag 1 they get friction alone."""
        locked = (ct.c_int * N)(*(int(flag == 2) for flag in failed))
        wrench = numbers(0, 0, 0, *moment)
        carry = (ct.c_double * 21)()
        arguments = self._mean, ct.byref(x), numbers(*tau), locked, wrench, ct.c_double(dt), 4, carry, ct.byref(x)
        return int(self._library["eye4_step"](*arguments))

    def momentum(self, x: Any) -> Array:
        """`Z` of the stand's `momentum` by the mean table."""
        momentum = (ct.c_double * 19)()  # Z, Z0, energy, mass centre and its velocity
        assert int(self._library["eye4_momentum"](self._mean, ct.byref(x), momentum)) == 0
        return np.array(momentum[:6])


def numbers(*values: float) -> Any:
    """An array of doubles."""
    return (ct.c_double * len(values))(*values)
