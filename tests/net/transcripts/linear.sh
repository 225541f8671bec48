mahovik rest $STANDS/auv6.toml
mahovik rest $STANDS/remus6.toml
mahovik rest $STANDS/demo3.toml --phase "w9=1"
mahovik rest $STANDS/demo3.toml --phase "w1=1 m"
mahovik modes $STANDS/bench8.toml
mahovik modes $INPUTS/cube.toml --flywheels free
mahovik modes $STANDS/demo3.toml --flywheels maybe
mahovik linearize $STANDS/sat4.toml -o model.json
mahovik linearize $STANDS/sat4.toml --points acc2 -o bad.json
mahovik linearize $STANDS/sat4.toml -o bad.txt
mahovik linearize $STANDS/remus6.toml -o bad.json
