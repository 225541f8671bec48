"""The regressor of a model: columns of the parameters in which the equations are linear."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from mahovik.out.api.call import OnError
from mahovik.out.api.core import Built
from mahovik.out.api.fields import Array, Field
from mahovik.out.api.inputs import Given
from mahovik.out.api.results import Answer
from mahovik.out.api.states import States
from mahovik.use.regressor.parameters import Parameter, assemble, parameters, row_names


class Regressor(Answer):
    """`Y` (6 + N, P): rows are the wrench on the carrier (N, N m) and the drive torques (N m), columns parameters.

    `rows` and `parameters` say what stands along its two axes.
    """

    Y: Array
    rows: tuple[str, ...]
    parameters: tuple[Parameter, ...]


class WithRegressor(Built):
    """A model with `regressor`. Its C is compiled at the first use, since most models need none."""

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The parameters in which (8) and the drive torques are linear: names, units, and values of the stand file."""
        return parameters(self._stand)

    @cached_property
    def _regressor(self) -> Built:
        compiler, threads = self._given
        return Built(self._stand, self._real, compiler, threads, only=("regressor",))

    def regressor(
        self, x: States | ArrayLike, V_dot: Given = 0.0, phi_ddot: Given = 0.0, *, on_error: OnError = "raise"
    ) -> Regressor:
        """What (8) and the drive torques take of each mass, first moment, moment of inertia, added mass and damping.

        V_dot     m/s2, rad/s2; derivative of the components of V
        phi_ddot  rad/s2

        Gives `Y`: Y times the values of `parameters` is F of everything that has no columns (all but weight and the
        damping matrices of the carrier), and tau plus the moment of this about the spin axis. State by state. Raises
        InputError, RefusedError.
        """
        return regressor_of(self._regressor, x, V_dot, phi_ddot, on_error)


def regressor_of(
    built: Built, x: States | ArrayLike, V_dot: Given, phi_ddot: Given, on_error: OnError = "raise"
) -> Regressor:
    """The regressor by the C of a stand that has it."""
    given = {"V_dot": V_dot, "phi_ddot": phi_ddot}
    columns, status, single = built._calculate("regressor", x, on_error, None, None, given)
    rows, found = row_names(built.stand), parameters(built.stand)
    names = tuple(p.name for p in found)
    meaning = "rows: N, N m; columns: a unit of each parameter"
    field = Field("Y", (len(rows), len(names)), "SI", meaning, (rows, names))
    Y = assemble(built.stand, {name: np.asarray(a, np.float64) for name, a in columns.items()})
    result = Regressor((field,), {"Y": Y.astype(built._element)}, status, single)
    result.rows, result.parameters = rows, found
    return result
