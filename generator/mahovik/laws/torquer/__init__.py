"""Magnetic torquers: dipoles on the carrier or an instrument, in a magnetic field constant in E0."""
