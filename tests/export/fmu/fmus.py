"""FMUs of a few stands, each made once; an instance that fmpy drives call by call."""

from __future__ import annotations

import atexit
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Model, FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

from mahovik import stands
from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.lower.fmu_variables import Inputs, Kind
from mahovik.core.stand import load
from mahovik.core.stand.model import Stand, State, rest_state
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.out.export.fmu import Fmu, export_fmu
from mahovik.use.study.rest import rest

_FOLDER = Path(tempfile.mkdtemp(prefix="mahovik-fmus-"))
atexit.register(shutil.rmtree, _FOLDER, ignore_errors=True)

KINDS: tuple[Kind, ...] = ("cs", "me")
INPUTS: tuple[Inputs, ...] = ("torque", "acceleration")
COMBINATIONS = tuple((k, i) for k in KINDS for i in INPUTS)


@lru_cache
def stand(name: str) -> Stand:
    """An example, or: `rigid`, without flywheels; `driven`, with wrenches, legs, terms, instruments, points."""
    if name in ("rigid", "driven"):
        rng = np.random.default_rng(7)
        without_motors = replace(EVERYTHING, motors=False)  # friction and limits of motors act in `simulate` alone
        return random_stand(rng, 0 if name == "rigid" else 2, without_motors, name)
    return load(stands.path(name))


@lru_cache
def generated(name: str) -> Generated:
    """The C of such a stand."""
    return generate_all(stand(name))


@lru_cache
def fmu_of(name: str, kind: Kind, inputs: Inputs, binary: bool = True) -> Fmu:
    """FMU of a stand; begins at rest in the origin where the stand has no equilibrium."""
    example = stand(name)
    start = rest_state(example) if name in ("rigid", "driven") else None
    return export_fmu(example, kind, inputs, start=start, binary=binary)


@lru_cache
def path(name: str, kind: Kind, inputs: Inputs, binary: bool = True) -> str:
    """File of the FMU of a stand."""
    file = _FOLDER / f"{name}-{kind}-{inputs}{'' if binary else '-sources'}.fmu"
    file.write_bytes(fmu_of(name, kind, inputs, binary).content)
    return str(file)


@dataclass
class Instance:
    """An instance, value references by name, and what it has logged: (status, category, message)."""

    fmu: Any
    references: dict[str, int]
    log: list[tuple[int, str, str]]

    def get(self, *names: str) -> list[float]:
        """Values by name."""
        return list(self.fmu.getReal([self.references[n] for n in names]))

    def set(self, **values: float) -> None:
        """Sets values; `__` in a keyword stands for a point, `_at_` for an index."""
        self.put({_spelt(name): value for name, value in values.items()})

    def put(self, values: dict[str, float]) -> None:
        """Sets values by name."""
        self.fmu.setReal([self.references[n] for n in values], list(values.values()))

    def begin(self) -> None:
        """Into and out of Initialization Mode."""
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def step(self, now: float, duration: float) -> None:
        """One communication step."""
        self.fmu.doStep(currentCommunicationPoint=now, communicationStepSize=duration)


def _spelt(name: str) -> str:
    head, _, index = name.replace("__", ".").partition("_at_")
    return f"{head}[{index}]" if index else head


@contextmanager
def instance(name: str, kind: Kind, inputs: Inputs, talks: bool = False) -> Iterator[Instance]:
    """An instance that is freed at the end."""
    file = path(name, kind, inputs)
    description = fmpy.read_model_description(file)
    folder = fmpy.extract(file)
    log: list[tuple[int, str, str]] = []
    unit = (FMU2Slave if kind == "cs" else FMU2Model)(
        guid=description.guid, unzipDirectory=folder, modelIdentifier=name, instanceName="one", fmiCallLogger=None
    )

    def logger(_env: Any, _name: bytes, status: int, category: bytes, message: bytes) -> None:
        log.append((status, category.decode(), message.decode()))

    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(logger)
    callbacks.allocateMemory = defaultCallbacks.allocateMemory
    callbacks.freeMemory = defaultCallbacks.freeMemory
    unit.instantiate(callbacks=callbacks, loggingOn=talks)
    try:
        yield Instance(unit, {v.name: v.valueReference for v in description.modelVariables}, log)
    finally:
        unit.freeInstance()
        shutil.rmtree(folder, ignore_errors=True)


def heavier(stand: Stand, by: float) -> Stand:
    """A stand whose carrier has another mass, and the same moments of inertia about its origin."""
    J = generated(stand.name).values.parameters["carrier"]["inertia"]
    tensor = ((J[0], J[3], J[4]), (J[3], J[1], J[5]), (J[4], J[5], J[2]))
    carrier = replace(stand.carrier, mass=by * stand.carrier.mass, inertia=tensor, inertia_about="origin")
    return replace(stand, carrier=carrier)


def moving(stand: Stand, speed: float) -> State:
    """A state near that in which the FMU begins, in motion; its flywheels turn at about `speed`, rad/s."""
    state = rest_state(stand) if stand.name in ("rigid", "driven") else rest(stand).state
    N = len(stand.flywheels)
    wheel = [(-1.0) ** k * (1.0 + 0.1 * k) for k in range(N)]
    return replace(
        state,
        angles=None,
        quaternion=(0.98, 0.1, -0.1, float(np.sqrt(1 - 0.98**2 - 0.02))),
        V=(0.1, -0.2, 0.15, 0.3, -0.2, 0.1),
        phi=tuple(2.5 * x for x in wheel),
        phi_dot=tuple(speed * x for x in wheel),
    )
