#!/usr/bin/env bash
# What `make proofs` needs: Debian packages, only what is missing.
set -euo pipefail

missing=()
command -v frama-c >/dev/null || missing+=(frama-c-base)
command -v gcc >/dev/null || missing+=(gcc)
command -v clang >/dev/null || missing+=(clang)
command -v cppcheck >/dev/null || missing+=(cppcheck)
# clang's sanitizers and fuzzer are a package of their own
echo 'int main(void) { return 0; }' | clang -fsanitize=undefined -x c -o /dev/null - 2>/dev/null \
  || missing+=(libclang-rt-14-dev)
. "$(dirname "$0")/install-missing.sh"
