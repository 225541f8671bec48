"""Numbers of a stand from measured data: what is free, prediction by the C, least squares, the new stand file."""
