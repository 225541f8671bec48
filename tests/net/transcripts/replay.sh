# $INPUTS/flight.log: eight steps of demo3, recorded by tests/targets/flight.py; its bits are those of `step`
log=$INPUTS/flight.log
mahovik replay $STANDS/demo3.toml --log $log -o states.csv
mahovik replay $STANDS/shaker2.toml --log $log
sed '5s/00/01/' $log > damaged.log
mahovik replay $STANDS/demo3.toml --log damaged.log
mahovik replay $STANDS/demo3.toml --log $log -o states.txt
mahovik replay $STANDS/demo3.toml --log $STANDS/demo3.toml
