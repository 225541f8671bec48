#!/usr/bin/env bash
# Compilers and emulators of `mahovik verify --targets` and `mahovik verify --cost`: Debian packages, only what is missing.
set -euo pipefail

missing=()
need() { # command, then the packages that bring it
  command -v "$1" >/dev/null || missing+=("${@:2}")
}
need gcc gcc libc6-dev
need clang clang
need arm-none-eabi-gcc gcc-arm-none-eabi
need riscv64-unknown-elf-gcc gcc-riscv64-unknown-elf
need aarch64-linux-gnu-gcc gcc-aarch64-linux-gnu libc6-dev-arm64-cross
need qemu-system-arm qemu-system-arm
need qemu-system-riscv64 qemu-system-misc
need qemu-aarch64 qemu-user
need valgrind valgrind
# C libraries have no command: their headers tell.
has_header() { # compiler and flags
  command -v "$1" >/dev/null && echo '#include <string.h>' | "$@" -E -x c - >/dev/null 2>&1
}
has_header arm-none-eabi-gcc || missing+=(libnewlib-arm-none-eabi)
has_header riscv64-unknown-elf-gcc --specs=picolibc.specs || missing+=(picolibc-riscv64-unknown-elf)
has_header aarch64-linux-gnu-gcc || missing+=(libc6-dev-arm64-cross)
. "$(dirname "$0")/install-missing.sh"
