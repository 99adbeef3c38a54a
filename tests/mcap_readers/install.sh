#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# install.sh FOLDER: puts the packages of package-lock.json into FOLDER, unless they are there already.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
folder=$1
mkdir -p "$folder"
if [ -d "$folder/node_modules" ] && cmp -s "$here/package-lock.json" "$folder/installed-lock.json"; then
  exit 0
fi
cp "$here/package.json" "$here/package-lock.json" "$here/.npmrc" "$folder/"
cd "$folder"
npm ci --ignore-scripts --prefer-offline --no-audit --no-fund
cp package-lock.json installed-lock.json
