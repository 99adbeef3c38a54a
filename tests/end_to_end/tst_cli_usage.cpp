// SPDX-License-Identifier: GPL-3.0-or-later
// What programs say about their command line: help, errors, completion.
#include <QFile>
#include <QMap>
#include <QProcess>
#include <QRegularExpression>

#include "../support/program_run.h"

namespace tst_cli_usage {

namespace {

QByteArray helpOf(const char* program, QStringList words, const char* option = "--help") {
  const ProgramRun run = runProgram(program, words << option);
  return run.exitCode == 0 ? run.out : QByteArray();
}

/// Returns the commands that a help page lists.
QStringList commandsIn(const QByteArray& help) {
  QStringList names;
  const QString list = QString::fromUtf8(help)
                           .section(QStringLiteral("\nCommands:\n"), 1)
                           .section(QStringLiteral("\n\n"), 0, 0);
  for (const QString& line : list.split('\n')) {
    const QString name = line.section(' ', 2, 2);
    if (!name.isEmpty()) names << name;
  }
  return names;
}

/// The options of a help page with what it says of them, without their defaults.
QMap<QString, QString> optionsIn(const QByteArray& help) {
  static const QRegularExpression usual(QStringLiteral(" \\[[^\\]]*\\]$"));
  QMap<QString, QString> options;
  QString name;
  for (const QString& line : QString::fromUtf8(help).split('\n')) {
    if (line.startsWith(QStringLiteral("  --"))) {
      name = line.section(' ', 2, 2);
      options[name] = line.simplified();
    } else if (!name.isEmpty() && line.startsWith(QString(20, QLatin1Char(' ')))) {
      options[name] += QLatin1Char(' ') + line.simplified();
    } else {
      name.clear();
    }
  }
  for (QString& text : options) text.remove(usual);
  return options;
}

}  // namespace

class TestCliUsage : public QObject {
  Q_OBJECT

 private slots:
  void mistakesAreNamed_data() {
    QTest::addColumn<QString>("line");
    QTest::addColumn<QString>("error");
    const auto row = [](const char* line, const char* error) {
      QTest::newRow(line) << QString(line) << QString(error);
    };
    row("", "a command is missing");
    row("simulat", "there is no command \"simulat\"; did you mean \"simulate\"?");
    row("blackboard dmp", "there is no command \"dmp\"; did you mean \"dump\"?");
    row("simulate --sceario match", "unknown option \"--sceario\"; did you mean \"--scenario\"?");
    row("simulate --xyzzyx", "unknown option \"--xyzzyx\"");
    row("simulat --scenario match", "there is no command \"simulat\"; did you mean \"simulate\"?");
    row("simulate match",
        "unexpected argument \"match\"; a scenario is chosen with --scenario match");
    row("simulate --seed x", "--seed must be a whole number, not \"x\"");
    row("simulate --duration", "--duration needs a value (T)");
    row("simulate --match 99", "--match must be from 0 to 45, not 99");
    row("simulate --pace slow", "--pace must be lock-step or free, not \"slow\"");
    row("simulate --at 3", "--at only works together with --from");
    row("record -o a.mcap --bind 127.0.0.1", "--bind only works together with --live");
    row("record -o a.mcap --live --pace free",
        "--pace and --live cannot be used together; leave out one of them");
    row("inspect", "FILE is missing: One or more recordings, or folders of recordings");
    row("simulate --from a.mcap --at 3 --seed 3",
        "--seed and --from cannot be used together; leave out one of them");
  }
  void mistakesAreNamed() {
    QFETCH(QString, line);
    QFETCH(QString, error);
    const ProgramRun run = runProgram("pitchboard-cli", line.split(' ', Qt::SkipEmptyParts));
    QCOMPARE(run.exitCode, 2);
    QCOMPARE(run.out, QByteArray());
    const QList<QByteArray> lines = run.err.split('\n');
    QCOMPARE(QString::fromUtf8(lines[0]), "error: " + error);
    QVERIFY2(lines[1].startsWith("Run \"pitchboard-cli"), run.err.constData());
  }

  void mistypedProcessesAreNamed() {
    const auto errorOf = [](const QStringList& words) {
      const ProgramRun run = runProgram("pitchboard-robot", words);
      return run.exitCode == 2 ? QString::fromUtf8(run.err.split('\n')[0]) : QString();
    };
    QCOMPARE(errorOf({"decide"}),
             QString("error: there is no command \"decide\"; did you mean \"decision\"?"));
    QCOMPARE(
        errorOf({"localisation", "--robot", "1"}),
        QString("error: there is no command \"localisation\"; did you mean \"localization\"?"));
    const QString other = errorOf({"play"});
    for (const char* name : {"decision", "localization", "management", "list"}) {
      QVERIFY2(other.contains(name), qPrintable(other));
    }
  }

  void missingProgramsAreExplained() {
    const ProgramRun run =
        runProgram("pitchboard-cli", {"simulate", "--scenario", "one-robot", "--runtime",
                                      "B1=no_such_chase.py", "--duration", "1"});
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.contains("write B1=program=./no_such_chase.py"), run.err.constData());
  }

  void helpFitsOnAScreen_data() {
    QTest::addColumn<QByteArray>("program");
    QTest::addColumn<QStringList>("words");
    for (const char* program : {"pitchboard-cli", "pitchboard-robot"}) {
      QTest::newRow(program) << QByteArray(program) << QStringList();
      const QStringList commands = commandsIn(helpOf(program, {}));
      QVERIFY(!commands.isEmpty());
      for (const QString& command : commands) {
        const QString name = QString(program) + ' ' + command;
        QTest::newRow(qPrintable(name)) << QByteArray(program) << QStringList{command};
        for (const QString& below : commandsIn(helpOf(program, {command}))) {
          QTest::newRow(qPrintable(name + ' ' + below))
              << QByteArray(program) << QStringList{command, below};
        }
      }
    }
  }
  void helpFitsOnAScreen() {
    QFETCH(QByteArray, program);
    QFETCH(QStringList, words);
    const QByteArray help = helpOf(program.constData(), words);
    const QList<QByteArray> lines = help.split('\n');
    QVERIFY2(lines.size() <= 50, help.constData());
    const int usage = int(help.indexOf("\nUsage: "));
    QVERIFY2(usage > 0, help.constData());
    if (help.contains("\nExample")) QVERIFY(help.indexOf("\nExample") < usage);
    // Options that the short page only names are described by the long one.
    const QByteArray all = helpOf(program.constData(), words, "--help-all");
    static const QRegularExpression option(QStringLiteral("--[a-z][a-z-]+"));
    for (auto found = option.globalMatch(QString::fromUtf8(help)); found.hasNext();) {
      const QByteArray name = found.next().captured().toUtf8();
      if (!name.startsWith("--help")) QVERIFY2(all.contains(name), name.constData());
    }
  }

  /// The studio described them in other words.
  void programsDescribeAnOptionAlike_data() {
    QTest::addColumn<QString>("command");
    QTest::addColumn<int>("least");
    QTest::newRow("simulate") << "simulate" << 12;
    QTest::newRow("listen") << "listen" << 12;
    QTest::newRow("record") << "record" << 24;
  }
  void programsDescribeAnOptionAlike() {
    QFETCH(QString, command);
    QFETCH(int, least);
    if (!QFile::exists(QStringLiteral(PITCHBOARD_BIN "/pitchboard"))) QSKIP("there is no studio");
    const auto studio = optionsIn(helpOf("pitchboard", {}, "--help-all"));
    const auto options = optionsIn(helpOf("pitchboard-cli", {command}, "--help-all"));
    // The same names, but other things: a time, a recording.
    const QStringList others{QStringLiteral("--from"), QStringLiteral("--at"),
                             QStringLiteral("--live")};
    int compared = 0;
    for (auto option = options.begin(); option != options.end(); ++option) {
      if (!studio.contains(option.key()) || others.contains(option.key())) continue;
      QCOMPARE(studio[option.key()], option.value());
      ++compared;
    }
    QVERIFY2(compared >= least, QByteArray::number(compared));
  }

  void bashCompletes_data() {
    QTest::addColumn<QStringList>("words");
    QTest::addColumn<QString>("offered");
    QTest::newRow("a command") << QStringList{"sim"} << "simulate";
    QTest::newRow("commands") << QStringList{"ex"} << "experiment explore export";
    QTest::newRow("an option") << QStringList{"simulate", "--sc"} << "--scenario";
    QTest::newRow("a choice") << QStringList{"simulate", "--cognition", "s"} << "separate";
    QTest::newRow("a command below") << QStringList{"blackboard", "d"} << "dump";
    QTest::newRow("an option below") << QStringList{"blackboard", "dump", "--al"} << "--all";
  }
  void bashCompletes() {
    QFETCH(QStringList, words);
    QFETCH(QString, offered);
    const ProgramRun script = runProgram("pitchboard-cli", {"--completion", "bash"});
    QCOMPARE(script.exitCode, 0);
    QProcess bash;
    bash.start(QStringLiteral("bash"),
               QStringList{"-c",
                           QString::fromUtf8(script.out) +
                               "\nCOMP_WORDS=(pitchboard-cli \"$@\")\nCOMP_CWORD=$#\n"
                               "_pitchboard_cli\necho \"${COMPREPLY[*]}\"",
                           "bash"} +
                   words);
    QVERIFY(bash.waitForFinished());
    QStringList found = QString::fromUtf8(bash.readAllStandardOutput()).split(' ');
    for (QString& one : found) one = one.trimmed();
    found.sort();
    QCOMPARE(found.join(' '), offered);
    QCOMPARE(bash.readAllStandardError(), QByteArray());
  }

  void otherShellsAreRefused() {
    const ProgramRun run = runProgram("pitchboard-cli", {"--completion", "fish"});
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.startsWith("error: --completion must be bash or zsh"), run.err.constData());
    QVERIFY(runProgram("pitchboard-cli", {"--completion", "zsh"}).out.startsWith("#compdef "));
  }
};

PITCHBOARD_TEST(TestCliUsage)

}  // namespace tst_cli_usage

#include "tst_cli_usage.moc"
