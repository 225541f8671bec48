mahovik evidence $STANDS/demo3.toml --only delivery -o out
mahovik evidence --check out
echo more >> out/c/demo3.c
mahovik evidence --check out
mahovik evidence $STANDS/demo3.toml --only deliver -o other
mahovik verify $STANDS/demo3.toml --cost --targets m8
ONLY_PATH=/nowhere mahovik check --tools | grep -v 'extra\|───' | tr -s ' '
