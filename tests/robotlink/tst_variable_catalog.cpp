// SPDX-License-Identifier: GPL-3.0-or-later
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QtTest>
#include <random>

#include <base/file_target.h>
#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/blackboard/variable_meanings.h>
#include <simcore/world/action_codes.h>

namespace tst_variable_catalog {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

Result<VariableCatalog> read(const QString& format, const std::string& text) {
  if (format == "h") return VariableCatalog::fromHeader(text, "f");
  if (format == "py") return VariableCatalog::fromPython(text, "f");
  return VariableCatalog::fromJson(text, "f");
}

std::string fileText(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll().toStdString() : std::string();
}

// "i13 A, f4 B" in order of the catalog.
QString summary(const VariableCatalog& catalog) {
  QStringList items;
  for (const Variable& v : catalog.variables())
    items << QString("%1%2 %3")
                 .arg(v.type == VariableType::Int ? "i" : "f")
                 .arg(v.index)
                 .arg(QString::fromStdString(v.name));
  return items.join(", ");
}

// "VISION_OPP01_DIST" as text and number: {"VISION_OPP#_DIST", 1}; number -1 if there is none.
std::pair<QString, int> numberedName(const QString& name) {
  static const QRegularExpression number(QStringLiteral("\\d+"));
  const auto found = number.match(name);
  if (!found.hasMatch()) return {name, -1};
  return {QString(name).replace(found.capturedStart(), found.capturedLength(), "#"),
          found.captured().toInt()};
}

QString unitOrCodes(const telemetry::ColumnInfo& column) {
  if (column.kind == telemetry::ColumnKind::Flag) return "0 or 1";
  if (column.labels == actionLabels()) return "[actions](#actions)";
  QStringList codes;
  for (const auto& [code, text] : column.labels)
    codes << QString("%1 %2").arg(code).arg(QString::fromStdString(text));
  return codes.isEmpty() ? QString::fromStdString(column.unit) : codes.join(", ");
}

// "decision; planning while DECISION_TARGET"
QString writersOf(const std::string& name) {
  const VariableWriters writers = VariableMeanings::published().writers(name);
  QString text = QString::fromStdString(writers.writer);
  if (!writers.alsoBy.empty()) {
    text += "; " + QString::fromStdString(writers.alsoBy) + " while " +
            QString::fromStdString(writers.alsoWhile);
  }
  if (!writers.clearedBy.empty()) {
    text += "; cleared by " + QString::fromStdString(writers.clearedBy);
  }
  return text;
}

// A row for each variable; those that are numbered through share one.
QString variablesTable(const VariableCatalog& catalog) {
  const VariableMeanings& meanings = VariableMeanings::published();
  struct Row {
    QString first, last, type, writer, unit, text;
    int from, to, step;
  };
  std::vector<Row> rows;
  for (const Variable& v : catalog.variables()) {
    telemetry::ColumnInfo column;
    column.name = v.name;
    meanings.describe(column);
    const QString name = QString::fromStdString(v.name), unit = unitOrCodes(column);
    const std::string_view reported = meanings.description(v.name);
    const QString text = QString::fromUtf8(reported.data(), qsizetype(reported.size()));
    const QString type = v.type == VariableType::Int ? "int" : "float";
    const QString writer = writersOf(v.name);
    const auto [skeleton, number] = numberedName(name);
    // Named once more for clang before version 16: it captures no names of a structured binding.
    const auto series =
        std::ranges::find_if(rows, [&, skeleton = skeleton, number = number](const Row& row) {
          const auto [otherSkeleton, otherNumber] = numberedName(row.last);
          return number > 0 && row.type == type && otherSkeleton == skeleton &&
                 otherNumber + 1 == number && row.unit == unit && row.text == text &&
                 row.writer == writer && (row.step == 0 || row.to + row.step == v.index);
        });
    if (series == rows.end()) {
      rows.push_back({name, name, type, writer, unit, text, v.index, v.index, 0});
    } else {
      series->step = v.index - series->to;
      series->last = name;
      series->to = v.index;
    }
  }
  QString table =
      "| variable | type | index | written by | unit or codes | meaning |\n"
      "|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    QString names = "`" + row.first + "`", places = QString::number(row.from);
    if (row.first != row.last) {
      names += " to `" + row.last + "`";
      places += QString(" to %1").arg(row.to);
      if (row.step > 1) places += QString(", every %1").arg(row.step == 2 ? "2nd" : "other");
    }
    table += QString("| %1 | %2 | %3 | %4 | %5 | %6 |\n")
                 .arg(names, row.type, places, row.writer, row.unit, row.text);
  }
  return table;
}

QString extensionTable() {
  const VariableCatalog& extended = VariableCatalog::extended();
  QStringList ints, floats;
  for (const Variable& v : extended.variables()) {
    if (VariableCatalog::published().find(v.name)) continue;
    (v.type == VariableType::Int ? ints : floats)
        << QString("\"%1\": %2").arg(QString::fromStdString(v.name)).arg(v.index);
  }
  const auto only = VariableCatalog::fromJson(QString("{\"int\": {%1}, \"float\": {%2}}")
                                                  .arg(ints.join(", "), floats.join(", "))
                                                  .toStdString(),
                                              "extension");
  return only ? variablesTable(*only) : QString();
}

QString actionsTable() {
  QString text = "| code | action |\n|---|---|\n";
  for (const ActionInfo& action : knownActions) {
    text += QString("| %1 | %2 |\n")
                .arg(action.code)
                .arg(QString::fromUtf8(action.label.data(), qsizetype(action.label.size())));
  }
  return text;
}

}  // namespace

class TestVariableCatalog : public QObject {
  Q_OBJECT

 private slots:
  void published() {
    const VariableCatalog& catalog = VariableCatalog::published();
    QCOMPARE(catalog.variables().size(), std::size_t(205));
    QCOMPARE(catalog.intVar("DECISION_ACTION_A")->index, 17);
    QCOMPARE(catalog.floatVar("VISION_BALL_DIST")->index, 17);
    QVERIFY(!catalog.intVar("VISION_BALL_DIST"));
    QVERIFY(!catalog.find("NO_SUCH"));
    const std::string file = fileText(PITCHBOARD_SOURCE_DIR "/resources/blackboard.json");
    QCOMPARE(QByteArray::fromStdString(catalog.toJson()).trimmed(),
             QByteArray::fromStdString(file).trimmed());
    QVERIFY(*VariableCatalog::fromJson(catalog.toJson(), "again") == catalog);
  }
  // A map for a larger segment (docs/live.md) keeps its layout when it is written again.
  void aLayoutIsKept() {
    const QTemporaryDir folder;
    const std::string path = folder.filePath("large.json").toStdString();
    const SegmentLayout large{4096, 600};
    QVERIFY(writeFile(path, VariableCatalog::published().toJson(large), IfExists::Refuse));
    SegmentLayout read;
    const auto catalog = VariableCatalog::fromFile(path, read);
    QVERIFY2(catalog, catalog ? "" : catalog.error().text().c_str());
    QVERIFY(*catalog == VariableCatalog::published());
    QCOMPARE(read.bytes, large.bytes);
    QCOMPARE(read.floatOffset, large.floatOffset);
    QVERIFY(!VariableCatalog::fromFile(path));  // it cannot be shared with a robot's processes
  }

  void teamsFiles_data() {
    QTest::addColumn<QString>("file");
    for (const char* file : {"numbers.h", "pointers.h", "SharedMemory.py"})
      QTest::newRow(file) << file;
  }
  void teamsFiles() {
    QFETCH(QString, file);
    const auto catalog = VariableCatalog::fromFile(
        (QStringLiteral(PITCHBOARD_TEST_DATA "/catalogs/") + file).toStdString());
    QVERIFY2(catalog, catalog ? "" : catalog.error().text().c_str());
    QCOMPARE(summary(*catalog), summary(VariableCatalog::published()));
  }

  void accepts_data() {
    QTest::addColumn<QString>("format");
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char* name, const char* format, const char* text,
                        const char* expected) {
      QTest::newRow(name) << QString(format) << QByteArray(text) << QString(expected);
    };
    row("pointer forms", "h",
        "#define A *(mem)\n#define B (*( mem + 3 ))\n# define C *(memf+0x4) // deg\n#define D "
        "*memf\n",
        "i0 A, i3 B, f0 D, f4 C");
    row("ints out of order", "h",
        "#define A 14\n#define B 13\n#define C 20\n#define X 13\n#define Y 15\n",
        "i13 B, i14 A, i20 C, f13 X, f15 Y");
    row("section comment", "h",
        "#define A 1\n//---- Float variables ----\n#define X 20\n#define Y 21\n",
        "i1 A, f20 X, f21 Y");
    row("comment behind", "h", "#define A 1 /* int */\n#define X 2 // float, deg\n", "i1 A, f2 X");
    row("other macros", "h",
        "#ifndef B_H\n#define B_H\n#define KEY 10345678\n#define F(x) 3\n#define S \"a // b\"\n"
        "#define P 3.5f\n#define N -1\n#define A 5\n#if 0\n#define A 6\n#endif\n#endif\n",
        "i5 A");
    row("crlf, continued, commented out", "h",
        "\xef\xbb\xbf#define A \\\r\n 7\r\n/* #define B 8\r\n*/ #define C 9\r\n//#define D 1\r\n",
        "i7 A, i9 C");
    row("latin-1 comment", "h", "// fun\xe7\xe3o\n#define A 7\n", "i7 A");
    row("python", "py",
        "self.variable_int = {u'A' : 13, # c\n\n \"B\": 14,}\nx = variable_float == {}\n"
        "variable_float={'X':0}\n",
        "i13 A, i14 B, f0 X");
    row("json", "json", R"({"float": {"X": 386}, "int": {"A": 124}})", "i124 A, f386 X");
  }
  void accepts() {
    QFETCH(QString, format);
    QFETCH(QByteArray, text);
    const auto catalog = read(format, text.toStdString());
    QVERIFY2(catalog, catalog ? "" : catalog.error().text().c_str());
    QTEST(summary(*catalog), "expected");
  }

  void refuses_data() {
    QTest::addColumn<QString>("format");
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("start");
    QTest::addColumn<QString>("contains");
    const auto row = [](const char* name, const char* format, const QByteArray& text,
                        const char* start, const char* contains) {
      QTest::newRow(name) << QString(format) << text << QString(start) << QString(contains);
    };
    for (const char* format : {"h", "py", "json"}) {
      row(qPrintable(QString("empty ") + format), format, " \n", "f: ", "empty");
      row(qPrintable(QString("nul ") + format), format, QByteArray("a\n\0b", 4), "f:2: ", "byte 0");
      row(qPrintable(QString("large ") + format), format, QByteArray(1024 * 1024 + 1, ' '),
          "f: ", "1 MiB");
    }
    row("h nothing", "h", "int a;\n", "f: ", "no variable");
    row("h range", "h", "\n#define A 512\n", "f:2: ", "0 to 511");
    row("h float range", "h", "#define A *(memf+387)\n", "f:1: ", "0 to 386");
    row("h huge", "h", "#define A 99999999999999999999\n", "f:1: ", "huge");
    row("h same name", "h", "#define A 1\n#define B 2\n#define A 3\n", "f:3: ", "first in f:1");
    row("h same index", "h", "#define A 5\n#define B 5\n#define C 6\n",
        "f:2: ", "\"B\" and \"A\" (f:1) are both int 5");
    row("h overlap", "h", "#define A *(mem+130)\n#define B *(memf+5)\n",
        "f:2: ", "lies on \"A\" (int 130, f:1)");
    row("h computed", "h", "#define A *(mem+N+1)\n", "f:1: ", "computed");
    row("h sum", "h", "#define A 3+1\n", "f:1: ", "computed");
    row("h broken", "h", "#define A 13x\n", "f:1: ", "is not a number");
    row("h name", "h", "#define 1A 13\n", "f:1: ", "\"1A\"");
    row("h ambiguous", "h", "#define A 9\n#define B 10\n\n#define C 1\n", "f:4: ", "// float");
    row("h open comment", "h", "#define A 1\n/* ...\n", "f:2: ", "never closed");
    row("py none", "py", "print 1\n", "f: ", "no dictionary");
    row("py computed", "py", "variable_int = {\n 'A': 1,\n 'B': BASE + 1 }\n",
        "f:3: ", "\"B\" must be a whole number");
    row("py sum", "py", "variable_int = {\n 'A': 1 + 2}\n", "f:2: ", "computed");
    row("py call", "py", "\nvariable_int = dict(A=1)\n", "f:2: ", "written out");
    row("py item", "py", "variable_int = {'A': 1}\nvariable_int['B'] = 2\n", "f:2: ", "changed");
    row("py open", "py", "x=1\nvariable_int = {'A': 1,\n", "f:2: ", "never closed");
    row("py comma", "py", "variable_int = {'A': 1\n'B': 2}\n", "f:2: ", "comma");
    row("py negative", "py", "variable_int = {'A': -1}\n", "f:1: ", "whole number");
    row("py twice", "py", "variable_int = {'A': 1}\nvariable_int = {'A': 1}\n", "f:2: ", "second");
    row("py quote", "py", "variable_int = {'A: 1\n}\n", "f:1: ", "closing quote");
    row("py name", "py", "variable_int = {\n'A B': 1}\n", "f:2: ", "\"A B\"");
    row("json syntax", "json", "{\n\"int\": {,}}", "f:2: ", "not valid JSON");
    row("json list", "json", "[]", "f:1: ", "object");
    row("json key", "json", R"({"ints": {}})", "f:1: ints: ", "did you mean \"int\"");
    row("json segment", "json", R"({"segment": {"bytes": 1024}})", "f:1: segment.bytes: ", "2048");
    row("json value", "json", R"({"int": {"A": 1.5}})", "f:1: int.A: ", "whole number");
    row("json negative", "json", R"({"int": {"A": -1}})", "f:1: int.A: ", "0 to 511");
    row("json twice", "json", R"({"int": {"A": 1, "A": 2}})", "f:1: int.A: ", "twice");
    row("json both", "json", R"({"int": {"A": 1}, "float": {"A": 2}})", "f:1: float.A: ", "twice");
  }
  void refuses() {
    QFETCH(QString, format);
    QFETCH(QByteArray, text);
    QFETCH(QString, start);
    QFETCH(QString, contains);
    const auto catalog = read(format, text.toStdString());
    QVERIFY(!catalog);
    const QString message = QString::fromStdString(catalog.error().text());
    QVERIFY2(message.startsWith(start) && message.contains(contains), qPrintable(message));
  }

  void everyVariableIsDescribed() {
    for (const Variable& v : VariableCatalog::extended().variables())
      QVERIFY2(!VariableMeanings::published().description(v.name).empty(), v.name.c_str());
  }

  // PITCHBOARD_WRITE_DOCS=1 puts the tables into the document instead.
  void theDocumentHasEveryVariableAndCode() {
    QFile file(QStringLiteral(PITCHBOARD_SOURCE_DIR "/docs/blackboard.md"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(file.readAll());
    file.close();
    QString right = text;
    for (const auto& [name, table] :
         {std::pair<QString, QString>{"variables", variablesTable(VariableCatalog::published())},
          {"extension", extensionTable()},
          {"actions", actionsTable()}}) {
      const QString mark = "<!-- " + name + " -->\n";
      const auto begin = right.indexOf(mark);
      QVERIFY2(begin >= 0, qPrintable(name));
      const auto end = right.indexOf("<!-- end -->", begin);
      QVERIFY2(end >= 0, qPrintable(name));
      right.replace(begin, end - begin, mark + table);
    }
    if (qEnvironmentVariableIsSet("PITCHBOARD_WRITE_DOCS")) {
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(right.toUtf8());
      return;
    }
    QVERIFY2(text == right, "run PITCHBOARD_WRITE_DOCS=1 tst_variable_catalog");
  }

  void mutatedFilesNeverCrash() {
    const std::pair<QString, QString> files[] = {
        {"h", PITCHBOARD_TEST_DATA "/catalogs/numbers.h"},
        {"h", PITCHBOARD_TEST_DATA "/catalogs/pointers.h"},
        {"py", PITCHBOARD_TEST_DATA "/catalogs/SharedMemory.py"},
        {"json", PITCHBOARD_SOURCE_DIR "/resources/blackboard.json"}};
    std::mt19937 random(1);
    int refused = 0;
    for (const auto& [format, path] : files) {
      const std::string good = fileText(path).substr(0, 1500);
      for (int i = 0; i < 5000; ++i) {
        std::string text = good;
        for (auto n = random() % 6; n-- > 0;) {
          const std::size_t at = random() % text.size();
          switch (random() % 4) {
            case 0:
              text[at] = static_cast<char>(random());
              break;
            case 1:
              text.erase(at, 1 + random() % 40);
              break;
            case 2:
              text.insert(at, text.substr(random() % text.size(), random() % 40));
              break;
            default:
              text[at] = "\"'{}()*/#\\\n:,0"[random() % 14];
              break;
          }
          if (text.empty()) text = " ";
        }
        const auto catalog = read(format, text);
        if (!catalog) {
          ++refused;
          QVERIFY(!catalog.error().message.empty() && !catalog.error().context.empty());
        }
      }
    }
    QVERIFY(refused > 1000);
  }
};

PITCHBOARD_TEST(TestVariableCatalog)

}  // namespace tst_variable_catalog

#include "tst_variable_catalog.moc"
