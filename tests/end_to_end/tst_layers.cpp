// SPDX-License-Identifier: GPL-3.0-or-later
// The plan of modules in ARCHITECTURE.md holds: what a file includes and what a target links stands
// below it. The build refuses headers of modules that a target does not link; this test also covers
// headers of packages, which stand in /usr/include for everybody, links that come by way of others,
// and the table itself.

#include <QDirIterator>
#include <QtTest>

#include "layer_rules.h"

using namespace layers;

namespace {

const QString source = QStringLiteral(PITCHBOARD_SOURCE_DIR "/");

QList<SourceFile> filesNamed(const QStringList& names) {
  QList<SourceFile> found;
  for (const char* library : {"simcore", "telemetry", "resources", "robotlink", "ui", "app"}) {
    QDirIterator files(source + library, names, QDir::Files, QDirIterator::Subdirectories);
    while (files.hasNext()) {
      QFile file(files.next());
      if (file.open(QIODevice::ReadOnly)) {
        found.append({file.fileName().mid(source.size()), QString::fromUtf8(file.readAll())});
      }
    }
  }
  return found;
}

const QList<SourceFile>& sources() {
  static const QList<SourceFile> files = filesNamed({"*.h", "*.cpp", "*.inc"});
  return files;
}

const QList<SourceFile>& cmakeFiles() {
  static const QList<SourceFile> files = filesNamed({"CMakeLists.txt"});
  return files;
}

// A made-up house: sky above earth, and a cellar that knows nobody.
const QList<Module>& house() {
  static const QList<Module> modules{
      {"ui/sky", {"ui/earth"}, {"Eigen/"}}, {"ui/earth", {}, {}}, {"ui/cellar", {}, {}}};
  return modules;
}

}  // namespace

class TestLayers : public QObject {
  Q_OBJECT
 private slots:
  void includesPointDown() {
    QVERIFY2(sources().size() > 300,
             "no sources found: the table would be checked against nothing");
    const QStringList wrong = includeErrors(sources(), table());
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join('\n')));
  }

  void roomsPointDown() {
    QStringList wrong = roomErrors(sources());
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join('\n')));
    wrong = roomErrors({{"robotlink/robot/models/src/a.cpp", "#include <robotlink/live/b.h>\n"},
                        {"robotlink/live/include/robotlink/live/b.h", ""}});
    QCOMPARE(wrong,
             QStringList{
                 "robotlink/robot/models/src/a.cpp uses robotlink/live, which is in a room above"});
  }

  void linksPointDown() {
    QVERIFY(cmakeFiles().size() > 30);
    const QStringList wrong = linkErrors(cmakeFiles(), table());
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join('\n')));
  }

  void packagesAreLinkedOnlyWhereTheyAreUsed() {
    const QStringList wrong = packageErrors(cmakeFiles(), sources());
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join('\n')));
  }

  void everyModuleOfTheTableIsBuilt() {
    QSet<QString> built;
    for (const SourceFile& cmake : cmakeFiles()) {
      for (const Links& links : linksOf(cmake)) built.insert(links.folder);
    }
    for (const Module& module : table()) {
      QVERIFY2(module.folder == "resources" || built.contains(module.folder),
               qPrintable(module.folder));
    }
  }

  // Without this a table could allow two modules to use each other.
  void theTableHasNoCircles() {
    QStringList settled;
    QList<Module> left = table();
    while (!left.isEmpty()) {
      const auto before = left.size();
      left.removeIf([&settled](const Module& module) {
        const bool ready =
            std::all_of(module.modules.begin(), module.modules.end(), [&](const QString& below) {
              return settled.contains(below) || below == module.folder;
            });
        if (ready) settled << module.folder;
        return ready;
      });
      QVERIFY2(left.size() < before, qPrintable("circle at " + left.value(0).folder));
    }
  }

  void plantedIncludesAreFound_data() {
    QTest::addColumn<QString>("path");
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("good");
    const QString sky = "ui/sky/src/bird.cpp", earth = "ui/earth/src/mole.cpp";
    QTest::newRow("downwards") << sky << "#include <ui/earth/tree.h>\n" << true;
    QTest::newRow("own module") << sky << "#include <ui/sky/wing.h>\n#include \"wing_bone.h\"\n"
                                << true;
    QTest::newRow("standard library") << sky << "#include <vector>\n#include <sys/stat.h>\n"
                                      << true;
    QTest::newRow("package of the module") << sky << "#include <Eigen/Core>\n" << true;
    QTest::newRow("upwards") << earth << "#include <ui/sky/wing.h>\n" << false;
    QTest::newRow("sideways") << earth << "  #  include <ui/cellar/rat.h>\n" << false;
    QTest::newRow("package of another module") << earth << "#include <Eigen/Core>\n" << false;
    QTest::newRow("package without folder") << earth << "#include <zlib.h>\n" << false;
    QTest::newRow("quoted, of another module") << earth << "#include \"wing_bone.h\"\n" << false;
    QTest::newRow("quoted, by its path") << sky << "#include \"ui/earth/tree.h\"\n" << false;
    QTest::newRow("quoted, over the fence") << sky << "#include \"../../earth/src/mole.h\"\n"
                                            << false;
    QTest::newRow("a folder nobody planned") << "ui/attic/src/dust.cpp"
                                             << "" << false;
  }
  void plantedIncludesAreFound() {
    QFETCH(QString, path);
    QFETCH(QString, text);
    QFETCH(bool, good);
    const QList<SourceFile> files{{path, text},
                                  {"ui/sky/include/ui/sky/wing.h", {}},
                                  {"ui/sky/src/wing_bone.h", {}},
                                  {"ui/earth/include/ui/earth/tree.h", {}},
                                  {"ui/earth/src/mole.h", {}}};
    QCOMPARE(includeErrors(files, house()).isEmpty(), good);
  }

  void plantedLinksAreFound_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("good");
    QTest::newRow("downwards") << "pitchboard_module(ui sky\n  SOURCES src/a.cpp\n"
                                  "  PUBLIC ui::earth Threads::Threads\n  PRIVATE Eigen3::Eigen)"
                               << true;
    QTest::newRow("upwards") << "pitchboard_module(ui earth SOURCES src/a.cpp PRIVATE ui::sky)"
                             << false;
    QTest::newRow("all modules") << "pitchboard_module(ui sky SOURCES src/a.cpp PUBLIC ui::all)"
                                 << false;
    QTest::newRow("package of another module")
        << "pitchboard_module(ui earth SOURCES src/a.cpp PRIVATE Eigen3::Eigen)" << false;
    QTest::newRow("unknown module") << "pitchboard_module(ui attic SOURCES src/a.cpp)" << false;
    QTest::newRow("unknown program")
        << "pitchboard_program(kite SOURCES a.cpp LIBS ui::sky)" << false;
  }
  void plantedLinksAreFound() {
    QFETCH(QString, text);
    QFETCH(bool, good);
    QCOMPARE(linkErrors({{"CMakeLists.txt", text}}, house()).isEmpty(), good);
  }

  void plantedPackagesAreFound() {
    const SourceFile uses{"ui/sky/src/bird.cpp", "#include <Eigen/Core>\n"};
    const SourceFile shows{"ui/sky/include/ui/sky/wing.h", "#include <Eigen/Core>\n"};
    const SourceFile hidden{"CMakeLists.txt", "pitchboard_module(ui sky PRIVATE Eigen3::Eigen)"};
    const SourceFile shown{"CMakeLists.txt", "pitchboard_module(ui sky PUBLIC Eigen3::Eigen)"};
    QVERIFY(packageErrors({hidden}, {uses}).isEmpty());
    QVERIFY(packageErrors({shown}, {shows}).isEmpty());
    QVERIFY(!packageErrors({hidden}, {}).isEmpty());
    QVERIFY(!packageErrors({shown}, {uses}).isEmpty());
  }

  // CONVENTIONS.md, Words on the screen.
  void noTextGoesThroughTranslation() {
    static const QRegularExpression translated(
        QStringLiteral("\\btr\\(|\\btranslate\\(\\s*\"|\\bQT_TR\\w*|\\bQ_DECLARE_TR\\w*"));
    QVERIFY(translated.match(QStringLiteral("label(QObject::tr(text))")).hasMatch());
    QVERIFY(
        !translated.match(QStringLiteral("painter.translate(x, y); str(1); attr(2)")).hasMatch());
    QStringList wrong;
    int seen = 0;
    for (const QString& folder : {QStringLiteral("ui"), QStringLiteral("app")}) {
      QDirIterator files(source + folder, {"*.h", "*.cpp"}, QDir::Files,
                         QDirIterator::Subdirectories);
      while (files.hasNext()) {
        QFile file(files.next());
        QVERIFY(file.open(QIODevice::ReadOnly));
        const auto match = translated.match(QString::fromUtf8(file.readAll()));
        if (match.hasMatch()) wrong << file.fileName() + QStringLiteral(": ") + match.captured();
        ++seen;
      }
    }
    QVERIFY(seen > 50);
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join("\n")));
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
