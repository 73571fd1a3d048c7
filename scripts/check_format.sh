#!/usr/bin/env bash
# Fails if a source file is not as clang-format 14 would write it.
set -euo pipefail
cd "$(dirname "$0")/.."
git ls-files '*.h' '*.cpp' | xargs clang-format-14 --dry-run --Werror
