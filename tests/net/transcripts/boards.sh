mahovik generate $STANDS/shaker2.toml -o c --only forward,torque --with selftest --prefix fw > /dev/null
cc -O1 -ffp-contract=off -DFW_SELFTEST_MAIN -Ic c/fw.c c/verification/fw_selftest.c -o selftest
./selftest > board.log
mahovik verify $STANDS/shaker2.toml c --states 3
mahovik verify $STANDS/shaker2.toml board.log --only forward,torque
mahovik verify $STANDS/shaker2.toml board.log
mahovik verify $STANDS/demo3.toml board.log --only forward,torque
sed 's/torque PASS/torque FAIL/' board.log > failed.log
mahovik verify $STANDS/shaker2.toml failed.log
mahovik verify $STANDS/shaker2.toml c/fw.c
mahovik verify $STANDS/shaker2.toml board.log --only forwart
