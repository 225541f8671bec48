"""A plot as SVG: nanoseconds over the number of flywheels, both by their logarithms."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

WIDTH, HEIGHT = 720, 420
LEFT, RIGHT, TOP, BOTTOM = 70, 250, 40, 50
COLOURS = ("#0b6e4f", "#2fa27a", "#7fd1ae", "#b3402a", "#e07b39", "#8c5fa8", "#3f6fb5", "#777777", "#b59b00", "#d16ba5")


def plot(title: str, lines: Mapping[str, Mapping[int, float]]) -> str:
    """One line per name, in the order given."""
    Ns = sorted({N for line in lines.values() for N in line})
    values = [value for line in lines.values() for value in line.values()]
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))

    def x(N: float) -> float:
        span = math.log(Ns[-1] / Ns[0]) or 1.0
        return LEFT + (WIDTH - LEFT - RIGHT) * math.log(N / Ns[0]) / span

    def y(value: float) -> float:
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (math.log10(value) - low) / max(1, high - low)

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
        'font-size="12">',
        f"<title>{title}</title>",
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
        f'<text x="{LEFT}" y="22" font-size="14">{title}</text>',
    ]
    for decade in range(low, high + 1):
        at = y(10.0**decade)
        parts.append(f'<line x1="{LEFT}" y1="{at:.1f}" x2="{WIDTH - RIGHT}" y2="{at:.1f}" stroke="#dddddd"/>')
        parts.append(f'<text x="{LEFT - 8}" y="{at + 4:.1f}" text-anchor="end">{10**decade:,}</text>')
    for N in Ns:
        parts.append(f'<text x="{x(N):.1f}" y="{HEIGHT - BOTTOM + 20}" text-anchor="middle">{N}</text>')
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts.append(f'<text x="{middle:.1f}" y="{HEIGHT - 10}" text-anchor="middle">flywheels</text>')
    for number, (name, line) in enumerate(lines.items()):
        parts += _line(number, name, [(x(N), y(value)) for N, value in sorted(line.items())])
    return "\n".join([*parts, "</svg>", ""])


def _line(number: int, name: str, points: Sequence[tuple[float, float]]) -> list[str]:
    """A line with its marks, and its entry in the legend."""
    colour = COLOURS[number % len(COLOURS)]
    path = " ".join(f"{a:.1f},{b:.1f}" for a, b in points)
    at, row = WIDTH - RIGHT + 15, TOP + 18 * number
    return [
        f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>',
        *(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"/>' for a, b in points),
        f'<rect x="{at}" y="{row}" width="12" height="12" fill="{colour}"/>',
        f'<text x="{at + 18}" y="{row + 10}">{name}</text>',
    ]
