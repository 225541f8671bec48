#!/usr/bin/env bash
# Debian packages that the tests want beside gcc and make: installed only where something is missing.
set -euo pipefail

missing=()
command -v gcc >/dev/null || missing+=(gcc)
command -v g++ >/dev/null || missing+=(g++)
command -v clang >/dev/null || missing+=(clang)
command -v chromium >/dev/null || missing+=(chromium fonts-liberation fonts-dejavu-core)
command -v pdflatex >/dev/null || missing+=(texlive-latex-base lmodern)
command -v x86_64-w64-mingw32-gcc >/dev/null || missing+=(gcc-mingw-w64-x86-64)
command -v x86_64-w64-mingw32-g++ >/dev/null || missing+=(g++-mingw-w64-x86-64)
command -v ld.lld >/dev/null || missing+=(lld)
printf '#include <sys/types.h>\nint x;\n' | gcc -m32 -fsyntax-only -x c - 2>/dev/null || missing+=(gcc-multilib)
. "$(dirname "$0")/install-missing.sh"
