cat > free.toml <<END
schema = 1
speed = [-1, 1]
harmonics = 0
quality = 1e-9
[[free]]
unbalance = { min = 0, max = "3 kg mm" }
[cost]
unbalance = 0
END
z="--motion $STANDS/shaker2.motion.json"
mahovik design $STANDS/shaker2.toml $z --free free.toml -o new.toml
sed 's/3 kg mm/0.9 kg mm/' free.toml > little.toml
mahovik design $STANDS/shaker2.toml $z --free little.toml -o bad.toml
sed 's/3 kg mm/3 mm/; s/quality/qualiti/' free.toml > bad.toml
mahovik design $STANDS/shaker2.toml $z --free bad.toml -o worse.toml
mahovik design $STANDS/shaker2.toml $z --free unbalanc -o bad.toml
