"""The part of `mahovik check` about the fluid: passivity, added mass, growth of small motions."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from mahovik.out.cli.output import print_line, print_table

if TYPE_CHECKING:
    from mahovik.use.study.fluid import Fluid

NEUTRAL = 1e-6
"""Growth over the velocity, 1/m, that rounding may give to a double eigenvalue 0 of derivatives by differences."""


def fluid_object(found: Fluid) -> dict[str, Any]:
    """The report for JSON; `speed` is null where no power is positive."""
    powers = [asdict(power) | {"speed": power.speed if power.positive else None} for power in found.powers]
    return asdict(found) | {"powers": powers}


def print_fluid(found: Fluid) -> None:
    """The report as a table and lines."""
    if found.powers:
        rows = (
            (
                power.body,
                "ahead" if power.ahead else "any",
                f"from {power.speed:.3g} m/s" if power.positive else "none found",
                "  ".join(f"{x + 0.0:.3g}" for x in power.twist) or "-",
                f"{power.power:.3g}" if power.positive else "-",
            )
            for power in found.powers
        )
        print_table(("laws of the fluid on", "twists", "drives", "at u v w p q r>", "power, W"), rows)
    else:
        print_line(
            "fluid: no body has a law of its twist relative to the fluid" + (" but propellers" * bool(found.engines))
        )
    if found.engines:
        print_line(f"propellers on {', '.join(found.engines)}: they are there to drive, so the table leaves them out")
    added = found.added_mass
    if added is not None:
        kind = "definite" if added.least > 1e-9 else "semidefinite"
        print_line(
            f"added mass: symmetric, {kind} in its {added.rows} rows (least eigenvalue at unit diagonal "
            f"{added.least:.4g}); moment of Munk {added.sway:.5g} kg u v about z, {added.heave:.5g} kg u w about y"
            + (f", taken out with the other products on {', '.join(added.without)}" if added.without else "")
        )
        if added.without:
            print_line("the derivatives there contain these products as published, so that they count once")
    print_line(f"at {found.velocity:g} m/s ahead, without weight: growth rate {_growth(found)}")


def _growth(found: Fluid) -> str:
    """The growth rate and what it says."""
    if abs(found.growth) <= NEUTRAL * found.velocity:
        return "0, neutral: some small motion neither grows nor decays"
    return f"{found.growth:.4g} 1/s, {'the course is unstable' if found.growth > 0.0 else 'small motions decay'}"
