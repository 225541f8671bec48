"""Everything that speaks for the C of one stand, in one folder: run piece by piece, kept, summed up on a page."""
