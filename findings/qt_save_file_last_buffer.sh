#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Qt 6.4.2 (Debian 12, qt6-base-dev 6.4.2+dfsg-10).
#
# QSaveFile::commit() promises to keep the old file if a write failed. It decides that before it writes what is still in
# its buffer of 16 KiB: if only this last write fails, such as on a full disk, commit() returns true, error() says
# WriteError, and the old file has been replaced by the beginning of the new one. Call flush() and look at its result
# before commit(). The full disk is played by a limit of the process: files of at most 4096 bytes.
# Output seen:
#   commit: true, error: 2, the file: 4096 bytes of n
#   flush, commit: false, error: 2, the file: 6000 bytes of o
# Needs root rights, debootstrap and a mirror of Debian; takes some minutes. Fails if the behaviour is another one.
set -euo pipefail
version='6.4.2+dfsg-10'
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(ORIGIN) $(COMPONENT) $(SITE)' 'Created-By: Packages' |
  awk '$1 == "Debian" && $2 == "main" && !url { url = $3 } END { print url }')
debootstrap --variant=minbase bookworm "$folder" "$mirror" >/dev/null
cp --remove-destination /etc/resolv.conf "$folder/etc/resolv.conf"
chroot "$folder" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -qq --no-install-recommends g++ pkg-config "qt6-base-dev=$version" >/dev/null 2>&1

cat >"$folder/root/save.cpp" <<'CPP'
#include <sys/resource.h>

#include <QFile>
#include <QSaveFile>
#include <csignal>
#include <cstdio>

void writeOld() {
  QFile file("settings");
  if (file.open(QIODevice::WriteOnly)) file.write(QByteArray(6000, 'o'));
}

void saveNew(const char* what, bool flushes) {
  QSaveFile file("settings");
  if (!file.open(QIODevice::WriteOnly)) return;
  file.write(QByteArray(8000, 'n'));
  const bool done = (!flushes || file.flush()) && file.commit();
  const int error = file.error();
  QFile now("settings");
  if (!now.open(QIODevice::ReadOnly)) return;
  const QByteArray bytes = now.readAll();
  std::printf("%s: %s, error: %d, the file: %d bytes of %c\n", what, done ? "true" : "false", error,
              int(bytes.size()), bytes[0]);
}

int main() {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  for (const bool flushes : {false, true}) {
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_FSIZE, &limit);
    writeOld();
    limit.rlim_cur = 4096;
    setrlimit(RLIMIT_FSIZE, &limit);
    saveNew(flushes ? "flush, commit" : "commit", flushes);
  }
}
CPP
seen=$(chroot "$folder" env LC_ALL=C.UTF-8 sh -c '
  cd /root && g++ -fPIC save.cpp -o save $(pkg-config --cflags --libs Qt6Core) && ./save')
echo "$seen"
[ "$seen" = "commit: true, error: 2, the file: 4096 bytes of n
flush, commit: false, error: 2, the file: 6000 bytes of o" ] || { echo "The behaviour has changed." >&2; exit 1; }
