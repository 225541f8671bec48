mahovik generate $STANDS/shaker2.toml -o c --only forward,torque --with selftest --prefix fw > /dev/null
cc -O1 -ffp-contract=off -DFW_SELFTEST_MAIN -Ic c/fw.c c/verification/fw_selftest.c -o selftest
./selftest > board.log
mahovik verify $STANDS/shaker2.toml --against c --states 3
mahovik judge-log $STANDS/shaker2.toml --log board.log --only forward,torque
mahovik judge-log $STANDS/shaker2.toml --log board.log
mahovik judge-log $STANDS/demo3.toml --log board.log --only forward,torque
sed 's/torque PASS/torque FAIL/' board.log > failed.log
mahovik judge-log --log failed.log
mahovik judge-log --log c/fw.c
mahovik judge-log $STANDS/shaker2.toml --log board.log --only forwart
