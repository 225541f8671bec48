"""Answers of `eval` and of every study on small stands, as numbers: what a change of the house must not change.

Each case is a function that returns named numbers or texts; `REASONS` has its tolerance and why it is that.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import mahovik
from mahovik.out.campaign.file import load_campaign

INPUTS = Path(__file__).parent / "inputs"
STANDS = Path(__file__).parent / "stands"

Answers = dict[str, Any]


class Tolerance(NamedTuple):
    """Largest difference, relative to the largest number of the same list, and why it may be as large."""

    relative: float
    reason: str


BITS = Tolerance(0.0, "the C has the same bits everywhere")
ROUNDING = Tolerance(1e-9, "sums in double whose order is free, through solvers of condition below 1e6")
ITERATION = Tolerance(1e-6, "an iteration ends where its own tolerance is met")
SEARCH = Tolerance(1e-3, "a search with seeds ends near the same optimum")

HELD = ("pendulum", "cube", "air_table", "force_table", "linear_shaker")
EVALUATED = ("telescope", "demo3", "shaker2", "remus6", *HELD, "random01", "random09", "random43")
WANTS = ("matrices", "momentum", "forward", "torque", "mounts", "coupled", "inverse", "generalized", "points")
"""Wants that every stand is asked for; held stands are asked for `reaction` too, those with tasks for `torque_for`."""


def place(name: str) -> Path:
    """The file of a stand of the net, or of an example."""
    for folder in (INPUTS, STANDS):
        if (folder / f"{name}.toml").is_file():
            return folder / f"{name}.toml"
    return Path(mahovik.__file__).parent / "stands" / f"{name}.toml"


def _states(stand: mahovik.Stand) -> Iterator[dict[str, Any]]:
    """Three states by a formula: at rest, moving, and fast with every input."""
    N = len(stand.flywheels)
    m = None if stand.hold is None else len(stand.hold.freedoms)

    def row(length: int, size: float, at: int) -> list[float]:
        return [round(size * math.sin(1.0 + at + 2.3 * k), 6) for k in range(length)]

    tasks = {"task": stand.tasks[0].name, "demand": row(len(stand.tasks[0].rows), 0.02, 5)} if stand.tasks else {}
    for number, size in enumerate((0.0, 0.3, 2.0)):
        state: dict[str, Any] = {"phi": row(N, 2.0, number), "phi_dot": row(N, 200.0 * size, number)}
        if m is None:
            state |= {"position": row(3, size, 1), "angles": row(3, 0.4 * size, 2), "V": row(6, size, 3)}
        else:
            state["u"] = row(m, size, 3)
        acceleration = {"V_dot": row(6, size, 4)} if m is None else {"u_dot": row(m, size, 4)}
        effort = {"phi_ddot": row(N, 20.0 * size, 6), "tau": row(N, 0.1 * size, 7)}
        for want in WANTS if m is None else (*WANTS, "reaction"):
            yield {"id": f"{number} {want}", **state, **acceleration, **effort, "want": [want]}
        if tasks:
            for want in ("inverse", "torque_for"):
                yield {"id": f"{number} {want} by task", **state, **tasks, "want": [want]}


def evaluated(name: str, real: str = "double") -> Answers:
    """Every want of `eval`, by the C."""
    file = place(name)
    lines = "\n".join(json.dumps(state) for state in _states(mahovik.load(file)))
    command = [sys.executable, "-m", "mahovik", "eval", str(file), "--real", real]
    run = subprocess.run(command, input=lines, capture_output=True, text=True, check=False)
    rows = [json.loads(line) for line in run.stdout.splitlines()]
    return {row.pop("id"): row for row in rows} | ({} if rows else {"failed": run.stderr})


def _columns(result: Any, *more: str) -> Answers:
    """The columns of a study, and further attributes."""
    columns = {column.name: _plain(np.asarray(column.values)) for column in result.columns}
    return columns | {name: _plain(getattr(result, name)) for name in more}


def _rest(name: str) -> Answers:
    return {key: _plain(np.asarray(value)) for key, value in _flat(mahovik.check(place(name))["rest"])}


def _flat(values: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    for key, value in values.items():
        yield from _flat(value) if isinstance(value, dict) else [(key, value)]


def _modes(name: str) -> Answers:
    return _columns(mahovik.modes(place(name)))


def _identified(result: Any) -> Answers:
    """Answers without standard errors: the data have no noise but rounding."""
    return {key: _plain(result[key]) for key in ("path", "value", "before")}


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return _plain({"re": value.real, "im": value.imag}) if np.iscomplexobj(value) else value.tolist()
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    return value if isinstance(value, str | int | float | bool | list) else str(value)


def _sums(result: Any) -> Answers:
    """Sums of a vibration, and what they are at."""
    return {name: _plain(result[name]) for name in ("speeds", "frequency", "rms", "peak", "worst") if name in result}


def _planned() -> tuple[Any, Path, Any]:
    folder = place("shaker2").parent
    motion = folder / "shaker2_spin.motion.json"
    return place("shaker2"), motion, mahovik.plan(place("shaker2"), motion=motion, seed=0)


def _plan(stand: str, motion: str) -> Answers:
    path = place(stand).parent / motion
    result = mahovik.plan(place(stand), motion=path, seed=0)
    verdict = mahovik.verify(place(stand), programme=result, motion=path)
    return {"status": result["status"], "effort": _plain(result["effort"]), "passed": verdict.ok}


def _follow() -> Answers:
    stand, motion, programme = _planned()
    with tempfile.TemporaryDirectory() as folder:
        servo = Path(folder) / "servo.toml"
        servo.write_text('schema = 1\nsample_period = "0.5 ms"\nlatency = "100 us"\nbandwidth = "40 Hz"\n')
        options: dict[str, Any] = {"motion": motion, "programme": programme, "servo": servo}
        return _columns(mahovik.simulate(stand, **options, mismatch=0.02, seed=2, periods=12)["coordinates"])


def _campaign() -> Answers:
    text = (
        'schema = 1\nstand = "two.toml"\nsamples = 64\nseed = 1\ndesign = "DESIGN"\n[vary]\n'
        '"w*.unbalance.static" = { relative = 0.2 }\n"carrier.mass" = { tolerance = "0.5 kg" }\n'
        '"w1.position[0]" = { normal = [0.1, 0.001] }\n[over]\nregime = { default = { speed = "1500 rpm" } }\n'
        'until = "0.05 s"\n[[quantity]]\nname = "shake"\nwhat = "rms acceleration"\nat = "imu"\n'
        '[[quantity]]\nname = "turn"\nwhat = "peak angle"\nat = "imu"\n'
    )
    rows: Answers = {}
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "two.toml").write_text(place("two").read_text())
        for design in ("random", "sobol", "latin"):
            file = Path(folder) / f"{design}.toml"
            file.write_text(text.replace("DESIGN", design))
            table = load_campaign(file).rows(0, 64)
            rows[design] = _plain({name: table[name] for name in table if name not in ("sample", "error")})
    return rows


SWEEP: dict[str, Any] = {"speed": {"wheel": "500..4000rpm"}, "at": "carrier", "steps": 15, "quantity": "acceleration"}
IMPROVED: dict[str, Any] = {"speed": [150.0, 171.0, 190.0, 210.0], "at": "acc1", "quantity": "acceleration",
                            "band": (5.0, 60.0), "improve": True}  # fmt: skip
APART: dict[str, Any] = {"speed": {"w1": "1500 rpm", "w2": "-1630 rpm"}, "at": "imu", "quantity": "acceleration"}

CASES: dict[str, tuple[Tolerance, Callable[[], Answers]]] = {
    **{f"eval {name}": (BITS, partial(evaluated, name)) for name in EVALUATED},
    "eval demo3 float": (BITS, lambda: evaluated("demo3", "float")),
    **{f"rest {name}": (ROUNDING, partial(_rest, name)) for name in ("shaker2", "pendulum")},
    **{f"modes {name}": (ROUNDING, partial(_modes, name)) for name in ("telescope", "shaker2", "cube", "pendulum")},
    "vibration telescope": (ROUNDING, lambda: _sums(mahovik.vibration(place("telescope"), **SWEEP))),
    "vibration force_table": (
        ROUNDING,
        lambda: _sums(
            mahovik.vibration(
                place("force_table"), speed="500..3000rpm", at="hold.reaction", steps=11, quantity="force"
            )
        ),
    ),
    "vibration two": (ROUNDING, lambda: _sums(mahovik.vibration(place("two"), **APART))),
    "simulate two": (
        ROUNDING,
        lambda: _columns(mahovik.simulate(place("two"), until=0.05, regime={"default": {"speed": 150.0}})),
    ),
    "simulate pendulum": (
        ROUNDING,
        lambda: _columns(
            mahovik.simulate(place("pendulum"), until=0.2, regime={"default": {"speed": 50.0}}, start={"u": [0.3]})
        ),
    ),
    "plan shaker2 spin": (SEARCH, lambda: _plan("shaker2", "shaker2_spin.motion.json")),
    "plan demo3": (SEARCH, lambda: _plan("demo3", "demo3.motion.json")),
    "follow shaker2": (ITERATION, _follow),
    "campaign two": (ROUNDING, _campaign),
    "identify two": (
        ITERATION,
        lambda: _identified(mahovik.identify(place("two"), data=INPUTS / "two.csv", free="w*.unbalance")),
    ),
    "balance two": (
        ITERATION,
        lambda: _columns(mahovik.balance(place("two"), data=INPUTS / "two.csv", plane={"all": [-0.01, 0.01]})),
    ),
    "balance influence": (
        ROUNDING,
        lambda: _plain(mahovik.balance(influence={"A": ["170@112"], "B": [["235@94"]], "U": ["1.15@0"]}).to_dict()),
    ),
    "vibration improve sat4": (SEARCH, lambda: _plain(mahovik.vibration(place("sat4"), **IMPROVED)["improved"])),
}


def answer(name: str) -> Answers:
    """The answers of a case, as JSON has them."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        answers: Answers = json.loads(json.dumps(CASES[name][1]()))
    return answers


def differences(before: Any, after: Any, relative: float, path: str = "") -> Iterator[str]:
    """Places where two answers differ by more than the tolerance."""
    if isinstance(before, dict) and isinstance(after, dict):
        for key in sorted(before.keys() | after.keys(), key=str):
            if key not in before or key not in after:
                yield f"{path}.{key}: {'new' if key in after else 'gone'}"
            else:
                yield from differences(before[key], after[key], relative, f"{path}.{key}")
        return
    try:
        a, b = np.asarray(before, float), np.asarray(after, float)
    except (TypeError, ValueError):
        if isinstance(before, list) and isinstance(after, list) and len(before) == len(after):
            for k, pair in enumerate(zip(before, after, strict=True)):
                yield from differences(*pair, relative, f"{path}[{k}]")
        elif before != after:
            yield f"{path}: {before!r} became {after!r}"
        return
    if a.shape != b.shape or (np.isfinite(a) != np.isfinite(b)).any():
        yield f"{path}: shape or finiteness changed from {a.shape} to {b.shape}"
    elif a.size:
        worst = np.abs(np.where(np.isfinite(a), b - a, 0.0)).max()
        if worst > relative * np.abs(np.where(np.isfinite(a), a, 0.0)).max():
            yield f"{path}: differs by {worst:.3g}"
