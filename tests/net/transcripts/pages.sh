mahovik report $STANDS/demo3.toml -o page.pdf
mahovik report $STANDS/demo3.toml -o page.html --run missing.csv
mahovik derive $STANDS/demo3.toml -o page.tex
mahovik derive $STANDS/demo3.toml -o page.pdf
