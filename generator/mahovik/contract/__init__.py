"""The contract as data: quantities, public functions and statuses.

Stages iterate over it and keep no list of their own. It imports nothing of the package and computes nothing.
"""
