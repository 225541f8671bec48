cat > c.toml <<END
schema = 1
stand = "shaker2"
samples = 6
chunk = 4
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
mahovik campaign c.toml -o out --chunk 0
mahovik campaign c.toml -o out --workers 1 --merge all.parquet
mahovik campaign c.toml -o out --chunk 2
sed 's/1 kg/2 kg/' c.toml > other.toml
mahovik campaign other.toml -o out
sed 's/samples/sampels/; s/4/"4"/' c.toml > bad.toml
mahovik campaign bad.toml -o other
sed 's/carrier.mass/carrier.mas/' c.toml > path.toml
mahovik campaign path.toml -o other
