"""Stand files made of the models of other programs: URDF and MuJoCo's MJCF.

A reader of each format gives a `ForeignModel`: links on fixed and turning joints, with what cannot be a stand refused
by name. `merge` makes a Stand of it, `agreement` compares that with Pinocchio or MuJoCo on the original file.
"""
