"""Documents: what is printed is what was derived, and the numbers are the stand's."""
