"""A force that goes with a body: the smallest law, added and taken out again by a test."""
