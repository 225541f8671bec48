"""Many samples of a stand whose numbers vary: what is drawn, what is computed of each, and the shards that keep it.

Enters: a stand and a campaign file. Leaves: for every sample, a row of parameters and quantities.
"""
