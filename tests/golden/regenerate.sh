#!/usr/bin/env bash
# Records what a courant binary answers to a broad matrix of questions:
#   tests/golden/regenerate.sh path/to/courant [directory]
# The stored files are from the binary before the redesign of the analysis; tests/golden.rs
# compares every later one with them. Record again only when the matrix grows, and with that
# binary: intended changes belong into explained.toml. Needs jq; takes about 20 s.
# shellcheck disable=SC2086 # a subject is several words
set -euo pipefail
courant=$(realpath "${1:?the path of a courant binary}")
directory=$(realpath "${2:-$(dirname "$0")}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
file=
# Small questions: one thread is quickest, and answers do not depend on the number.
export RAYON_NUM_THREADS=1

# What is left out, for room: texts of equations and long polynomials (`value`, `lower` and `upper`
# pin the root), ends of a single stable stretch (they are the limit), and in `check` all of the
# limits that `limits` answers. Rows become a table: what all share, then columns.
compact='
def flat($path): reduce to_entries[] as {$key, $value} ({};
    if ($value | type) == "object" and ($value | length) > 0 then . + ($value | flat($path + $key + "."))
    else .[$path + $key] = $value end);
def table: map(flat("")) as $rows
    | (reduce $rows[] as $row ([]; . + (($row | keys_unsorted) - .))) as $keys
    | [$keys[] as $key | select(all($rows[]; has($key) and .[$key] == $rows[0][$key])) | $key] as $shared
    | ($keys - $shared) as $columns
    | {all: (reduce $shared[] as $key ({}; .[$key] = $rows[0][$key])), $columns,
       each: [$rows[] as $row | [$columns[] as $key | if $row | has($key) then $row[$key] else "absent" end]]};
def short: if type != "object" then . else
    (if .equation? then .equation |= (del(.text) | if (.polynomial | tostring | length) > 120 then del(.polynomial) else . end) else . end)
    | (if .stable_set? and (.stable_set | length) == 1 then .stable_set[] |= {from, to} else . end) end;
walk(short)
| (if .schema? == "courant.check/1" then (.stability, .monotonicity) |= (if . then {value, evidence} else . end) else . end)
| (if .rows? then .rows |= table else . end) | (if .waves? then .waves |= table else . end)'

# One question: a line {"args", "exit", "answer"}; no answer (bad input) is null.
ask() {
    local exit=0
    timeout 20 "$courant" "$@" --format json >"$work/answer" 2>"$work/error" || exit=$?
    if ((exit > 2)); then
        echo "broke down or took more than 20 s ($exit): $*" >&2
        return 1
    fi
    [[ -s $work/answer ]] || echo null >"$work/answer"
    jq -c "$compact | {args: \$ARGS.positional, exit: $exit, answer: .}" "$work/answer" \
        --args -- "$@" --format json >>"$work/$file"
}

# Time steps around a limit of the subject given: well below, below, at, just above, far above.
# A subject without a positive limit gets two steps.
steps_around() {
    "$courant" limits "$@" --format json | jq -r '.rows[0].stability |
        if .value == null or .value == 0 then "1/10", "1" else
            .value / 2, (.exact // "" | select(test("^[0-9/]+$"))),
            .lower, .value * 1.000000001, .value * 1.5 end'
}

schemes="euler-sph lax-wendroff-sph godunov-sph"
kernels="cubic-spline quartic-spline quintic-spline gaussian wendland-c2 wendland-c4 wendland-c6"
integrators="forward-euler symplectic-euler centred-euler leapfrog-kdk leapfrog-kdk-predicted
    rk2-midpoint rk2-heun rk3-ssp rk4 predictor-corrector"
budgets=1e-9,1e-6,1e-3

for scheme in $schemes; do
    file=limits-$scheme.jsonl
    for kernel in $kernels; do
        ask limits --scheme "$scheme" --kernel "$kernel" --ratio 1,1.3,3/2,2,2.5,3,4,5,10
    done
    ask limits --scheme "$scheme" --kernel cubic-spline,gaussian --ratio 1/3,1/2,3/4
    for kernel in cubic-spline gaussian wendland-c4; do
        ask limits --scheme "$scheme" --kernel $kernel --ratio 1,3/2,3 --growth $budgets
        ask limits --scheme "$scheme" --kernel $kernel --ratio 1.3,2,3 --digits 40
        ask limits --scheme "$scheme" --kernel $kernel --ratio 1.3,2,3 --samples 200
    done
    ask limits --scheme "$scheme" --ratio 2 --max-cfl 3/2
done

methods=("sph" "sph-av --alpha 1" "sph-av --alpha 1/2" "gph")
for method in "${methods[@]}"; do
    file=limits-${method%% *}.jsonl
    some="cubic-spline gaussian wendland-c2 quintic-spline"
    [[ $method == *1/2 ]] && some="cubic-spline wendland-c2"
    for integrator in $integrators; do
        subject="--method $method --integrator $integrator"
        for kernel in $some; do
            ask limits $subject --kernel $kernel --ratio 1,1.2,1.5,2,3
        done
        ask limits $subject --ratio 1/3,1/2,2/3
        [[ $method == *1/2 ]] || ask limits $subject --ratio 1.2 --growth 1e-6,1e-3
    done
    ask limits --method $method --integrator rk4 --ratio 1.2,2 --digits 40
done

file=check.jsonl
for scheme in $schemes; do
    for kernel in cubic-spline gaussian; do
        for ratio in 1 3/2 3; do
            subject="--scheme $scheme --kernel $kernel --ratio $ratio"
            for step in $(steps_around $subject); do ask check $subject --cfl "$step"; done
        done
    done
    ask check --scheme "$scheme" --ratio 2 --cfl 1/2 --growth 1e-1
done
for method in sph sph-av gph; do
    for integrator in $integrators; do
        subject="--method $method --integrator $integrator --ratio 1.2"
        for step in $(steps_around $subject); do ask check $subject --cfl "$step"; done
    done
done
# Bad input keeps its exit code.
ask check --scheme no-such-scheme --ratio 2 --cfl 1
ask check --scheme godunov-sph --ratio 0 --cfl 1
ask check --method sph --ratio 1.2 --cfl 1

file=symbol.jsonl
for scheme in $schemes; do
    for kernel in $kernels; do
        for ratio in 3/2 2; do ask symbol --scheme "$scheme" --kernel "$kernel" --ratio $ratio; done
    done
    ask symbol --scheme "$scheme" --ratio 5
done

file=dispersion.jsonl
for method in "${methods[@]}"; do
    ask dispersion --method $method --ratio 1,1.2,2 --kappa 0,0.1,1,2,3,4,6
    for kernel in gaussian wendland-c2 quintic-spline; do
        ask dispersion --method $method --kernel $kernel --ratio 1.2 --kappa 0.5,2,3
    done
    ask dispersion --method $method --ratio 1.2 --kappa 1 --density mass
    for integrator in $integrators; do
        ask dispersion --method $method --integrator $integrator --cfl 0.3 --ratio 1.2 --kappa 0.5,3
    done
done
for form in resolved published; do ask dispersion --method gph --form $form --ratio 1.2 --kappa 0.5,2.5; done

file=validate.jsonl
for scheme in $schemes; do
    for kernel in cubic-spline gaussian; do
        ask validate --scheme "$scheme" --kernel $kernel --ratio 3/2 --particles 8 --steps 5
    done
done
for method in sph sph-av gph; do
    for integrator in symplectic-euler leapfrog-kdk rk4; do
        ask validate --method $method --integrator $integrator --kernel cubic-spline --particles 8 --steps 20
    done
done

mv "$work"/*.jsonl "$directory/"
