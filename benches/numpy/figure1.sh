#!/bin/sh
# The whole of `courant map` (files and picture included) beside the arithmetic alone of the NumPy script, in turn.
set -e
cd "$(dirname "$0")/../.."
cargo build --release --quiet
target="${CARGO_TARGET_DIR:-target}"
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT
for run in 1 2 3 4 5 6 7; do
    numpy=$(OPENBLAS_NUM_THREADS=1 python3 benches/numpy/figure1.py)
    start=$(date +%s.%N)
    "$target/release/courant" map --scheme godunov-sph --kernel cubic --ratio 1:10:0.0225 --cfl 0:12:0.03 \
        --out "$out" >/dev/null
    echo "$numpy $start $(date +%s.%N)"
done | awk '{ here = $3 - $2
    if (NR == 1 || $1 < numpy) numpy = $1
    if (NR == 1 || here < least) least = here
} END { printf "NumPy, arithmetic alone: %.3f s; courant map, all of it: %.3f s; share: %.2f\n", numpy, least, least / numpy }'
