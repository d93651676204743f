#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# ./run.sh [OUT.json]: every engine test, agreement with the CPU, benches, in under 8 minutes, into one JSON file.
# Exit status 4 if a test did not pass, 5 without a device.
out=${1:-gpu_check.json}
exec "$(dirname "$0")/bin/gpu_check" "$(dirname "$0")" "$out"
