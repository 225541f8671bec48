mahovik check $STANDS/auv6.toml --speed "1000 rpm"
mahovik check $INPUTS/pendulum.toml --dt "1 ms"
mahovik check $STANDS/demo3.toml --speed "3000 mm"
mahovik check $STANDS/demo3.toml --sped 1
mahovik check missing.toml
sed 's/^mass =/mas =/' $STANDS/demo3.toml > bad.toml
mahovik check bad.toml
sed '0,/^mass = .*/s//mass = "2 mm"/' $STANDS/demo3.toml > unit.toml
mahovik check unit.toml
mahovik chek
