mahovik generate $STANDS/demo3.toml --project cmake --only forward -o cmake
mahovik generate $STANDS/demo3.toml --project m7 --only forward -o board
mahovik generate $STANDS/demo3.toml --project fmu --fmu binary=no
mahovik generate $STANDS/demo3.toml --project m77
mahovik generate $STANDS/demo3.toml --project fmu --fmu kind=both
mahovik generate $STANDS/demo3.toml --project fmu --fmu dt="1 mm"
mahovik generate $STANDS/demo3.toml --servo s.toml
