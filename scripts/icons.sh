#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws packaging/icons/*.png from packaging/pitchboard.svg; commit them. Needs librsvg2-bin, optipng.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../packaging"
for size in 16 22 24 32 48 64 128 256; do
  rsvg-convert -w $size -h $size pitchboard.svg -o icons/$size.png
  optipng -quiet -o5 -strip all icons/$size.png
done
