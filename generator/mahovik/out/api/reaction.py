"""Function `reaction` of a model: the wrench by which a hold makes its carrier move as it does."""

from __future__ import annotations

from numpy.typing import ArrayLike

from mahovik.errors import InputError
from mahovik.out.api import results
from mahovik.out.api.call import OnError
from mahovik.out.api.core import Built, Wrenches
from mahovik.out.api.inputs import Given
from mahovik.out.api.states import States
from mahovik.out.api.tables import Tables


class WithReaction(Built):
    """A model with `reaction`."""

    def reaction(
        self,
        x: States | ArrayLike,
        V_dot: Given | None = None,
        phi_ddot: Given = 0.0,
        *,
        wrench: Wrenches = None,
        tables: Tables | None = None,
        on_error: OnError = "raise",
    ) -> results.Reaction:
        """Wrench of the hold on a held carrier for a given motion, (8): V_dot = S u_dot, m/s2, rad/s2; phi_ddot rad/s2.

        `V_dot` is required where the carrier has freedoms; that of a clamped one is zero. For a motion that is not the
        one that `forward` finds, the part along the freedoms is what a drive would add.

        Gives `reaction`. Batch C. Raises InputError (also of a free carrier), RefusedError.
        """
        if V_dot is None and self.stand.hold is not None and self.stand.hold.freedoms:
            raise InputError(
                "reaction: V_dot is missing, expected that of the motion; forward gives the free one, with its reaction"
            )
        V_dot = 0.0 if V_dot is None else V_dot
        return self._result(results.Reaction, "reaction", x, on_error, wrench, tables, V_dot=V_dot, phi_ddot=phi_ddot)
