"""Linear damping of a body that fades with its speed through the fluid."""
