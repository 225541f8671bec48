"""Diagnosis of a foreign program: its error is compared with the error that each fault of a dictionary would make."""
