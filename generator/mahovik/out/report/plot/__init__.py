"""Pictures of programmes and runs."""
