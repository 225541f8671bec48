"""`fading_damping` of a body in the stand file: linear damping that fades with its speed through the fluid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from mahovik.core.stand.declare import AS_MATRIX, BRAKES, TIMES, Draw, Drawn, Size, uniform
from mahovik.core.stand.fields import LINEAR, matrix, scalar
from mahovik.core.stand.law import BodyLaw
from mahovik.core.stand.model import Body, Mat6, Stand
from mahovik.core.stand.units import Dimension

RATE = Dimension("a rate over speed", "s/m")


@dataclass(frozen=True)
class FadingDamping(BodyLaw):
    """Linear damping of slow motion, wrench -exp(-rate U) linear V_r, all in the body's own frame.

    V_r     twist of the body relative to the fluid; U (m/s) is the length of its linear part
    linear  damping at rest
    rate    at `U = 1/rate` the damping is down to 37 %
    """

    linear: Annotated[
        Mat6, matrix(LINEAR), BRAKES, AS_MATRIX, Drawn(lambda draw, of: draw.definite6(2.0 * of.mass))
    ]  # fmt: skip
    rate: Annotated[float, scalar(RATE, above=0.0), TIMES, uniform(0.2, 3.0)]

    key: ClassVar[str] = "fading_damping"
    name: ClassVar[str] = "fading damping"

    @property
    def nonlinear(self) -> bool:
        """True: it fades."""
        return True

    @property
    def has_kinks(self) -> bool:
        """True: U has one where the body comes to rest."""
        return True

    @property
    def acts(self) -> bool:
        """Whether any coefficient is not zero."""
        return any(map(any, self.linear))

    @classmethod
    def structure(cls, stand: Stand) -> dict[str, object]:
        """Indices of the bodies with fading damping; nothing without, as other stands have it."""
        return {"fading_damping": tuple(i for i, _, _ in cls.of(stand))} if cls.of(stand) else {}

    @classmethod
    def random_on(cls, draw: Draw, body: Body) -> Self | None:
        """Fading damping of a body of any kind, of the size of its mass."""
        return cls.random(draw, Size(body.mass))


LAW = FadingDamping
