#!/usr/bin/env bash
# Debian packages of `make fuzz`: clang with libFuzzer and its sanitizers; gcc for the coverage. Only what is missing.
set -euo pipefail

missing=()
command -v gcc >/dev/null || missing+=(gcc libc6-dev)
if ! command -v clang >/dev/null; then
  missing+=(clang)
fi
if ! printf '#include <stddef.h>\nint LLVMFuzzerTestOneInput(const char *b, size_t n);\nint LLVMFuzzerTestOneInput(const char *b, size_t n) { return n > 9 && b[0] ? 0 : 0; }\n' |
  clang -x c -fsanitize=fuzzer,undefined,address - -o /dev/null 2>/dev/null; then
  version=$(clang -dumpversion 2>/dev/null | cut -d. -f1 || true)
  missing+=("libclang-rt-${version:-14}-dev")
fi
. "$(dirname "$0")/install-missing.sh"
