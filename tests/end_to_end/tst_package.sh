#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_package.sh BUILD SOURCE VERSION: makes the Debian package of a built tree, checks it with the
# tools of the distribution, unpacks it elsewhere and plays a match with what came out.
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

(cd "$build" && cpack --config CPackConfig.cmake -B "$folder") >"$folder/cpack.log" 2>&1 ||
  { cat "$folder/cpack.log"; exit 1; }
packages=("$folder"/pitchboard_*.deb)
package=${packages[0]}
field() { dpkg-deb -f "$package" "$1"; }
[ "$(field Version)" = "$version-1" ] || fail "the package has version $(field Version), not $version-1"
for needed in libqt6widgets6 libqt6charts6 libqt6svg6 libbox2d2 libmuparser2v5 libzstd1 breeze-icon-theme; do
  [[ ", $(field Depends)" == *", $needed"* ]] || fail "the package does not depend on $needed"
done
must "lintian" lintian --allow-root --fail-on error --tag-display-limit 0 "$package"

root=$folder/elsewhere
dpkg-deb -x "$package" "$root"
bin=$root/usr/bin share=$root/usr/share id=org.pitchboard.Pitchboard
for program in pitchboard pitchboard-cli pitchboard-robot; do
  [ "$("$bin/$program" --version)" = "$version" ] || fail "$program --version is not $version"
  [ -s "$share/man/man1/$program.1.gz" ] || fail "$program has no manual page"
  [ -s "$share/bash-completion/completions/$program" ] && [ -s "$share/zsh/vendor-completions/_$program" ] ||
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

# The programs run from where they stand, and the robots' processes are found beside them.
must "a recording" "$bin/pitchboard-cli" record --scenario one-robot --duration 2 -o "$folder/match.mcap"
type_is match.mcap application/x-pitchboard-session
type_is other.mcap application/x-mcap
type_is goal.pitchboard.json application/x-pitchboard-scenario+json
type_is other.json application/json
for type in application/x-pitchboard-session application/x-pitchboard-scenario+json; do
  grep -q "^MimeType=.*$type;" "$share/applications/$id.desktop" || fail "the desktop entry does not open $type"
done
played=$(cd / && env -i PATH=/usr/bin:/bin "$bin/pitchboard-cli" simulate --cognition separate --json \
  --scenario one-robot --duration 8 --key-base $((800000000 + $$ * 100)) 2>&1) || fail "the match:"$'\n'"$played"
[[ $played == *'"ticks":480'* ]] || fail "the match was not played to its end:"$'\n'"$played"
[[ $played =~ \"distance_m\":[0-9]*\.[0-9]*[1-9] ]] || fail "no robot walked, so none decided:"$'\n'"$played"
# The library is found by what it installs, and does what the program does.
pc=$(dirname "$(find "$root/usr" -name pitchboard_sim.pc)")
[ "$(PKG_CONFIG_PATH=$pc pkg-config --modversion pitchboard_sim)" = "$version" ] || fail "pkg-config does not know the library"
read -ra flags <<<"$(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs pitchboard_sim)"
must "a program in C" cc -std=c99 -o "$folder/user" "$source/tests/robotlink/capi_user.c" "${flags[@]}"
of_library=$(LD_LIBRARY_PATH=$(dirname "$pc") "$folder/user" one-robot 4 5) || fail "the program in C: $of_library"
of_program=$("$bin/pitchboard-cli" simulate --scenario one-robot --seed 4 --duration 5 --json)
[[ $of_program == *"\"$of_library\""* ]] || fail "the library played to $of_library, the program to $of_program"
shown=$(nm -D --defined-only "$(dirname "$pc")/libpitchboard_sim.so" | grep -v ' pb_\| A PITCHBOARD_SIM_')
[ -z "$shown" ] || fail "the library shows more than pb_*:"$'\n'"$shown"
must "the example for learning" env PITCHBOARD_SIM_LIBRARY="$(dirname "$pc")/libpitchboard_sim.so.1" \
  /usr/bin/python3 "$share/doc/pitchboard/docs/examples/pitchboard_env.py" --episodes 10
must "the studio" env -i PATH=/usr/bin:/bin QT_QPA_PLATFORM=offscreen HOME="$folder" "$bin/pitchboard" \
  --settings "$folder/settings.ini" --cognition inline --after 1 --screenshot-to "$folder/studio.png"
[ -s "$folder/studio.png" ] || fail "the studio made no picture"
exit $((failures > 0))
