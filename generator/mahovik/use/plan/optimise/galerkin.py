"""Fourier coefficients of the residual and their derivatives by the unknowns, from samples, by FFT.

For a real R(t) at M uniform times the rows are R_0, sqrt(2) Re R_j, sqrt(2) Im R_j, for harmonics j of a range: the
sum of their squares is the mean square of those harmonics. A wave cos or sin (k Omega t) of a flywheel moves the
harmonics j - k and j + k of dR/dphi, dR/dphi', dR/dphi'' to j: no product of matrices is needed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.use.plan.array import Array

Complex = NDArray[np.complex128]


def coefficients(R: Array, first: int, last: int) -> Array:
    """Rows of R (M, 6) for harmonics first..last; 2 last < M."""
    return rows(np.fft.rfft(R, axis=0)[first : last + 1] / len(R), first)


def rows(spectrum: Complex, first: int) -> Array:
    """Real rows of complex coefficients (J, 6, ...) of harmonics `first` and on; for the mean, the real part only."""
    double = np.sqrt(2.0)
    mean = 1 if first == 0 else 0
    parts = [spectrum[:mean].real, double * spectrum[mean:].real, double * spectrum[mean:].imag]
    return np.concatenate([x.reshape(-1, *spectrum.shape[2:]) for x in parts])


def derivatives(by_phi: Array, by_phi_dot: Array, by_phi_ddot: Array, Omega: float, H: int, last: int) -> Complex:
    """Harmonics 0..last (last + 1, 6, N (2H + 1)) of the change of R by each wave; by_... are (M, 6, N).

    Omega: 2 pi over the period, rad/s. Waves of a flywheel: mean, cosines 1..H, sines 1..H.
    """
    M, R, N = by_phi.shape
    A, B, C = (np.fft.fft(x, axis=0) / M for x in (by_phi, by_phi_dot, by_phi_ddot))
    j, k = np.arange(last + 1)[:, None], np.arange(H + 1)[None, :]
    rate = (Omega * np.arange(H + 1))[None, :, None, None]
    below, above = (j - k) % M, (j + k) % M
    up = A[below] + 1j * rate * B[below] - rate**2 * C[below]
    down = A[above] - 1j * rate * B[above] - rate**2 * C[above]  # (last + 1, H + 1, 6, N)
    found = np.empty((last + 1, R, N, 2 * H + 1), dtype=np.complex128)
    found[..., : H + 1] = np.moveaxis((up + down) / 2.0, 1, 3)
    found[..., H + 1 :] = np.moveaxis((up - down)[:, 1:] / 2j, 1, 3)
    return found.reshape(last + 1, R, N * (2 * H + 1))
