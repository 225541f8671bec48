cat > m.json <<END
{"schema": 1, "type": "periodic", "period": 0.05, "winding": "spin", "harmonics": [{"k": 1, "cos": [0, 0, 3e-4, 0, 0, 0]}],
 "free": {"*t.unbalance.static": [0, "3 kg mm"]}, "same": [["*t.unbalance.static"]]}
END
plan="mahovik plan $STANDS/shaker2.toml --motion"
$plan m.json --free "*t.unbalance.static" --stand new.toml -o p.json
mahovik verify new.toml p.json --motion m.json | tail -1
sed 's/3 kg mm/3 mm/' m.json > bad.json
$plan bad.json --free "*t.unbalance.static"
$plan m.json --free "left.center_of_mass[0]"
$plan m.json --free "left.unbalanc"
$plan m.json --stand new.toml
