"""Studies of a stand: rest, linear model, response to unbalance, reach, quiet speeds, resolution of float."""
