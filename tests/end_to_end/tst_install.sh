#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tst_install.sh SOURCE BIN: ./install brings programs that work, and --remove takes away exactly that.
set -uo pipefail
source=$1
export PITCHBOARD_BIN=$2  # nothing is built
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() {
  echo "FAIL: $*"
  failures=$((failures + 1))
}
# refused "WORDS" ARGUMENT...: ./install ends with 2 and says this.
refused() {
  local words=$1 said code=0
  shift
  said=$("$source/install" "$@" 2>&1) || code=$?
  [ $code -eq 2 ] && [[ $said == *"error: "*"$words"* ]] || fail "./install $* ended with $code: $said"
}
# What is below a folder, with contents.
all_of() { (cd "$1" && find . -mindepth 1 -printf '%y %m %p\n' | sort && find . -type f -print0 | sort -z | xargs -0r sha256sum); }

refused "--prefix needs a folder" --prefix
refused "--prefix needs a folder" --prefix=
refused "--prefix needs a folder" --prefix --remove
refused 'no option "--perfix"' --perfix /tmp
refused "nothing is installed below $folder/empty" --remove --prefix "$folder/empty"
touch "$folder/file"
refused "you may not write to $folder/file/deep" --prefix "$folder/file/deep"

# A folder in which others have put something, beside ours and in folders that we need.
prefix="$folder/a prefix"
mkdir -p "$prefix/bin" "$prefix/share/man/man1" "$prefix/share/empty"
echo other >"$prefix/bin/other"
echo other >"$prefix/share/man/man1/other.1"
before=$(all_of "$prefix")
(cd "$folder" && "$source/install" --prefix "a prefix" >log 2>&1) || fail "./install: $(cat "$folder/log")"
for program in pitchboard pitchboard-cli pitchboard-robot pitchboard-agent; do
  "$prefix/bin/$program" --version >/dev/null || fail "$program was not installed"
done
ticks=$(env -i PATH=/usr/bin:/bin "$prefix/bin/pitchboard-cli" simulate --cognition separate --json --scenario one-robot \
  --duration 2 --key-base $((800000000 + $$ % 100000 * 100)))
[[ $ticks == *'"ticks":120'* ]] || fail "what was installed plays no match: $ticks"

# Again, over files of an earlier version.
list=$prefix/share/pitchboard/installed.txt
mkdir -p "$prefix/share/pitchboard/old"
touch "$prefix/share/pitchboard/old/file" "$prefix/bin/pitchboard-old"
printf '%s\n' share/pitchboard/old/ share/pitchboard/old/file bin/pitchboard-old >>"$list"
(cd "$folder" && "$source/install" --prefix "$prefix" >log 2>&1) || fail "./install again: $(cat "$folder/log")"
[ ! -e "$prefix/bin/pitchboard-old" ] && [ ! -e "$prefix/share/pitchboard/old" ] || fail "files of the earlier version stayed"
(cd "$prefix" && while IFS= read -r file; do [ -e "$file" ] || [ -L "$file" ] || echo "$file"; done <"$list") >"$folder/missing"
[ ! -s "$folder/missing" ] || fail "the list has what is not there: $(cat "$folder/missing")"

"$source/install" --remove --prefix "$prefix" >"$folder/log" 2>&1 || fail "./install --remove: $(cat "$folder/log")"
[ "$(all_of "$prefix")" = "$before" ] || fail "after --remove it is another folder: $(diff <(echo "$before") <(all_of "$prefix"))"

# A list that would lead out of the folder removes nothing there.
mkdir -p "$prefix/share/pitchboard"
printf 'bin/other\n../file\n' >"$list"
"$source/install" --remove --prefix "$prefix" >"$folder/log" 2>&1 && fail "a damaged list was taken"
[ -e "$folder/file" ] || fail "a file outside of the prefix was removed"
exit $((failures > 0))
