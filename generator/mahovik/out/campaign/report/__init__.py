"""Report of a campaign: one page on what its rows say, read by DuckDB, and its worst samples as stand files."""
