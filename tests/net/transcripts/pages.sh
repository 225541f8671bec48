mahovik report $STANDS/demo3.toml -o page.pdf
mahovik report $STANDS/demo3.toml --derivation -o page.html
mahovik report $STANDS/demo3.toml --derivation -o page.pdf
