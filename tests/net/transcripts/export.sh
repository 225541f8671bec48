mahovik generate $STANDS/demo3.toml --project cmake --only forward -o cmake | grep -v provenance
mahovik generate $STANDS/demo3.toml --project m7 --only forward -o board | grep -v provenance
mahovik generate $STANDS/demo3.toml --project fmu --fmu binary=no | grep -v provenance
mahovik generate $STANDS/demo3.toml --project m77
mahovik generate $STANDS/demo3.toml --project fmu --fmu kind=both | grep -v provenance
mahovik generate $STANDS/demo3.toml --project fmu --fmu dt="1 mm" | grep -v provenance
mahovik generate $STANDS/demo3.toml --servo s.toml
