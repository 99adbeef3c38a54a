#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_packages.sh SOURCE: which packages scripts/common.sh would install, by a database of dpkg made here.
set -uo pipefail
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
cd "$folder" || exit 1
. "$source/scripts/common.sh"

mkdir database bin
export DPKG_ADMINDIR=$folder/database PATH=$folder/bin:$PATH
# package NAME STATUS [FIELD]
package() {
  printf 'Package: %s\nStatus: %s\nArchitecture: all\nMaintainer: N <n@example.org>\nVersion: 1.0\n%sDescription: x\n\n' \
    "$1" "$2" "${3:+$3$'\n'}" >>database/status
}
package qt6-base-dev 'install ok installed' 'Provides: libqt6opengl6-dev (= 6.8.2), qt6-base-abi'
package cmake 'install ok installed'
package removed 'deinstall ok config-files' 'Provides: of-removed'
package half 'install ok unpacked'
# apt-get and sudo only say what they were asked for.
printf '#!/bin/sh\necho "$@" >>%s/asked\n' "$folder" >bin/apt-get
printf '#!/bin/sh\nexec "$@"\n' >bin/sudo
chmod +x bin/apt-get bin/sudo

# wants "PACKAGE..." LINE...: with a list of these lines, those are installed.
wants() {
  local wanted=$1 asked
  shift
  printf '%s\n' "$@" >list.txt
  rm -f asked
  install_packages list.txt 2>/dev/null
  asked=$(sed -n 's/^install .*--no-install-recommends //p' asked 2>/dev/null)
  [ "$asked" = "$wanted" ] && return
  echo "FAIL: for \"$*\" it installs \"$asked\", not \"$wanted\""
  failures=$((failures + 1))
}
wants "" cmake
wants "" cmake libqt6opengl6-dev qt6-base-abi   # provided, with a version and without
wants "absent" cmake "" absent
wants "removed of-removed half" removed of-removed half
wants "make qt6-base" make qt6-base               # parts of a name
wants "absent" "absent no-such-command" "other-packaging sh"

[ $failures -eq 0 ]
