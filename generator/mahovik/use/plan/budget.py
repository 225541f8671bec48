"""The budget of a search: counted in steps, so that the same file and seed give the same programme; time only cuts."""

from __future__ import annotations

import time
from dataclasses import dataclass, field


@dataclass
class Budget:
    """`steps` of Levenberg-Marquardt that may be taken; `seconds` from its making: a cut-off, told in the result.

    interrupted   by Ctrl-C in the middle of something that can end with what it has
    """

    steps: int
    seconds: float | None = None
    taken: int = 0
    cut: bool = False
    interrupted: bool = False
    _begun: float = field(default_factory=time.monotonic)

    def step(self) -> bool:
        """Counts a step; False where none is left."""
        if self.seconds is not None and self.elapsed > self.seconds:
            self.cut = True
        if self.exhausted:
            return False
        self.taken += 1
        return True

    def interrupt(self) -> None:
        """By Ctrl-C."""
        self.interrupted = True

    def over(self) -> bool:
        """Whether time has run out or Ctrl-C was pressed, where steps are not counted."""
        if self.seconds is not None and self.elapsed > self.seconds:
            self.cut = True
        return self.cut or self.interrupted

    def left(self, share: float = 1.0) -> float | None:
        """This share of the seconds that are left; None: there is no end to them."""
        return None if self.seconds is None else max(share * (self.seconds - self.elapsed), 0.0)

    @property
    def exhausted(self) -> bool:
        """Whether the search has to end."""
        return self.cut or self.interrupted or self.taken >= self.steps

    @property
    def elapsed(self) -> float:
        """s since the search began."""
        return time.monotonic() - self._begun
