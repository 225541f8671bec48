mahovik verify $INPUTS/pendulum.toml --states 3 --with "$PYTHON -m mahovik eval {stand} --backend numpy" --want forward,torque
mahovik verify $STANDS/demo3.toml --states 2 --with cat
mahovik verify $STANDS/demo3.toml --states 0
mahovik verify $STANDS/demo3.toml --with cat --want frward
mahovik verify $STANDS/demo3.toml --against nowhere
mahovik verify $STANDS/demo3.toml --targets m8
