cat > c.toml <<END
schema = 1
stand = "shaker2"
samples = 6
shard = 4
[vary]
"carrier.mass" = { tolerance = "1 kg" }
[over]
regime = { default = { speed = "600 rpm" } }
until = "10 ms"
dt = "1 ms"
[[quantity]]
name = "shake"
what = "rms acceleration"
at = "carrier"
END
mahovik campaign run c.toml -o out --prepare
mahovik campaign shard out 0
mahovik campaign status out
mahovik campaign merge out -o all.parquet
mahovik campaign shard out 1
mahovik campaign merge out -o all.parquet
mahovik campaign shard out 3
mahovik campaign status nowhere
sed 's/samples/sampels/; s/10 ms/10 mm/' c.toml > bad.toml
mahovik campaign run bad.toml -o other
sed 's/carrier.mass/carrier.mas/' c.toml > path.toml
mahovik campaign run path.toml -o other
