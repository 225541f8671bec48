states='{"id": 1, "V": [0, 0, 0, 0, 0, 1], "phi_dot": [100, 0, 0], "want": ["forward", "momentum"]}'
echo "$states" | mahovik eval $STANDS/demo3.toml
echo '{"angles": [0, 0.3, 0], "u": [1.5], "want": ["forward"]}' | mahovik eval $INPUTS/pendulum.toml --backend numpy
mahovik eval $STANDS/demo3.toml --backend numpy <<END
{"want": ["forward"], "V": [1]}
{"want": ["frward"]}
{"want": ["forward"], "phy": [1]}
text
{"want": ["forward"], "phi_dot": [1e12, 0, 0]}
{"want": ["forward"], "u": [1]}
{"want": ["inverse"], "task": "pointing", "demand": [1]}
{"want": ["reaction"]}
END
mahovik eval $INPUTS/pendulum.toml --backend numpy <<END
{"want": ["forward"], "V": [0, 0, 0, 0, 1, 0]}
{"want": ["reaction"]}
{"want": ["forward"], "u": [1, 2]}
{"want": ["forward", "reaction"], "u_dot": [1]}
{"want": ["forward", "coupled"]}
END
mahovik eval $STANDS/sat4.toml --backend numpy <<END
{"want": ["inverse"], "task": "pointin", "demand": [0, 0, 0]}
{"want": ["inverse"], "task": "pointing", "demand": [1, 2]}
{"want": ["inverse"], "demand": [1, 2, 3]}
{"want": ["forward"], "task": "pointing", "demand": [1, 2, 3]}
END
mahovik eval $STANDS/demo3.toml --backend numpy --real float
mahovik eval $STANDS/demo3.toml --backend fortran
