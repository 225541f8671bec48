mahovik vibration $STANDS/shaker2.toml --speed left=0..3000rpm --at carrier --steps 3 --quantity displacement -o sweep.csv
mahovik vibration $INPUTS/force_table.toml --speed all=1500rpm --at hold.reaction
mahovik vibration $STANDS/shaker2.toml --speed left=100 --at point
mahovik vibration $STANDS/shaker2.toml --speed left=100mm --at carrier
mahovik vibration $STANDS/sat4.toml --speed all=3000rpm --speed rw2=2987rpm --at acc1 --quantity acceleration --require "rms 0.1 mm/s2"
mahovik vibration $STANDS/sat4.toml --speed all=3000rpm --at acc1 --require "rms 1 kg"
mahovik vibration $STANDS/sat4.toml --speed all=3040rpm --at acc1 --improve --momentum "0 0 40"
mahovik vibration $STANDS/sat4.toml --speed all=3040rpm --at acc9 --improve
mahovik vibration $STANDS/sat4.toml --speed all=3040rpm --at acc1 --band 200..20Hz
mahovik vibration $STANDS/sat4.toml --speed all=3040rpm --at acc1 --improve --momentum "0 0 14 kg"
