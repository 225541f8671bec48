"""Parameters in which the equations are linear: their names and values, and which combinations motion can show."""
