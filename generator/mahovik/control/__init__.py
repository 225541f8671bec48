"""Following a programme on a real stand: mismatch, plant, sampled loop, trim; how well it follows and what limits it."""
