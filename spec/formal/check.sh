#!/usr/bin/env bash
# Builds every theory of this folder and holds the table of claims to them. Installs nothing: needs Coq 8.16 with Coquelicot,
# Interval and Flocq (Debian: coq libcoq-coquelicot libcoq-interval). Exit status 0: every theorem of the table is accepted by the
# kernel on the four axioms of the real numbers and nothing else.
#   check.sh [JOBS]            JOBS: processors to use, 2 unless said
set -euo pipefail
cd "$(dirname "$0")"
jobs=${1:-2}
fail() { printf 'check.sh: %s\n' "$*" >&2; exit 1; }
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# Nothing is left unproved or taken for granted, and the kernel's own checks stay on.
shopt -s nullglob
theories=(*.v generated/*.v)
if grep -nE '^[[:space:]]*((Local |Global |#\[[^]]*\] *)*(Axiom|Conjecture|Parameter)s?\b)|\b(Admitted|admit|give_up|bypass_check)\b|\b(Unset|Set) +(Guard|Positivity|Universe) +Checking|-type-in-type' \
    "${theories[@]}" _CoqProject; then
    fail "the lines above leave something unproved"
fi

coq_makefile -f _CoqProject "${theories[@]}" -o Makefile.coq
timed=$([ -x /usr/bin/time ] && echo 1 || true) # seconds of each file, where GNU time is there: for table.sh
make -f Makefile.coq -j "$jobs" TIMED="$timed" 2>&1 | tee build.log >&2 || fail "a theory is not accepted"

# The table: claim, file, theorem, what it covers, steps left by hand. Every row has its theorem, every claim's file a row.
tables=(claims.tsv claims_*.tsv)
grep -hv '^#' "${tables[@]}" >"$scratch/rows"
while IFS=$'\t' read -r claim file theorem covers left; do
    [ -n "$left" ] || fail "$claim: five columns are needed"
    [ -f "../claims/$claim.md" ] || fail "$claim: no page ../claims/$claim.md"
    [ -f "$file" ] || fail "$claim: no file $file"
    grep -q "claim: $claim\b\|^(\*\* $claim " "$file" || fail "$file does not name the claim $claim"
    grep -qE "^Theorem $theorem\b" "$file" || fail "$file has no theorem $theorem"
    case $covers in whole|statement|"steps "*) ;; *) fail "$claim: covers is whole, statement or steps N,N, not $covers" ;; esac
done <"$scratch/rows"
for file in Claim_*.v; do
    cut -f 2 "$scratch/rows" | grep -qx "$file" || fail "$file is in no row of ${tables[*]}"
done

# What they rest on: the statements of the table, the theorems on a hypothesis or on what is printed, on the program's formulas, and on
# the inequalities of the certificates. All at once: the kernel walks through everything below them only once.
grep -oE '^Theorem [A-Za-z0-9_]+' Claim_*.v Link_*.v generated/*.v | sed -E 's/\.v:Theorem /./; s/^generated\///' | sort -u >"$scratch/theorems"
{
    sed -nE "s/^((Claim|Link)_[^.]*)\\..*/From Selfosc Require \\1./p; s/^(Certificate_[^.]*)\\..*/From Selfosc.generated Require \\1./p" "$scratch/theorems" | uniq
    printf 'Definition every := (%s).\nPrint Assumptions every.\n' "$(paste -sd , "$scratch/theorems")"
} >"$scratch/Assumptions.v"
coqc -q -R . Selfosc "$scratch/Assumptions.v" >"$scratch/assumptions" || fail "the theorems could not be asked for their axioms"
grep -q '^Axioms:' "$scratch/assumptions" || fail "no answer about axioms"
awk '
    BEGIN {
        allowed["Axioms:"]; allowed["Classical_Prop.classic"]; allowed["FunctionalExtensionality.functional_extensionality_dep"]
        allowed["ClassicalDedekindReals.sig_not_dec"]; allowed["ClassicalDedekindReals.sig_forall_dec"]
    }
    /^[^ ]/ { if (!($1 in allowed)) { print "a theorem rests on " $1; bad = 1 } }
    END { exit bad }
' "$scratch/assumptions" || fail "an axiom beyond the four of the real numbers"

printf '%d claims, %d theorems: accepted, on the four axioms of the real numbers.\n' \
    "$(cut -f 1 "$scratch/rows" | sort -u | wc -l)" "$(wc -l <"$scratch/theorems")"
