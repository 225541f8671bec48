sed 's/^mass = 10.*/mass = 11.0/; s/^inertia = .*/inertia = [0.2, 0.2, 0.2]/' $STANDS/demo3.toml > heavy.toml
mahovik judge $STANDS/demo3.toml --with "$PYTHON -m mahovik eval {stand} --backend numpy" --want forward --states 3 --explain
mahovik judge $STANDS/demo3.toml --with "$PYTHON -m mahovik eval heavy.toml --backend numpy" --want forward,momentum --states 3
mahovik judge $STANDS/demo3.toml --explain
mahovik judge $STANDS/demo3.toml --with no-such-program
mahovik judge $STANDS/demo3.toml --with cat --want frward
mahovik judge $STANDS/demo3.toml --with cat --tolerance 0
mahovik judge $INPUTS/pendulum.toml --states 3 --with "$PYTHON -m mahovik eval {stand} --backend numpy" --want forward,torque
mahovik judge $STANDS/demo3.toml --states 2 --with cat
mahovik new adapter
mahovik judge $STANDS/demo3.toml --states 2 --with "$PYTHON adapter.py" --attitude quaternion --want forward,torque
