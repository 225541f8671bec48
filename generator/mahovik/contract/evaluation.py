"""The contract of `eval`, and of every program that is judged: keys of a state, wants, keys of an answer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from textwrap import wrap

from mahovik.contract.functions import ALL_WANTS, ROWS, TASK_WANTS
from mahovik.contract.quantities import QUANTITIES

ZEROS = "zeros"


@dataclass(frozen=True)
class Key:
    """A key of a state or of an answer, which are objects of JSON, one a line.

    shape    numbers along each axis, the outermost first: N flywheels, m freedoms of a held carrier or rows of a task;
             () is one number, None is no number; in words where it depends on the state
    unit     SI; of the linear and of the angular half where they differ
    meaning  what it is, with its point and its frame
    default  what a state has without it; empty for keys of answers
    """

    name: str
    shape: tuple[int | str, ...] | None
    unit: str
    meaning: str
    default: str = ""

    def shape_of(self, flywheels: int, freedoms: int = 0) -> tuple[int, ...] | None:
        """Numbers along each axis on a stand; None where it holds no numbers, or the contract does not fix how many."""
        counts = {"N": flywheels, "m": freedoms}
        if self.shape is None or any(isinstance(size, str) and size not in counts for size in self.shape):
            return None
        return tuple(counts[size] if isinstance(size, str) else size for size in self.shape)


def _input(symbol: str, meaning: str) -> Key:
    """A key of a state with the unit and the shape of its quantity."""
    row = QUANTITIES[symbol]
    count = {"3": 3, "6": 6, "W": 6}.get(row.count, row.count)
    return Key(symbol, (count,), row.unit, meaning, ZEROS)


STATE: Mapping[str, Key] = {
    key.name: key
    for key in (
        Key("id", None, "", "any value; the answer repeats it", "null"),
        Key("want", None, "", "list of wants, at least one", "required"),
        _input("position", "of O1, in E0"),
        _input("angles", "psi, theta, phi of the stand's sequence; x0 = C x1"),
        Key("quaternion", (4,), "", "of C, scalar first, unit; in place of angles", "by angles"),
        _input("V", "velocity of O1, angular velocity, relative to E0, in E1"),
        _input("phi", "phases of the flywheels"),
        _input("phi_dot", "their speeds, relative to the mount"),
        _input("phi_ddot", "their accelerations"),
        _input("V_dot", "derivatives of the components of V"),
        _input("tau", "drive torques, of the mount on each flywheel"),
        _input("wrench", "an object, by body: about its origin, in its axes, which turn"),
        Key("u", ("m",), "m/s, rad/s", "of a held carrier, in place of V: speeds of its freedoms", ZEROS),
        Key("u_dot", ("m",), "m/s2, rad/s2", "derivatives of u, in place of V_dot", ZEROS),
        Key("task", None, "", "name of a task of the stand", "no task"),
        Key("demand", ("m",), "m/s2, rad/s2", "of the rows of the task, in place of V_dot", "required"),
        Key("actuators", None, "rad, rad/s", "an object, by fin and propeller: deflection, speed", "the file's"),
    )
}
"""Keys of a state."""

ANSWERS: Mapping[str, Key] = {
    key.name: key
    for key in (
        Key("id", None, "", "that of the state"),
        Key("error", None, "", "why there is no answer, in its place"),
        Key("K", (6, 6), "kg, kg m, kg m2", "mass matrix (2), of E1 about O1"),
        Key("K_dot", (6, 6), "K / s", "its rate (6)"),
        Key("M", (6, 6), "K / s", "velocity matrix (9), relative to the stream"),
        Key("I", (6, "N"), "kg m, kg m2", "flywheel coupling (9), a column for each flywheel"),
        Key("J", (6, "N"), "I / s", "its velocity part (9)"),
        Key("F", (6,), "N, N m", "external wrench (7), in E1 about O1"),
        Key("Z", (6,), "kg m/s, kg m2/s", "momentum screw (2), in E1 about O1"),
        Key("Z0", (6,), "kg m/s, kg m2/s", "momentum screw (1), in E0 about its origin"),
        Key("energy", (), "J", "kinetic energy"),
        Key("center_of_mass", (3,), "m", "of all bodies, from O1 in E1"),
        Key("center_of_mass_velocity", (3,), "m/s", "its velocity, relative to E0, in E0; may be missing"),
        Key("V_dot", (6,), "m/s2, rad/s2", "derivatives of the components of V"),
        Key("u_dot", ("m",), "m/s2, rad/s2", "derivatives of u"),
        Key("reaction", (6,), "N, N m", "of the hold on the carrier, in E1 about O1"),
        Key("phi_ddot", ("N",), "rad/s2", "accelerations of the flywheels"),
        Key("tau", ("N",), "N m", "drive torques, of the mount on each flywheel"),
        Key("mount_wrench", ("N", 6), "N, N m", "of the mount on each flywheel, about Os, in its axes at phi = 0"),
        Key(
            "residual",
            ("6 or m",),
            "N, N m",
            "F - K V_r_dot - M V_r - J phi_dot - I phi_ddot, at V_r; of a task demand less reached",
        ),
        Key("sigma", ("least",), "", "singular values, descending: the lesser of N and 6, or m"),
        Key("rank", (), "", "number of those above the threshold"),
        Key("status", None, "", "OK, or names joined by |"),
        Key("limited", ("N",), "", "1 where a motor is at its limit"),
        Key("A", (6, 6), "", "V = A q_dot (10)"),
        Key("D", (6, 6), "1/s", "rate of A (10)"),
        Key("I0", (6, 6), "", "K A (11); may be missing"),
        Key("J0", (6, 6), "", "K D + M A (11); may be missing"),
        Key("q", ("m or less",), "m, rad", "coordinates from the home pose, but for three turns"),
        Key("orientation", (4,), "", "of three turns: quaternion from the home pose"),
        Key("q_dot", ("6 or m",), "m/s, rad/s", "of O1 in E0 and psi, theta, phi; of a hold of q"),
        Key("q_ddot", ("6 or m",), "m/s2, rad/s2", "its rate, by (11)"),
        Key("points", None, "SI", "an object, by name: position (E0), C, twist, specific_force, angular_acceleration"),
    )
}
"""Keys of an answer."""

_UNANSWERED = {"inverse": ("damped_by", "limited", "hardest"), "torque_for": ("share",)}
"""Results of the C that `eval` does not answer."""

MAY_BE_LEFT_OUT = ("center_of_mass_velocity", "I0", "J0")
"""Quantities that a program may leave out of a want that it offers: nothing else needs them."""


def needs_of(want: str) -> tuple[str, ...]:
    """Keys that a want needs besides the state."""
    return tuple(key for key in ("angles", "V_dot", "phi_ddot", "tau", "demand") if key in ROWS[want].takes)


def answers_of(want: str, held: bool = False, task: bool = False) -> tuple[str, ...]:
    """Keys of the answer to a want: of a free or a held carrier, or of a state with a task."""
    gives = tuple(name for name in ROWS[want].gives if name not in _UNANSWERED.get(want, ()))
    if want == "generalized":
        coordinates = ("q", "orientation", "q_dot", "q_ddot")
        return coordinates if held else tuple(name for name in gives if name not in coordinates[:2])
    if want in ("forward", "coupled") and held:
        return ("u_dot", *gives, "reaction")
    if want == "inverse" and task:
        return ("phi_ddot", "V_dot", *gives[1:])
    return (*gives, "status") if want in TASK_WANTS else gives


def tables() -> dict[str, list[tuple[str, ...]]]:
    """The whole contract: rows of cells by the title of their table, the first row the heads."""

    def numbers(key: Key) -> str:
        return "" if key.shape is None else " x ".join(map(str, key.shape)) or "1"

    states = [(key.name, numbers(key), key.unit, key.default, key.meaning) for key in STATE.values()]
    answers = [(key.name, numbers(key), key.unit, key.meaning) for key in ANSWERS.values()]
    wants = []
    for want in ALL_WANTS:
        free, held = answers_of(want), answers_of(want, held=True)
        addition = "" if free == held else f"; of a held carrier {', '.join(held)}"
        wants.append((want, ", ".join(needs_of(want)), ", ".join(free) + addition))
    return {
        "A state": [("key", "numbers", "unit", "if missing", "what"), *states],
        "Wants": [("want", "needs", "answers"), *wants],
        "An answer": [("key", "numbers", "unit", "what"), *answers],
    }


def text_lines(*titles: str) -> list[str]:
    """Tables as text, all of them or some, for help and comments: columns, the last of which is folded."""
    result: list[str] = []
    for title, rows in tables().items():
        if titles and title not in titles:
            continue
        widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]) - 1)]
        result += ["", f"{title}:"]
        for row in rows:
            start = "  " + "".join(f"{cell:{most + 2}}" for cell, most in zip(row, widths, strict=False))
            result += wrap(row[-1], width=98, initial_indent=start, subsequent_indent=" " * len(start))
    return result[1:]


def text_of_help() -> str:
    """What a state and the wants are, as paragraphs whose lines help keeps."""
    return "\b\n" + "\n".join(text_lines("A state", "Wants")).replace("\n\n", "\n\n\b\n")
