#!/usr/bin/env bash
# All tests, from a bare Debian 12: the parsers' tests under AddressSanitizer and UBSan, then every test of the release
# build. ctest's summary is the last thing printed; the exit code is ctest's, or the sanitizers' when only they found fault.
set -euo pipefail
cd "$(dirname "$0")/.."

deploy/install_packages.sh
deploy/build.sh release

# What reads bytes from outside runs with the sanitizers; fuzz targets join by their names.
cmake --preset asan >/dev/null
mapfile -t sanitized < <(cmake --build --preset asan --target help | sed -nE 's/^((unit_(scene|image|base))|fuzz_[a-z0-9_]+): phony$/\1/p' | sort -u)
echo "sanitized: ${sanitized[*]}"
deploy/build.sh asan "${sanitized[@]}"

sanitizer_status=0
export ASAN_OPTIONS="detect_leaks=1:allocator_may_return_null=1:strict_string_checks=1"
export UBSAN_OPTIONS="print_stacktrace=1"
for test in "${sanitized[@]}"; do
  echo "sanitized: running $test"
  "build/asan/bin/$test" --gtest_brief=1 || sanitizer_status=$?
done
[[ "$sanitizer_status" -eq 0 ]] || echo "sanitized: FAILED, exit code $sanitizer_status" >&2

ctest_status=0
ctest --preset release -j "$(nproc)" || ctest_status=$?
[[ "$ctest_status" -ne 0 ]] || exit "$sanitizer_status"
exit "$ctest_status"
