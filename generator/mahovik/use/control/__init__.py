"""Following a programme on a real stand: gains, stability, mismatch, sampled loop, trim; what limits it."""
