#!/usr/bin/env bash
# Whether a wrong formula in the program breaks a proof. Each line below changes one constant, sign or function in Formulas.v, as a change
# of the program would; the theories that link formulas and claims must then be refused. Run after check.sh. Exit status 0: all refused.
set -euo pipefail
cd "$(dirname "$0")"
here=$PWD
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
cp ./*.vo ./Link_*.v "$scratch"
# The program as it is: accepted.
for theory in Link_*.v; do (cd "$scratch" && coqc -q -R . Selfosc "$theory" >/dev/null 2>&1) || { echo "$theory: refused unchanged"; exit 1; }; done
bad=0
while IFS='|' read -r claims definition from to theory; do
    # Within the one definition, the first occurrence.
    FROM="$from" TO="$to" DEFINITION="$definition" perl -0pe '
        s{(Definition $ENV{DEFINITION} \(.*?\.\n)}{my $d = $1; $d =~ s/\Q$ENV{FROM}\E/$ENV{TO}/ or die "no $ENV{FROM} in $ENV{DEFINITION}\n"; $d}se or die "no $ENV{DEFINITION}\n"
    ' Formulas.v >"$scratch/Formulas.v"
    (cd "$scratch" && coqc -q -R . Selfosc Formulas.v >/dev/null 2>&1) || { echo "not a term: $definition: $to"; bad=1; continue; }
    if (cd "$scratch" && coqc -q -R . Selfosc "Link_$theory.v" >/dev/null 2>&1); then
        echo "ACCEPTED  $claims: $definition: $from -> $to"; bad=1
    else
        echo "refused   $claims: $definition: $from -> $to"
    fi
done <<'CHANGES'
kernel-step|step_above_rising|(PI * amplitude)|(2 * PI * amplitude)|describing
kernel-step|step_below_both|-2 * height|2 * height|describing
kernel-ramp|ramp_above_both|sqrt|sin|describing
kernel-ramp|ramp_below_rising|Rmax|Rmin|describing
kernel-sign|sign_both|4 * level|2 * level|describing
kernel-band|band|atan|sin|describing
describing-function|constant_falling|-2 * value|2 * value|describing
describing-function, relay-p, relay-q, relay-f0|relay_hysteresis|Falling|Rising|describing
describing-function|dead_zone_saturation|Band half_width|Band breakpoint|describing
describing-function|backlash|2 * half_gap|half_gap|describing
describing-function|polyline|y1 - y0|y1 + y0|describing
polynomial|polynomial|15 * amplitude|14 * amplitude|describing
relay-f0|relay_f0_by_times|(t_high - t_low)|(t_low - t_high)|identification
switching-condition|condition_40_least_amplitude|+|-|identification
linear-drag, first-harmonic-equations|table_3|-q / omega|q / omega|identification
quadratic-drag, table-3, sine-abs-sine|table_3|8 * amplitude|9 * amplitude|identification
delay-rotation|delay_rotation|+ q|- q|identification
quantisation-alpha, quantisation-zero|quantisation|2 - ratio|3 - ratio|identification
quantisation-beta, quantisation-beta-xx|quantisation|-2, -3|-3, -2|identification
relative-spread|relative_spread|sqrt 2|2|identification
thruster-bilinear|thruster_bilinear|Rabs rate|rate|identification
allocation, compensation|allocation_thrusts|(force + moment|(force - moment|identification
orbit-multiplier|return_slope|1 - mu + d_1|1 - mu - d_1|orbits
orbit-multiplier|orbit_multiplier_denominator|12|13|orbits
orbit-linear|linear_half_width|z - (tanh z)|z - (sinh z)|orbits
orbit-quadratic|quadratic_period|4 * g +|5 * g +|orbits
CHANGES

# The same of certificates: a raised bound, another constant, a wider domain, another variable.
cd "$scratch"
while IFS='|' read -r claim theorem from to; do
    file=$here/generated/Certificate_${claim//-/_}.v
    # The one theorem, so that no other takes time.
    FROM="$from" TO="$to" THEOREM="$theorem" perl -0ne '
        /\A(.*?Open Scope R_scope\.\n)/s or die; print $1; m{(Theorem $ENV{THEOREM} :.*?Qed\.\n)}s or die "no $ENV{THEOREM}\n";
        my $t = $1; $t =~ s/\Q$ENV{FROM}\E/$ENV{TO}/ or die "no $ENV{FROM} in $ENV{THEOREM}\n"; print $t
    ' "$file" >changed.v
    if coqc -q -R . Selfosc changed.v >/dev/null 2>&1; then
        echo "ACCEPTED  certificate of $claim, $theorem: $from -> $to"; bad=1
    else
        echo "refused   certificate of $claim, $theorem: $from -> $to"
    fi
done <<'CHANGES'
orbit-no-early-switching|force_slow|(1 / 4) <=|(2 / 3) <=
orbit-no-early-switching|force_fast|(1 / 2) <= speed|(1 / 16) <= speed
orbit-no-early-switching|braking_drag|1 - mu + drag|1 - mu - drag
orbit-amplitude-monotone-quadratic|quadratic_overshoot_weak|- r * (ln_1p (- r))|+ r * (ln_1p (- r))
orbit-amplitude-monotone-quadratic|logarithm_low|2 * v|3 * v
method-bias-beta-quadratic|at_zero|500 *|20000 *
method-bias-beta-quadratic|at_ten|(3458764513820541 /|(3458764513 /
CHANGES
[ "$bad" = 0 ]
