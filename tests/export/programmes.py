"""Programmes made by hand, and their C: written, compiled, run."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from functools import cache
from math import atan2, pi
from pathlib import Path

import numpy as np
import pytest

from emit.stands import write
from mahovik import stands
from mahovik.core.emit.generate import generate_all
from mahovik.core.motion.functions import Fourier, Samples
from mahovik.core.motion.motion_file import load_motion
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.laws.suspension.law import Suspension
from mahovik.out.export.programme import ProgrammeExport, export_programme
from toolchain.tools import compile_c, compile_elsewhere, require, run, symbols_of

PERIOD = 0.05


@cache
def stand() -> Stand:
    """shaker2: two equal flywheels that turn in opposite senses."""
    return load(stands.path("shaker2"))


@cache
def motion() -> RequiredMotion:
    """The one motion that its flywheels give at constant speed."""
    return load_motion(stands.path("shaker2").parent / "shaker2_spin.motion.json", stand())


def _programme(course: Fourier | Samples, name: str = "shaker2_spin") -> Programme:
    return Programme.of(stand(), name, PERIOD, np.zeros(6), (1, -1), course)


@cache
def spin() -> Programme:
    """The programme of `motion`: constant speed, the phase behind by the damping of the suspension."""
    shaken = stand()
    held = shaken.law(Suspension)
    assert held is not None
    omega = 2 * pi / PERIOD
    mass = shaken.carrier.mass + sum(w.mass for w in shaken.flywheels)
    late = atan2(held.damping[2][2] * omega, mass * omega**2 - held.stiffness[2][2])
    left = -pi / 2 - late
    return _programme(Fourier(np.array([left, pi - left]), np.zeros((0, 2)), np.zeros((0, 2))))


@cache
def swaying(harmonics: int = 12) -> Programme:
    """Windings 1, -1 and harmonics that fall as those of real programmes do; of no motion in particular."""
    rng = np.random.default_rng(7)
    fall = 0.3 * 10.0 ** (-0.5 * np.arange(harmonics))[:, None]
    cos, sin = (fall * rng.normal(size=(harmonics, 2)) for _ in range(2))
    return _programme(Fourier(np.array([9.0, -0.4]), cos, sin))


@cache
def sampled() -> Programme:
    """`swaying` by a table of times that are not equally far from one another."""
    t = PERIOD * (np.arange(200) + 0.3 * np.sin(np.arange(200))) / 200
    return swaying().with_course(Samples(t, *swaying().at(t)))


def finite_course(duration: float, end: float = 40.0) -> Samples:
    """Course from rest to rest: both flywheels go by `end` rad, one back."""
    t = np.linspace(0.0, duration, 400)
    x = (t / duration)[:, None]
    way = np.array([[end, -end]])
    w, w1 = x**4 * (35 - 84 * x + 70 * x**2 - 20 * x**3), 140 * x**3 * (1 - x) ** 3
    w2 = 420 * x**2 * (1 - x) ** 2 * (1 - 2 * x)
    return Samples(t, 0.3 + way * w, way * w1 / duration, way * w2 / duration**2)


@cache
def finite() -> Programme:
    """A finite programme."""
    return Programme.of(stand(), swaying().motion, 0.8, np.zeros(6), None, finite_course(0.8))


@cache
def started() -> Programme:
    """`spin` with a run-up from rest, and its mirror image as run-down."""
    duration, omega = 0.2, 2 * pi / PERIOD
    t = np.linspace(0.0, duration, 257)
    x, turn = (t / duration)[:, None], np.array([[omega, -omega]])
    w, w1 = x**3 * (10 - 15 * x + 6 * x**2), 30 * x**2 * (1 - x) ** 2
    before = 0.5 - x**4 * (2.5 - 3 * x + x**2)
    end = spin().at(np.zeros(1)).phi
    up = Samples(t, end - turn * duration * before, turn * w, turn * w1 / duration)
    down = Samples(t, (2 * end - up.phi)[::-1], up.phi_dot[::-1], -up.phi_ddot[::-1])
    return replace(spin(), runup=RunUpTable(duration, up), rundown=RunUpTable(duration, down))


@cache
def stand_files(real: str) -> dict[str, str]:
    """The C of the stand."""
    return generate_all(stand(), real).files


@cache
def exported(name: str, kind: str = "quintic", real: str = "double") -> ProgrammeExport:
    """One of the programmes above as C, by its name; `spin` with its motion."""
    programme = {"spin": spin, "swaying": swaying, "sampled": sampled, "finite": finite, "started": started}[name]()
    limit = 1e-4 if name in ("sampled", "finite") and real == "double" else None
    return export_programme(stand(), programme, motion() if name == "spin" else None, kind, real=real, limit=limit)


def written(made: ProgrammeExport, folder: Path, real: str = "double") -> Path:
    """Programme and stand in a folder; returns the programme's source."""
    write({**stand_files(real), **made.files}, folder)
    return folder / "shaker2_programme.c"


def self_tested(source: Path, part: str, compiler: str = "gcc", *flags: str) -> list[str]:
    """Lines of the self-test of a part, `programme` or `servo`, compiled with the strict warnings."""
    program = source.parent / f"{part}_test"
    test = source.parent / f"verification/shaker2_{part}_test.c"
    compile_c(compiler, source, *(flags or ("-O1",)), f"-DSHAKER2_{part.upper()}_TEST_MAIN", test, "-o", program)
    done = subprocess.run([program], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == (0 if done.stdout.endswith("failures 0\n") else 1)
    return done.stdout.splitlines()


def check_delivered(source: Path, folder: Path, imported: set[str], exported: str) -> None:
    """Check a source under other compilers: bare objects, declared names, no `double` in C of float, no path or date.

    `imported`: names that it may use of others; `exported`: kinds of symbols that the header declares.
    """
    compile_elsewhere(source)
    listed = symbols_of(source, folder)
    assert {symbol for kind, symbol in listed if kind == "U"} <= {"memcpy", "memset", *imported}
    assert {kind for kind, _ in listed} <= set("UTtRr")  # no data that could change
    header = source.with_suffix(".h").read_text()
    assert all(re.search(rf"\b{symbol}\b", header) for kind, symbol in listed if kind in exported)
    code = re.sub(r"/\*.*?\*/", "", source.read_text(), flags=re.DOTALL)
    if "typedef float" in "".join(path.read_text() for path in source.parent.glob("*.h")):
        assert "double" not in code
        assert re.findall(r"(?<![\w.])\d+\.\d+(?:e[-+]?\d+)?(?![\dFe])", code) == []
    assert not re.search(r"/(home|work|tmp|usr|root)/|20\d\d-\d\d", source.read_text() + header)


def check_other_headers(source: Path) -> None:
    """Check that a source refuses the header of another stand and that of the other element type."""
    header = source.parent / "shaker2.h"
    text = header.read_text()
    for macro in ("STRUCTURE", "PHYSICS"):
        header.write_text(re.sub(rf"({macro} +0x)[0-9a-f]{{8}}", r"\g<1>00000001", text))
        with pytest.raises(AssertionError, match="are of different stands"):
            compile_c(require("gcc", "gcc"), source, "-fsyntax-only")
    header.write_text(stand_files("float")["shaker2.h"])
    with pytest.raises(AssertionError, match="negative"):
        run(require("gcc", "gcc"), "-std=c99", "-fsyntax-only", source)
