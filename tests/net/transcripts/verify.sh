mahovik verify $STANDS/demo3.toml --states 0
mahovik verify $STANDS/demo3.toml nowhere
mahovik verify $STANDS/demo3.toml --targets m8
