"""Questions about a stand: rest, linear model, response to unbalance, cost; which fault a program of it has."""
