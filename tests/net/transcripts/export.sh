mahovik export cmake $STANDS/demo3.toml --only forward -o cmake
mahovik export target $STANDS/demo3.toml --target m7 --only forward -o board
mahovik export fmu $STANDS/demo3.toml --no-binary
mahovik export target $STANDS/demo3.toml --target m77
mahovik export fmu $STANDS/demo3.toml --kind both
mahovik export fmu $STANDS/demo3.toml --dt "1 mm"
mahovik export sevro $STANDS/demo3.toml
