#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# install.sh FOLDER [LOCKED]: puts the packages of LOCKED/package-lock.json (by default the one beside this
# script) into FOLDER, unless they are there already.
set -euo pipefail
folder=$1
locked=${2:-$(dirname "$(readlink -f "$0")")}
mkdir -p "$folder"
if [ -d "$folder/node_modules" ] && cmp -s "$locked/package-lock.json" "$folder/installed-lock.json"; then
  exit 0
fi
cp "$locked/package.json" "$locked/package-lock.json" "$locked/.npmrc" "$folder/"
cd "$folder"
npm ci --ignore-scripts --prefer-offline --no-audit --no-fund
cp package-lock.json installed-lock.json
