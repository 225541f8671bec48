mahovik new shaker2
spin="--motion shaker2_spin.motion.json"
mahovik plan shaker2.toml $spin -o p.json
# where a residual that is nearly 0 is largest depends on the machine
mahovik verify shaker2.toml p.json $spin | sed '/^ *\(residual\|simulation\|0\.0\)/d'
mahovik verify shaker2.toml p.json --motion shaker2.motion.json | sed '/^ *\(residual\|simulation\|0\.0\)/d'
mahovik verify shaker2.toml shaker2_spin.motion.json --motion p.json
mahovik plan shaker2.toml --motion missing.json -o q.json
mahovik plan shaker2.toml $spin -o q.json --stand n.toml
mahovik plan shaker2.toml $spin -o q.json --method guess
mahovik plan shaker2.toml $spin -o p.svg
printf 'schema = 1\nsample_period = "0.5 ms"\nlatency = "100 us"\nbandwidth = "40 Hz"\n' > servo.toml
follow="mahovik simulate shaker2.toml $spin --programme p.json"
$follow --servo servo.toml --periods 11 --mismatch 2% -o run.csv
$follow --servo servo.toml --mismatch 2
$follow --servo servo.toml --periods 3
$follow
sed 's/0.5 ms/0.5 mm/; s/latency/latencie/' servo.toml > bad.toml
$follow --servo bad.toml
mahovik generate shaker2.toml -o c --only forward > generate.log
mahovik generate shaker2.toml $spin --programme p.json --servo servo.toml -o c
mahovik generate $STANDS/demo3.toml --programme p.json -o table
