# Installs the Debian packages of the array `missing`; sourced by the *-packages.sh beside it.
if [ ${#missing[@]} -eq 0 ]; then
  echo "nothing is missing"
  exit 0
fi
if ! command -v apt-get >/dev/null; then
  echo "no apt-get: install what these Debian packages have: ${missing[*]}" >&2
  exit 1
fi
root=()
[ "$(id -u)" -eq 0 ] || root=(sudo)
"${root[@]}" apt-get update
"${root[@]}" apt-get install -y --no-install-recommends "${missing[@]}"
