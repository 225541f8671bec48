mahovik check $STANDS/auv6.toml | tail -3
mahovik check $STANDS/remus6.toml | tail -2
mahovik check $STANDS/demo3.toml --phase "w9=1"
mahovik check $STANDS/demo3.toml --phase "w1=1 m"
mahovik modes $STANDS/bench8.toml
mahovik modes $INPUTS/cube.toml --flywheels free
mahovik modes $STANDS/demo3.toml --flywheels maybe
mahovik modes $STANDS/sat4.toml --flywheels free -o model.json
mahovik modes $STANDS/sat4.toml --at acc2 -o bad.json
mahovik modes $STANDS/sat4.toml -o bad.txt
mahovik modes $STANDS/remus6.toml -o bad.json
