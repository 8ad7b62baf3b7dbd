#!/usr/bin/env bash
# The commands behind trust.md, some hours on two cores. Each prints its table; `--list` adds one line a record.
set -euo pipefail
cd "$(dirname "$0")/.."
score() { cargo run --release -p selfosc-trust -- --threads 2 "$@"; }
# Kinds, one a line, from standard input.
of_kinds() { local kinds=(); while read -r kind; do kinds+=(--kind "$kind"); done; score "${kinds[@]}" "$@"; }

# Kinds inside the plain model that every run has.
inside='linear, noise
linear, 1 degree
quadratic, 1 degree
quadratic, noise, delay unknown
mixed, noise
mixed, 1 degree
mixed, noise, delay unknown
mixed, linear part 1 to 8 %
mixed, quadratic part 1 to 8 %
negative linear and quadratic
rounding alone
rounding alone, delay unknown
locked cycles
locked cycles, delay unknown
irregular samples
5 Hz
20 s
2 degrees
strong constant force
zig-zag, rudder logged'

# all kinds, the run before
of_kinds --records 100 --seed 6000000 --list <<KINDS
$inside
lag 0.1 s
lag 0.2 s
lag 0.3 s, delay unknown
lag 0.2 s, delay unknown
rate limit 4 C/s
rate limit 4 C/s, delay unknown
stiffness 0.006 C/rad
stiffness 0.02 C/rad
stiffness 0.1 C/rad
stiffness 0.1 C/rad, delay unknown
current 0.05 C, 40 s
tether
random-walk force 0.01
autoregressive noise 0.9
autoregressive noise 0.6, delay unknown
heading walk 0.1 degree
delay given 0 for 0.2
delay given 0.3 for 0.2
10 % missing
30 % missing
gaps of 0.7 s
stamps late by up to 60 ms
negative linear and cubic
linear and cubic
drag 30 % larger to one side
Coulomb friction 0.1 C
entrained water, 1 s
sensor filter 0.2 s
sensor filter 0.5 s, delay unknown
lag 0.2 s, stiffness 0.05 C/rad
zig-zag, orders logged
second-order lag, 12 rad/s, damping 0.7
second-order lag, 12 rad/s, damping 0.7, delay unknown
two lags 0.15 s
alpha drifts by 10 %, delay unknown
thrust sags by 10 %
outliers 1 %
outliers 3 %, delay unknown
noise with heavy tails
drag of power 1.5
stamps to 50 ms of irregular samples
sensor refreshed at 3.3 Hz
outliers 1 %, stiffness 0.05 C/rad, 10 % missing
rounding alone, 280 s
200 s
partly locked cycles
ideal relay
0.1 degree
20 Hz
1 degree with noise 0.3, grid offset
quadratic, noise
negative linear and quadratic, delay unknown
wrapped heading
two levels in one record
lag 0.05 s
stiffness 0.02 C/rad, delay unknown
linear and cubic, delay unknown
rounding alone, lag 0.1 s
10 % missing, delay unknown
Coulomb friction 0.03 C
drag 10 % larger to one side
lag 0.2 s, 10 % missing
waves 0.1 C, 4 s
KINDS

# kinds with missing samples or jittered stamps
of_kinds --records 300 --seed 8300000 --list <<KINDS
10 % missing
30 % missing
gaps of 0.7 s
10 % missing, delay unknown
lag 0.2 s, 10 % missing
outliers 1 %, stiffness 0.05 C/rad, 10 % missing
stamps to 50 ms of irregular samples
KINDS

# inside the plain model and its family
of_kinds --records 100 --seed 8100000 <<KINDS
$inside
rounding alone, 280 s
200 s
partly locked cycles
ideal relay
0.1 degree
20 Hz
1 degree with noise 0.3, grid offset
quadratic, noise
negative linear and quadratic, delay unknown
wrapped heading
two levels in one record
KINDS

# several records
score --records 100 --seed 8200000 --group several --list

# what no record of one level can show
score --records 100 --seed 7000000 --group unshowable --list

# Structures outside the family
score --records 100 --seed 8200000 --group outside --list

# The four kinds that missed most, once more
of_kinds --records 300 --seed 8200000 <<KINDS
mixed, linear part 1 to 8 %
locked cycles
locked cycles, delay unknown
wrapped heading
KINDS

# Practical intervals, and the coverage by linear drag and length
cargo build --release -p selfosc -p selfosc-simulator --bins
python3 tests/trust/practical.py target/release/selfosc target/release/selfosc-simulator 26 5610000
python3 tests/trust/unseen.py target/release/selfosc 5 5595000
python3 tests/trust/cells.py target/release/selfosc 100 5700000
