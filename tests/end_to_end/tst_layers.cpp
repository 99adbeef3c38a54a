// SPDX-License-Identifier: GPL-3.0-or-later
// The include rule of ARCHITECTURE.md: a library may include only what stands below it. The build
// refuses our own headers that a target does not link; this test also covers headers of packages,
// which stand in /usr/include for everybody, and layers that happen to link more than they may use.

#include <QDirIterator>
#include <QRegularExpression>
#include <QtTest>

namespace {

struct Layer {
  const char* folder;
  QStringList ownHeaders;      ///< prefixes of our headers that it may include
  QStringList packageHeaders;  ///< prefixes of package headers, besides the standard library
};

const QString source = QStringLiteral(PITCHBOARD_SOURCE_DIR "/");

/// Standard library and POSIX headers have no folder, or one of these.
const QStringList systemFolders{"sys/", "linux/", "netinet/", "arpa/", "net/"};

const QList<Layer>& layers() {
  static const QList<Layer> all{
      {"simcore/base", {"base/"}, {"Random123/", "tl/"}},
      {"simcore", {"base/", "simcore/"}, {"Eigen/", "box2d/", "tl/", "Random123/"}},
      // Profiles of the text protocol are JSON files, and the published one is a resource.
      {"telemetry",
       {"base/", "telemetry/", "resources/"},
       {"nlohmann/", "tl/", "zlib.h", "zstd.h"}},
      {"resources", {"resources/"}, {}},
      {"robotlink",
       {"base/", "simcore/", "telemetry/", "robotlink/", "resources/"},
       {"Eigen/", "nlohmann/", "tl/", "zlib.h"}},
      {"ui",
       {"base/", "simcore/", "telemetry/", "robotlink/", "resources/", "ui/"},
       {"Q", "Qt", "tl/", "nlohmann/", "muParser.h"}},
      {"app/cli",
       {"app/", "base/", "simcore/", "telemetry/", "robotlink/", "resources/"},
       {"CLI/", "nlohmann/", "tl/"}},
      {"app/shared", {"app/", "base/", "robotlink/"}, {"CLI/", "tl/"}},
      {"app/robot", {"app/", "base/", "robotlink/"}, {"CLI/", "tl/"}},
      {"app/studio",
       {"app/", "base/", "simcore/", "robotlink/", "ui/"},
       {"Q", "Qt", "CLI/", "tl/"}},
  };
  return all;
}

bool startsWithOne(const QString& text, const QStringList& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&text](const QString& prefix) { return text.startsWith(prefix); });
}

/// Plain names such as <vector> or <unistd.h>: no folder, no upper case, and not a package's.
bool isSystemHeader(const QString& header) {
  static const QRegularExpression plain(QStringLiteral("^[a-z_0-9]+(\\.h)?$"));
  static const QStringList packages{"zlib.h", "zstd.h"};
  return (plain.match(header).hasMatch() && !packages.contains(header)) ||
         startsWithOne(header, systemFolders);
}

struct Include {
  QString file;
  int line;
  QString header;
};

QList<Include> includesBelow(const QString& folder) {
  static const QRegularExpression include(QStringLiteral("^\\s*#\\s*include\\s*<([^>]+)>"));
  QList<Include> found;
  QDirIterator files(source + folder, {"*.h", "*.cpp"}, QDir::Files, QDirIterator::Subdirectories);
  while (files.hasNext()) {
    const QString path = files.next();
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) continue;
    int number = 0;
    while (!file.atEnd()) {
      ++number;
      const auto match = include.match(QString::fromUtf8(file.readLine()));
      if (match.hasMatch()) found.append({path.mid(source.size()), number, match.captured(1)});
    }
  }
  return found;
}

}  // namespace

class TestLayers : public QObject {
  Q_OBJECT
 private slots:
  void includesPointDown_data() {
    QTest::addColumn<int>("layer");
    for (int i = 0; i < layers().size(); ++i) QTest::newRow(layers()[i].folder) << i;
  }
  void includesPointDown() {
    QFETCH(int, layer);
    const Layer& rule = layers()[layer];
    const QList<Include> includes = includesBelow(QString::fromLatin1(rule.folder));
    QVERIFY2(!includes.isEmpty(), "no sources found: the rule would be checked against nothing");
    QStringList wrong;
    for (const Include& include : includes) {
      // The base folder has a rule of its own.
      if (QLatin1String(rule.folder) == QLatin1String("simcore") &&
          include.file.startsWith("simcore/base/")) {
        continue;
      }
      if (isSystemHeader(include.header) || startsWithOne(include.header, rule.ownHeaders) ||
          startsWithOne(include.header, rule.packageHeaders)) {
        continue;
      }
      wrong << QStringLiteral("%1:%2 includes <%3>")
                   .arg(include.file)
                   .arg(include.line)
                   .arg(include.header);
    }
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join("\n")));
  }

  void publicHeadersHideBox2D() {
    for (const Include& include : includesBelow(QStringLiteral("simcore/include"))) {
      QVERIFY2(!include.header.startsWith("box2d"), qPrintable(include.file));
    }
  }

  void everySourceFileNamesItsLicence() {
    const QStringList folders{"simcore", "telemetry", "robotlink", "ui", "app", "tests"};
    int seen = 0;
    for (const QString& folder : folders) {
      QDirIterator files(source + folder, {"*.h", "*.cpp"}, QDir::Files,
                         QDirIterator::Subdirectories);
      while (files.hasNext()) {
        QFile file(files.next());
        if (file.fileName().contains("/tests/data/")) continue;
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY2(file.readLine().startsWith("// SPDX-License-Identifier: GPL-3.0-or-later"),
                 qPrintable(file.fileName()));
        ++seen;
      }
    }
    QVERIFY(seen > 50);
  }
};

QTEST_GUILESS_MAIN(TestLayers)
#include "tst_layers.moc"
