"""Suspension of the carrier to E0 by a 6x6 stiffness and a 6x6 damping."""
