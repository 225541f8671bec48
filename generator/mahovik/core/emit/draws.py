"""Lines that draw the inputs of emitted tests, by the plan that the generator's own inputs follow."""

from __future__ import annotations

from collections.abc import Callable

from mahovik.contract.quantities import Draw
from mahovik.core.emit.calls import over_rows, row_length
from mahovik.core.emit.names import Names
from mahovik.core.lower import test_inputs
from mahovik.core.lower.test_inputs import Input


class Draws:
    """Calls of `draw_reals`, `draw_flags` and similar functions, which a template defines.

    source    variable that they draw from
    place     C text of an input from its path
    largest   C text of the largest magnitude of an input
    attitude  last arguments of `draw_attitude`
    """

    def __init__(
        self,
        names: Names,
        source: str,
        place: Callable[[tuple[str, ...]], str],
        largest: Callable[[Input], str],
        attitude: str = "",
    ) -> None:
        self._names, self._source, self._attitude = names, source, attitude
        self._place, self._largest = place, largest

    def lines(self, each: Input) -> list[str]:
        """Lines that draw one input."""
        place, source, rule = self._place(each.path), self._source, each.rule
        if rule is Draw.ATTITUDE:
            return [f"draw_attitude({source}, {place}{self._attitude});"]
        if rule is Draw.TURNS:
            cosine = self._place((*each.path[:-1], test_inputs.COSINE))
            return [f"draw_turns({source}, {place}, {cosine}, {row_length(self._names, each.shape)});"]
        if rule in (Draw.REALS, Draw.POWER, Draw.FLAGS):
            what = {Draw.REALS: "reals", Draw.POWER: "powers", Draw.FLAGS: "flags"}[rule]
            more = "" if rule is Draw.FLAGS else f", {self._largest(each)}"
            return over_rows(self._names, place, each.shape, lambda row, n: f"draw_{what}({source}, {row}, {n}{more});")
        given = {
            Draw.ORDER: f"draw_order({source})",
            Draw.STEP: f"draw_step({source})",
            Draw.SHARE: f"draw_share({source})",
            Draw.FACTOR: f"draw_factor({source}, {self._largest(each)})",
        }
        return [f"{place} = {given[rule]};"]
