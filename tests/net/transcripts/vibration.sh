mahovik response $STANDS/shaker2.toml --speed left=0..3000rpm --at carrier --steps 3 -o sweep.csv
mahovik response $INPUTS/force_table.toml --speed all=1500rpm --at hold.reaction
mahovik response $STANDS/shaker2.toml --speed left=100 --at point
mahovik response $STANDS/shaker2.toml --speed left=100mm --at carrier
mahovik jitter $STANDS/sat4.toml --speed all=3000rpm --speed rw2=2987rpm --at acc1 --quantity acceleration --order 1 --require "rms 0.1 mm/s2"
mahovik jitter $STANDS/sat4.toml --speed all=3000rpm --at acc1 --require "rms 1 kg"
mahovik quiet $STANDS/sat4.toml --point acc1 --band 20..200Hz --speeds "3040 3022 3040 3022 rpm" --momentum "0 0 40"
mahovik quiet $STANDS/sat4.toml --point acc9 --band 20..200Hz --momentum "0 0 14"
mahovik quiet $STANDS/sat4.toml --point acc1 --band 200..20Hz --momentum "0 0 14"
mahovik quiet $STANDS/sat4.toml --point acc1 --band 20..200Hz --momentum "0 0 14 kg"
