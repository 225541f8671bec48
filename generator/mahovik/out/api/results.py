"""Results of a model's functions: arrays by name, with the batch axis first, and a status for each state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.stand.units import show
from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.out.api.fields import Array, Field, Named, arrays

Real = NDArray[Any]


class Answer(Named):
    """Arrays by name; `status` has the shape of the batch: 0 is good, positive are bits, negative is refused (NaN)."""

    status: NDArray[np.int32]

    def __init__(self, fields: Sequence[Field], arrays: Mapping[str, Array], status: Array, single: bool) -> None:
        super().__init__(fields, None if single else len(status))
        self.status = status[0] if single else status
        self.__dict__.update({name: a[0] if single else a for name, a in arrays.items()})

    def _array(self, name: str) -> Array:
        found: Array = self.__dict__[name]
        return found

    def status_names(self) -> list[str]:
        """The status of each state in words, as `mahovik eval` has it: `OK`, `NEAR_SINGULAR|LIMITED`."""
        return [status_words(int(number)) for number in np.atleast_1d(self.status)]

    def has_status(self, name: str) -> NDArray[np.bool_]:
        """Is the status so named set, for each state?"""
        if name not in STATUS_VALUES:
            raise InputError(f"status: no {show(name)}{suggestion(str(name), STATUS_VALUES)}")
        value = STATUS_VALUES[name]
        status = np.asarray(self.status)
        return np.asarray((status > 0) & (status & value != 0) if value > 0 else status == value)

    def __repr__(self) -> str:
        of = "a state" if self._batch is None else f"{self._batch} states"
        shapes = ", ".join(f"{name} {self._array(name).shape}" for name in self._fields)
        return f"<{type(self).__name__}: {of}; {shapes}>"

    def _repr_html_(self) -> str:
        return arrays(repr(self), self)


class Forward(Answer):
    """`V_dot` (6): derivative of the components of V, m/s2, rad/s2; (8)."""

    V_dot: Real


class Coupled(Answer):
    """`V_dot` (6) and `phi_ddot` (N), rad/s2, under given drive torques."""

    V_dot: Real
    phi_ddot: Real


class Torque(Answer):
    """`tau` (N): drive torques, N m, mount on flywheel about the spin axis."""

    tau: Real


class Matrices(Answer):
    """The matrices of (8): `K`, `K_dot`, `M` (6, 6), `I`, `J` (6, N), and `F` (6)."""

    K: Real
    K_dot: Real
    M: Real
    I: Real
    J: Real
    F: Real


class Momentum(Answer):
    """`Z` (6) in E1 about O1, `Z0` (6) in E0 about its origin, `energy` (kinetic, J), `center_of_mass` (3) in E1,
    `center_of_mass_velocity` (3) in E0."""

    Z: Real
    Z0: Real
    energy: Real
    center_of_mass: Real
    center_of_mass_velocity: Real


class Inverse(Answer):
    """`phi_ddot` (N) for a wanted motion, and how good it is; (12). Of a task also `V_dot`, the motion that results."""

    phi_ddot: Real
    V_dot: Real
    residual: Real
    sigma: Real
    rank: NDArray[np.int32]
    damped_by: Real
    limited: NDArray[np.int32]
    hardest: Real


class TorqueFor(Answer):
    """`tau` (N) for the demand of a task within what the motors have, and the motion that results.

    `share`: part of the demand that is met where its direction is kept, else 1.
    """

    tau: Real
    phi_ddot: Real
    V_dot: Real
    residual: Real
    share: Real
    limited: NDArray[np.int32]


class Mounts(Answer):
    """`mount_wrench` (N, 6): of the mount on each flywheel, N, N m, about Os in the axes of Es at phi = 0."""

    mount_wrench: Real


class Reaction(Answer):
    """`reaction` (6): wrench of the hold on a held carrier, N, N m, in E1 about O1; (8)."""

    reaction: Real


class Points(Answer):
    """Readings at each instrument and point: `position` (S, 3), `C` (S, 3, 3), `twist` (S, 6), ...; S sensors."""

    position: Real
    C: Real
    twist: Real
    specific_force: Real
    angular_acceleration: Real


class ForwardJacobian(Answer):
    """Derivatives of `forward`: `V_dot_V` (6, 6), `V_dot_phi`, `V_dot_phi_dot`, `V_dot_phi_ddot` (6, N)."""

    V_dot_V: Real
    V_dot_phi: Real
    V_dot_phi_dot: Real
    V_dot_phi_ddot: Real


class CoupledJacobian(Answer):
    """Derivatives of `coupled`: of `V_dot` and of `phi_ddot`, by V, phi, phi_dot and tau."""

    V_dot_V: Real
    V_dot_phi: Real
    V_dot_phi_dot: Real
    V_dot_tau: Real
    phi_ddot_V: Real
    phi_ddot_phi: Real
    phi_ddot_phi_dot: Real
    phi_ddot_tau: Real


class Generalized(Answer):
    """(10), (11): `A`, `D`, `I0`, `J0` (6, 6), `q_dot`, `q_ddot` (6).

    Of a held carrier with m freedoms `q`, `q_dot`, `q_ddot` (m). Of one that turns about a point, the quaternion
    `orientation` (4) takes the place of the three angles in `q`.
    """

    A: Real
    D: Real
    I0: Real
    J0: Real
    q: Real
    orientation: Real
    q_dot: Real
    q_ddot: Real
