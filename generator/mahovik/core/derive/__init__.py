"""Equations (2)-(11) derived with SymPy from the paper's own factors, and reduced to tables of harmonics.

Symbols are named like the places of the emitted C they become: `mu[0]`, `J[3]`. Nothing here knows numbers of a
stand, programs or C.
"""
