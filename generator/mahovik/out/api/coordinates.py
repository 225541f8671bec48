"""The equations of a model in generalized coordinates, of a free carrier or along the freedoms of a held one."""

from __future__ import annotations

from numpy.typing import ArrayLike

from mahovik.core.stand.hold import has_coordinates
from mahovik.errors import InputError
from mahovik.out.api import results
from mahovik.out.api.call import OnError
from mahovik.out.api.core import Built, Wrenches
from mahovik.out.api.inputs import Given
from mahovik.out.api.states import States
from mahovik.out.api.tables import Tables


class WithCoordinates(Built):
    """A model with `generalized`."""

    def generalized(
        self,
        x: States | ArrayLike,
        angles: Given | None = None,
        phi_ddot: Given = 0.0,
        *,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.Generalized:
        """The equations in generalized coordinates, (10), (11); `angles`, rad, take the place of the attitude of `x`.

        Gives `A`, `D`, `I0`, `J0`, `q_dot`, `q_ddot`. Of a held carrier, without `angles`, the coordinates of its
        freedoms: `q`, `q_dot`, `q_ddot`, and `orientation` of one that turns about a point. State by state. Raises
        InputError, RefusedError.
        """
        hold = self._stand.hold
        held = hold is not None
        if held != (angles is None):
            expected = "none, the carrier is held and its attitude is that of x" if held else "psi, theta, phi"
            raise InputError(f"generalized: angles: {'given' if held else 'missing'}, expected {expected}")
        if hold is not None and not has_coordinates(hold):
            lacks = "the freedoms of [hold] have no coordinates" if hold.freedoms else "the carrier is clamped"
            raise InputError(f"generalized: {lacks}, ask for forward")
        given = {"phi_ddot": phi_ddot} | ({} if held else {"angles": angles})
        return self._result(results.Generalized, "generalized", x, on_error, wrench, tables, **given)
