printf 'schema = 1\ndefault = { speed = "300 rpm" }\n' > regime.toml
mahovik simulate $STANDS/shaker2.toml --regime regime.toml --until "20 ms" --every "10 ms" -o run.csv
mahovik simulate $INPUTS/pendulum.toml --until "20 ms" --every "10 ms" -o held.csv --backend scipy
mahovik simulate $STANDS/shaker2.toml --regime regime.toml --until "20 ms" --every "1 ms" -o run.svg
mahovik simulate $STANDS/demo3.toml --until "20 mm" -o bad.csv
mahovik simulate $STANDS/demo3.toml --until "20 ms" -o bad.txt
sed 's/default/defalt/' regime.toml > bad.toml
mahovik simulate $STANDS/demo3.toml --regime bad.toml --until "20 ms" -o bad.csv
sed 's/speed/sped/' regime.toml > bad.toml
mahovik simulate $STANDS/demo3.toml --regime bad.toml --until "20 ms" -o bad.csv
echo '{"V": [1]}' > bad.json
mahovik simulate $STANDS/demo3.toml --start bad.json --until "20 ms" -o bad.csv
mahovik simulate $STANDS/demo3.toml --until "20 ms" -o bad.csv --order 3
