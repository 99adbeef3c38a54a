#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Qt 6.8.2 (Debian 13, qt6-base-dev), platform plugin "offscreen".
#
# A QMenu closes at a click of QTest::mouseClick() without triggering its entry, if the application has not had any
# pointer event before. After QCursor::setPos() and processEvents() the same click triggers the entry. With Qt 6.4.2
# (Debian 12) both do. Real mice move before they click, so that only tests see it.
# Output seen:
#   Qt 6.8.2, no pointer event before: triggered 0, visible 0
#   Qt 6.8.2, pointer moved before: triggered 1, visible 0
# Needs root rights, debootstrap and a mirror of Debian; takes some minutes. Fails if the behaviour is another one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mirror=$(apt-get indextargets --format '$(ORIGIN) $(COMPONENT) $(SITE)' 'Created-By: Packages' |
  awk '$1 == "Debian" && $2 == "main" && !url { url = $3 } END { print url }')
debootstrap --variant=minbase trixie "$folder" "$mirror" >/dev/null
cp --remove-destination /etc/resolv.conf "$folder/etc/resolv.conf"
chroot "$folder" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -qq --no-install-recommends g++ pkg-config qt6-base-dev >/dev/null 2>&1

cat >"$folder/root/menu.cpp" <<'CPP'
#include <QApplication>
#include <QCursor>
#include <QMenu>
#include <QtTest>
#include <cstdio>

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  const bool moves = argc > 1;
  if (moves) {
    QCursor::setPos(1, 1);
    QCoreApplication::processEvents();
  }
  QMenu menu;
  bool triggered = false;
  QAction* entry = menu.addAction("an entry");
  QObject::connect(entry, &QAction::triggered, [&] { triggered = true; });
  menu.popup(QPoint(100, 100));
  if (!QTest::qWaitForWindowExposed(&menu)) return 2;
  QTest::mouseClick(&menu, Qt::LeftButton, {}, menu.actionGeometry(entry).center());
  QCoreApplication::processEvents();
  std::printf("Qt %s, %s: triggered %d, visible %d\n", qVersion(),
              moves ? "pointer moved before" : "no pointer event before", triggered, menu.isVisible());
}
CPP
seen=$(chroot "$folder" env LC_ALL=C.UTF-8 QT_QPA_PLATFORM=offscreen sh -c '
  cd /root && g++ -fPIC menu.cpp -o menu $(pkg-config --cflags --libs Qt6Widgets Qt6Test) && ./menu && ./menu moves' 2>/dev/null)
echo "$seen"
[ "$seen" = "Qt 6.8.2, no pointer event before: triggered 0, visible 0
Qt 6.8.2, pointer moved before: triggered 1, visible 0" ] || { echo "The behaviour has changed." >&2; exit 1; }
