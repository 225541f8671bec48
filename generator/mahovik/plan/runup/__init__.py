"""Run-up from rest into a periodic programme, and run-down: by shooting, the carrier free to deviate on the way."""
