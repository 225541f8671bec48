"""Flights under the emitted recorder on this machine: random inputs through all that a log can hold."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cffi
import numpy as np

from emit.stands import stand as known_stand
from emit.stands import write
from mahovik.core.emit.generate import generate_all
from mahovik.core.emit.recorder import recorder_files
from mahovik.core.toolchain.compiler import BITS, WARNINGS, preprocess, run_compiler


class Recorder:
    """The compiled recorder of a stand of `emit.stands`. `log` grows by what it writes, `calls` has each piece.

    `full`: every write fails, and nothing is kept.
    """

    def __init__(self, name: str, real: str, folder: Path, edit: tuple[str, str] | None = None) -> None:
        self.name, self.real, self.stand = name, real, known_stand(name)
        self.generated = generate_all(self.stand, real)
        texts = self.generated.files | recorder_files(self.stand, self.generated)
        if edit is not None:
            assert edit[0] in texts[f"{name}.c"]
            texts[f"{name}.c"] = texts[f"{name}.c"].replace(*edit, 1)
        write(texts, folder)
        recorder = folder / "verification" / f"{name}_recorder"
        sources = [str(folder / f"{name}.c"), str(recorder.with_suffix(".c"))]
        library, plain = str(folder / "recorder.so"), f"-D{name.upper()}_PLAIN_NAMES"
        run_compiler([*WARNINGS, *BITS, "-O1", plain, "-shared", "-fPIC", *sources, "-o", library], name)
        self.ffi = cffi.FFI()
        declarations = preprocess(recorder.with_suffix(".h"), plain).replace("extern const ", "extern ")
        prototypes = declarations[declarations.index(f"typedef {real} {name}_real;") :]  # the system's headers left out
        self.ffi.cdef(prototypes)
        self.library: Any = self.ffi.dlopen(library)
        self.calls: list[bytes] = []
        self.full = False
        self._write = self.ffi.callback("int(void *, const unsigned char *, size_t)", self._take)
        self.new("recorder")

    def _take(self, context: Any, data: Any, count: int) -> int:
        if self.full:
            return -1
        self.calls.append(bytes(self.ffi.buffer(data, count)))
        return 0

    @property
    def log(self) -> bytes:
        return b"".join(self.calls)

    def new(self, kind: str) -> None:
        """A new log, beginning with a state at rest and the default table."""
        ffi, name = self.ffi, self.name
        self.recorder = ffi.new(f"{name}_recorder *", {"write": self._write})
        self.x = ffi.new(f"{name}_state *", {"attitude": [1.0, 0.0, 0.0, 0.0]})
        self.carry = ffi.new(f"{name}_step_carry *")
        self.table = ffi.new(f"{name}_table *", ffi.addressof(self.library, f"{name}_default")[0])
        self.calls.clear()

    def call(self, function: str, *arguments: Any) -> int:
        """A function of the recorder with log, table and state, and more arguments."""
        entry = getattr(self.library, f"{self.name}_recorder_{function}")
        return int(entry(self.recorder, self.table, self.x, *arguments))

    def fly(self, steps: int, seed: int = 1, every: int = 7) -> list[int]:
        """Steps of all kinds; a start before every `every`th. Returns their statuses."""
        rng = np.random.default_rng(seed)
        layout, count, ffi = self.generated.layout, len(self.stand.flywheels), self.ffi
        statuses = []
        for k in range(steps):
            if layout.stream and k % 3 == 2:
                self.table.stream = rng.normal(size=3).tolist()
            if k % every == 0:
                assert self.call("start") == 0
            if k % 4 == 1:
                self.x.position[0] += 1e-3
            if k % 5 == 1 and count:
                self.x.phi[count - 1] = rng.uniform(-3, 3)
            drive = [rng.normal(scale=1e-3, size=count).tolist()] if count else []
            if k == 10 and count:
                drive[0][0] = float("nan")
            locked = [[int(v) for v in rng.integers(0, 2, size=count)] if k % 2 else [0] * count] if count else []
            wrench = [rng.normal(size=6 * len(layout.inputs)) * (k % 3 > 0)] if layout.inputs else []
            settings = [1e-3 if k < 5 else 2e-3, 4 if k % 2 else 2]
            if k == 12:
                settings[1] = 3  # no such order
            driven = bool(count) and k % 6 == 5
            carry = self.carry if k % 3 == 1 or k > 15 else ffi.NULL
            if k == 16:
                self.carry.rounding[0] = 1e-9
            taken = [*drive, *([] if driven else locked), *(w.tolist() for w in wrench), *settings, carry]
            statuses.append(self.call("step_driven" if driven else "step", *taken))
        return statuses
