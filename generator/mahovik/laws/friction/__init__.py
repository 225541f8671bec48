"""Friction along the freedoms of a held carrier: viscous, Coulomb smoothed, and Stribeck's rise at low speed."""
