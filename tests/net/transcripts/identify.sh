data="--data $INPUTS/two.csv"
mahovik identify $INPUTS/two.toml $data --free "w*.mass" -o new.toml
mahovik identify $INPUTS/two.toml $data --free "w*.unbalanc" -o bad.toml
mahovik identify $INPUTS/two.toml --data missing.csv --free "w*.mass" -o bad.toml
mahovik balance $INPUTS/two.toml $data --plane "w9=10 mm"
echo '{"A": ["170@112"], "B": [["235@94"]], "U": ["1.15@0"], "keep_trial": false}' > influence.json
mahovik balance --influence influence.json
echo '{"A": ["170@112"], "B": [["235@94", "1@1"]], "U": ["1.15@0"]}' > bad.json
mahovik balance --influence bad.json
mahovik balance --influence influence.json --method best
mahovik balance
