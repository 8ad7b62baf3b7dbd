#!/usr/bin/env bash
# Builds the page and tests it in Debian's Chromium, beside the command in SELFOSC_COMMAND. Installs what it needs as root.
set -euo pipefail
cd "$(dirname "$0")"
needed=(rustc-web rust-web-src lld wasi-libc chromium)
command -v npm > /dev/null || needed+=(nodejs npm)
dpkg --status "${needed[@]}" > /dev/null 2>&1 || { apt-get --quiet update; apt-get --quiet install --yes --no-install-recommends "${needed[@]}"; }
./build.sh
npm test --silent
