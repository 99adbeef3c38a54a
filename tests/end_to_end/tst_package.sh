#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_package.sh BUILD SOURCE VERSION: makes the Debian packages of a built tree, checks them with the tools of the
# distribution, unpacks them elsewhere and does with what came out what the packages' own tests do.
# (scripts/other_system.sh --packages builds them as Debian does, and installs and removes them.)
set -uo pipefail
build=$1 source=$2 version=$3
unset DISPLAY WAYLAND_DISPLAY
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() {
  echo "FAIL: $*"
  failures=$((failures + 1))
}
# must WHAT COMMAND...: shows what the command said when it fails.
must() {
  local what=$1 said
  shift
  said=$("$@" 2>&1) || fail "$what:"$'\n'"$said"
}

# lintian is part of it. Packages that are missing would be asked for, and nobody answers here.
"$source/scripts/package.sh" --built "$build" --into "$folder" >"$folder/package.log" 2>&1 </dev/null ||
  { cat "$folder/package.log"; exit 1; }
all=(libpitchboard-dev libpitchboard1 pitchboard pitchboard-agent pitchboard-cli pitchboard-doc python3-pitchboard)
[ "$(cd "$folder" && ls -- *.deb | sed 's/_.*//' | LC_ALL=C sort | xargs)" = "${all[*]}" ] || fail "the packages are $(ls "$folder")"
declare -A files
for name in "${all[@]}"; do files[$name]=$(echo "$folder/${name}"_*.deb); done
field() { dpkg-deb -f "${files[$1]}" "$2"; }
holds() { dpkg-deb -c "${files[$1]}" | awk '{ print $6 }'; }
for name in "${all[@]}"; do
  [ "$(field "$name" Version)" = "$version-1" ] || fail "$name has version $(field "$name" Version), not $version-1"
  for document in copyright changelog.gz changelog.Debian.gz; do
    holds "$name" | grep -qx "./usr/share/doc/$name/$document" || fail "$name has no $document"
  done
done
for needed in libqt6widgets6 libqt6charts6 libqt6svg6 libbox2d2 libmuparser2v5 breeze-icon-theme "pitchboard-cli (= $version-1)"; do
  [[ ", $(field pitchboard Depends)" == *", $needed"* ]] || fail "pitchboard does not depend on $needed"
done
[[ $(field pitchboard-cli Depends) != *libqt* ]] || fail "pitchboard-cli needs Qt: $(field pitchboard-cli Depends)"
[ -z "$(field pitchboard-agent Depends)" ] || fail "pitchboard-agent depends on $(field pitchboard-agent Depends)"
[[ $(field python3-pitchboard Depends) == *"libpitchboard1 (>= $version)"*python3-numpy* ]] ||
  fail "python3-pitchboard depends on $(field python3-pitchboard Depends)"
multiarch=$(dpkg-architecture -qDEB_HOST_MULTIARCH)
for place in libpitchboard1:libpitchboard_sim.so.1 libpitchboard-dev:libpitchboard_sim.so libpitchboard-dev:pkgconfig/pitchboard_sim.pc \
  pitchboard-cli:pitchboard/libpitchboard_time.so; do
  holds "${place%%:*}" | grep -qx "./usr/lib/$multiarch/${place#*:}" || fail "${place%%:*} has no /usr/lib/$multiarch/${place#*:}"
done
holds pitchboard-agent | grep -q 'lib/systemd/system/pitchboard-agent@.service$' || fail "pitchboard-agent has no unit of systemd"
[ "$(dpkg-deb --ctrl-tarfile "${files[libpitchboard1]}" | tar -xO ./symbols | grep -c '^ pb_')" -gt 40 ] || fail "the library has no symbols file"
# What the packages need to be built is what ./run installs: both lists have the same libraries.
listed=$(sed -n '/^Build-Depends:/,/^$/p' "$source/packaging/debian/control" | grep -oE '[a-z0-9]+[a-z0-9.+-]*-dev\b' | sort -u)
[ "$(grep -E -- '-dev$' "$source/scripts/packages-run.txt" | sort)" = "$listed" ] ||
  fail "packaging/debian/control and scripts/packages-run.txt differ: $(diff <(echo "$listed") <(grep -E -- '-dev$' "$source/scripts/packages-run.txt" | sort))"

root=$folder/elsewhere
for name in "${all[@]}"; do dpkg-deb -x "${files[$name]}" "$root"; done
bin=$root/usr/bin share=$root/usr/share library=$root/usr/lib/$multiarch id=org.pitchboard.Pitchboard
for program in pitchboard pitchboard-cli pitchboard-robot pitchboard-agent; do
  [ "$("$bin/$program" --version)" = "$version" ] || fail "$program --version is not $version"
  [ -s "$share/man/man1/$program.1.gz" ] || fail "$program has no manual page"
  [ $program = pitchboard-agent ] ||
    { [ -s "$share/bash-completion/completions/$program" ] && [ -s "$share/zsh/vendor-completions/_$program" ]; } ||
    fail "$program has no completion"
done
[[ $(zcat "$share/man/man1/pitchboard-cli-simulate.1.gz") == *"Pitchboard $version"*save* ]] ||
  fail "the manual page of simulate is not made from its --help"
[[ $(zcat "$share/doc/pitchboard/changelog.Debian.gz") == "pitchboard ($version-1) "* ]] ||
  fail "the newest entry of the change log is not $version"
grep -q "<release version=\"$version\"" "$share/metainfo/$id.metainfo.xml" ||
  fail "the AppStream data do not know version $version"
must "the desktop entry" desktop-file-validate "$share/applications/$id.desktop"
must "the AppStream data" appstreamcli validate --no-net "$share/metainfo/$id.metainfo.xml"
icon=$(sed -n 's/^Icon=//p' "$share/applications/$id.desktop")
for size in 16x16 48x48 256x256; do
  [ -s "$share/icons/hicolor/$size/apps/$icon.png" ] || fail "there is no icon $size"
done

# Types of files, as a desktop finds them.
must "the file types" update-mime-database "$share/mime"
printf '{"version": 1}' >"$folder/goal.pitchboard.json"
printf '{"version": 1}' >"$folder/other.json"
printf '\x89MCAP0\r\n\x01\x0d\0\0\0\0\0\0\0\0\0\0\0\x05\0\0\0other' >"$folder/other.mcap"
type_is() {
  local type
  type=$(XDG_DATA_HOME=$folder/none XDG_DATA_DIRS=$share:/usr/share gio info -a standard::content-type "$folder/$1" |
    sed -n 's/.*content-type: //p')
  [ "$type" = "$2" ] || fail "$1 is $type, not $2"
}
must "a recording" "$bin/pitchboard-cli" record --scenario one-robot --duration 2 -o "$folder/match.mcap"
type_is match.mcap application/x-pitchboard-session
type_is other.mcap application/x-mcap
type_is goal.pitchboard.json application/x-pitchboard-scenario+json
type_is other.json application/json
for type in application/x-pitchboard-session application/x-pitchboard-scenario+json; do
  grep -q "^MimeType=.*$type;" "$share/applications/$id.desktop" || fail "the desktop entry does not open $type"
done

# The packages' own tests, with what stands elsewhere: programs, robots' processes, libraries and module find each other.
[ "$(PKG_CONFIG_PATH=$library/pkgconfig pkg-config --modversion pitchboard_sim)" = "$version" ] ||
  fail "pkg-config does not know the library"
[ -e "$root/usr/lib/python3/dist-packages/pitchboard/py.typed" ] || fail "the module for Python has no types"
shown=$(nm -D --defined-only "$library/libpitchboard_sim.so" | grep -v ' pb_\| A PITCHBOARD_SIM_')
[ -z "$shown" ] || fail "the library shows more than pb_*:"$'\n'"$shown"
own_test() {
  mkdir "$folder/$1"
  (cd "$source" && env -i PATH="$bin:/usr/bin:/bin" HOME="$folder" LC_ALL=C.UTF-8 AUTOPKGTEST_TMP="$folder/$1" \
    PYTHONPATH="$root/usr/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1 PKG_CONFIG_PATH="$library/pkgconfig" \
    LD_LIBRARY_PATH="$library" "$source/packaging/debian/tests/$1")
}
must "the packages' test of the main job" own_test main-job
must "the packages' test of the studio" own_test studio
exit $((failures > 0))
