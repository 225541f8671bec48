"""The public Python interface: `mahovik` re-exports from here what `mahovik.__all__` names."""
