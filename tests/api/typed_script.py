"""A script as a user writes it: mypy reads it in strict mode."""

import numpy as np
from numpy.typing import NDArray

import mahovik


def power(stand: mahovik.Stand, speeds: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mechanical power of the drives that keep flywheels at given speeds."""
    model: mahovik.Model = mahovik.build(stand, real="double")
    x: mahovik.States = model.states(phi_dot=speeds)
    result = model.torque(x, phi_ddot={"w1": 0.0})
    V_dot: NDArray[np.float64] = model.forward(x, on_error="nan").V_dot
    assert V_dot.shape == (len(x), 6)
    power: NDArray[np.float64] = (result.tau * x.phi_dot).sum(axis=-1)
    return power


def main() -> None:
    """Prints the power of an example, or why there is none."""
    try:
        print(power(mahovik.example("bench8"), np.full((3, 8), 100.0)))
    except mahovik.RefusedError as error:
        print(error.index, error.name)
    except mahovik.MahovikError as error:
        print(error)


if __name__ == "__main__":
    main()
