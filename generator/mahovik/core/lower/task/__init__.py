"""Functions of the stand's tasks: the inverse problem of chosen components of the carrier's motion."""
