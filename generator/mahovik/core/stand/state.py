"""One state of a stand with its inputs, as plain numbers in SI: what every backend evaluates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from mahovik.core.stand.model import Stand, Vec3, Vec6

Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True)
class State:
    """State and inputs. At most one of `angles`, `quaternion` is set; neither: the carrier is aligned with E0.

    position    of O1 in E0, m
    angles      psi, theta, phi of the stand's sequence, rad
    quaternion  w first, of x0 = C x1; unit length to rounding (it was normalised where it was read)
    V, V_dot    twist of the carrier relative to E0 in E1, linear part first; V_dot: derivative of its components
    phi, phi_dot, phi_ddot   flywheel phases, speeds, accelerations, one each, rad
    tau         drive torques, one per flywheel, N m
    wrench      run-time wrench by body name, in the body's own frame about its origin (a flywheel's turns with phi_s)
    task        name of a task of the stand whose rows are demanded in place of V_dot; "" for none
    demand      what it demands, one a row, m/s2 or rad/s2
    actuators   deflections of fins (rad) and speeds of propellers (rad/s) by name, in place of those of the file
    u, u_dot    speeds of the freedoms of a held carrier and their rates, m each, in place of V, V_dot
    """

    position: Vec3
    angles: Vec3 | None
    quaternion: Quaternion | None
    V: Vec6
    phi: tuple[float, ...]
    phi_dot: tuple[float, ...]
    phi_ddot: tuple[float, ...]
    V_dot: Vec6
    tau: tuple[float, ...]
    wrench: Mapping[str, Vec6] = field(default_factory=lambda: MappingProxyType({}))
    task: str = ""
    demand: tuple[float, ...] = ()
    u: tuple[float, ...] = ()
    u_dot: tuple[float, ...] = ()
    actuators: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))


def rest_state(stand: Stand) -> State:
    """The state in which every input of `stand` is zero and the carrier is aligned with E0."""
    zeros = (0.0,) * len(stand.flywheels)
    zero6: Vec6 = (0.0,) * 6
    free = (0.0,) * (len(stand.hold.freedoms) if stand.hold is not None else 0)
    return State((0.0, 0.0, 0.0), None, None, zero6, zeros, zeros, zeros, zero6, zeros, u=free, u_dot=free)
