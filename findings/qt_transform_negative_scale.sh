#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Qt 6.4.2 (Debian 12, qt6-base-dev 6.4.2+dfsg-10).
#
# Nine numbers of a projection and the same numbers times -1 are the same projection. QTransform maps points and lines
# alike with both, but a polygon, a path and a rectangle become empty with the second: they are clipped where the third
# homogeneous coordinate is not positive. A homography that was solved for four points can have either sign; multiply it
# by -1 if the third coordinate of a point that is seen is negative.
# Output seen:
#   point 54.630 68.519 and 54.630 68.519
#   line 140.906 and 140.906
#   polygon of 4 and 1 points
#   path of 5 and 1 elements
#   rectangle 95.261 and 0.000 wide
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

cat >"$folder/root/projection.cpp" <<'CPP'
#include <QPainterPath>
#include <QPolygonF>
#include <QTransform>
#include <cstdio>

int main() {
  const QTransform plus(1, 0.2, 0.001, 0.1, 1, 0.0005, 3, 4, 1);
  const QTransform minus(-1, -0.2, -0.001, -0.1, -1, -0.0005, -3, -4, -1);
  const QPointF a = plus.map(QPointF(50, 60)), b = minus.map(QPointF(50, 60));
  std::printf("point %.3f %.3f and %.3f %.3f\n", a.x(), a.y(), b.x(), b.y());
  const QLineF line(0, 0, 100, 100);
  std::printf("line %.3f and %.3f\n", plus.map(line).length(), minus.map(line).length());
  const QRectF square(0, 0, 100, 100);
  const QPolygonF polygon(QList<QPointF>{{0, 0}, {100, 0}, {100, 100}, {0, 100}});
  std::printf("polygon of %d and %d points\n", int(plus.map(polygon).size()), int(minus.map(polygon).size()));
  QPainterPath path;
  path.addRect(square);
  std::printf("path of %d and %d elements\n", plus.map(path).elementCount(), minus.map(path).elementCount());
  std::printf("rectangle %.3f and %.3f wide\n", plus.mapRect(square).width(), minus.mapRect(square).width());
}
CPP
seen=$(chroot "$folder" env LC_ALL=C.UTF-8 sh -c '
  cd /root && g++ -fPIC projection.cpp -o projection $(pkg-config --cflags --libs Qt6Gui) && ./projection')
echo "$seen"
[ "$seen" = "point 54.630 68.519 and 54.630 68.519
line 140.906 and 140.906
polygon of 4 and 1 points
path of 5 and 1 elements
rectangle 95.261 and 0.000 wide" ] || { echo "The behaviour has changed." >&2; exit 1; }
