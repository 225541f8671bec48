"""Weight: m g at the centre of mass of every body."""
