mahovik new demo3
mahovik generate demo3.toml | grep -v provenance
mahovik generate demo3.toml --check
mahovik generate demo3.toml -o part --only forward,torque --prefix fw --real float | grep -v provenance
mahovik generate demo3.toml -o part --check
echo "/* by hand */" >> demo3/demo3.c
mahovik generate demo3.toml --check
mahovik generate demo3.toml -o part --check --real double
mahovik generate demo3.toml --only forwart | grep -v provenance
mahovik generate demo3.toml --real half
mkdir mine; echo text > mine/demo3.c
mahovik generate demo3.toml -o mine | grep -v provenance
mahovik new demo3
mahovik new bench9
