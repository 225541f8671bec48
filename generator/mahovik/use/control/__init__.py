"""Following a programme on a real stand: gains, stability, mismatch, sampled loop, trim, causes of errors."""
