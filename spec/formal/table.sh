#!/usr/bin/env bash
# Writes table.md: each claim, the statement that is checked, lines of its theory, seconds of processor time of the last build by
# check.sh, and the steps left by hand.
set -euo pipefail
cd "$(dirname "$0")"
[ -f build.log ] || { echo "table.sh: no build.log: run check.sh from a clean folder first" >&2; exit 1; }
{
    printf '# What the kernel has checked\n\nWritten by `table.sh`. Statements are the first lines of the theories; seconds are processor time of one file, without those that it rests on.\n\n'
    printf '| claim | statement checked | lines | seconds | steps left by hand |\n|---|---|---|---|---|\n'
    cat claims.tsv claims_*.tsv 2>/dev/null | grep -v '^#' | sort -u | while IFS=$'\t' read -r claim file theorem covers left; do
        text=$(awk '/^\(\*\*/ { on = 1 } on { print } on && /\*\)/ { exit }' "$file" | tr '\n' ' ' |
            sed -E 's/^\(\*\* *(claim: )?[a-z0-9-]+ *\([^)]*\)[.:]? *//; s/ *\*\) *$//; s/  +/ /g; s/\|/\\|/g; s/\[([^][]*)\]/`\1`/g')
        seconds=$(awk -v target="${file%.v}.vo" '$1 == target { for (i = 1; i <= NF; i++) if ($i == "user:") { sub(",", "", $(i + 1)); print $(i + 1) } }' build.log)
        [ "$covers" = whole ] || left="$covers; $left"
        printf '| [%s](%s) | %s | %d | %s | %s |\n' "$claim" "$file" "$text" "$(wc -l <"$file")" "${seconds:--}" "$left"
    done
    shared=$(ls ./*.v | grep -v 'Claim_\|Link_\|Formulas' | xargs cat | wc -l)
    printf '\nTheories that claims share: %d lines.\n' "$shared"
} >table.md
