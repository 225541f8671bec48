"""The mechanics of a stand on NumPy columns: (2) to (12) for many moments at once, with exact derivatives.

`Mechanics.of(stand)`, then `prescribe(mechanics, course, bias)`, then `residual` or `linear` at the flywheels' angles;
`drive` and a `Chart` give the carrier's course by (8) under given flywheel motions.
"""
