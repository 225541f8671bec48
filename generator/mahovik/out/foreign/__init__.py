"""Stand files from models of other programs: URDF and MuJoCo's MJCF.

The reader of each format returns a `ForeignModel`, links on fixed and turning joints, and refuses features that a stand
cannot have. `merge` turns it into a Stand, `agreement` compares that with Pinocchio or MuJoCo on the original file.
"""
