"""`[[quantity]]` of a campaign file: what is kept of each sample, as a number with a name."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import model_validator

from mahovik.core.motion.document import FREQUENCY
from mahovik.core.stand.coordinates import FREE
from mahovik.core.stand.fields import Table, Text, refuse, text, validator, vector
from mahovik.core.stand.hold import TWIST_NAMES
from mahovik.core.stand.units import TIME, QuantityError, number, show
from mahovik.nearest import suggestion
from mahovik.out.campaign.signals import AXES, SIGNALS

STATISTICS = ("peak", "rms", "mean", "least", "end", "settling")
"""Statistics of a signal, by the key that names the signal."""


def _signal(raw: Any) -> str:
    if not isinstance(raw, str) or raw not in SIGNALS:
        raise QuantityError(f"unknown {show(raw)}{suggestion(raw, SIGNALS)}")
    return raw


def _band(raw: Any) -> tuple[float, float]:
    low, high = vector(raw, (2,), FREQUENCY)
    if not 0.0 <= low < high:
        raise QuantityError(f"expected a lower and a higher frequency, found {low:g} Hz and {high:g} Hz")
    return low, high


def _axis(raw: Any) -> str:
    known = dict.fromkeys((*AXES, *FREE, *TWIST_NAMES, *map(str, range(1, 7))))
    if not isinstance(raw, str) or raw not in known:
        raise QuantityError(f"unknown {show(raw)}{suggestion(raw, known)}")
    return raw


def _seconds(raw: Any) -> float:
    found = number(raw, TIME)
    if found < 0.0:
        raise QuantityError(f"{found:g} s is negative")
    return found


def _raw(raw: Any) -> Any:
    return raw


Signal = Annotated[str | None, validator(_signal)]


class WantedTable(Table):
    """One quantity: exactly one of a statistic with its signal, or `function`.

    within   tolerance of `settling`, in the unit of the signal: it is read when the signal is known
    """

    peak: Signal = None
    rms: Signal = None
    mean: Signal = None
    least: Signal = None
    end: Signal = None
    settling: Signal = None
    function: Annotated[str | None, validator(text)] = None
    at: Annotated[str | None, validator(text)] = None
    of: Annotated[str | None, validator(text)] = None
    axis: Annotated[str | None, validator(_axis)] = None
    band: Annotated[tuple[float, float] | None, validator(_band)] = None
    after: Annotated[float, validator(_seconds)] = 0.0
    within: Annotated[Any, validator(_raw)] = None
    unit: Annotated[str, Text] = ""

    @property
    def statistic(self) -> str:
        """The key that says what is kept: a statistic, or `function`."""
        return next(key for key in (*STATISTICS, "function") if key in self.model_fields_set)

    @property
    def signal(self) -> str:
        """Name of the signal; that of the function where there is one."""
        return str(getattr(self, self.statistic))

    @model_validator(mode="after")
    def _one_statistic(self) -> WantedTable:
        keys = (*STATISTICS, "function")
        given = [key for key in keys if key in self.model_fields_set]
        if len(given) != 1:
            raise refuse(f"expected exactly one of {', '.join(keys)}, found {' and '.join(given) if given else 'none'}")
        for key, needs in (("band", "rms"), ("within", "settling"), ("unit", "function")):
            if key in self.model_fields_set and given[0] != needs:
                raise refuse(f"only allowed with `{needs}`", key)
        if given[0] == "settling" and self.within is None:
            raise refuse("required with `settling`, but missing", "within")
        if given[0] == "function":
            for key in ("at", "of", "axis", "after"):
                if key in self.model_fields_set:
                    raise refuse("not allowed with `function`, which gets all arrays", key)
        return self
