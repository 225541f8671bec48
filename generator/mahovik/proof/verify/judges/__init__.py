"""Outside judges: multibody programs of others, given the same stand, against the generated C.

They know rigid bodies on joints, so a stand with a fluid or a law of `laws/` is refused here. They are no dependencies:
`pip install pin mujoco`, or the extra `judges`. Basilisk (`pip install bsk`, extra `basilisk`) judges free stands of
symmetric flywheels only.
"""
