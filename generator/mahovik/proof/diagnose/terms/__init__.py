"""Wrong terms of a program: a sparse fit of its error over the products that occur in the equations."""
