"""Stand files from models of other programs: URDF and MJCF, which MuJoCo's `MjSpec` reads, and SDF, which `sdf` reads.

All become one tree of bodies on joints (`model`), of which `stand` makes the text of a stand file.
"""
