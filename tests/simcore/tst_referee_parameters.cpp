// SPDX-License-Identifier: GPL-3.0-or-later
// The table of a referee's rules names every number and switch once, and docs/referee.md shows it.
#include <QFile>
#include <QtTest>

#include <set>

#include <simcore/rules/referee.h>
#include <simcore/world/referee_parameters.h>

namespace tst_referee_parameters {

using namespace pitchboard;

namespace {

void forEveryNumber(auto&& take) {
  for (const auto& p : sim::refereeCounts) take(p);
  for (const auto& p : sim::refereeParameters) take(p);
}

QString numbersTable() {
  const sim::RefereeRules usual;
  QString text = "| key | name | meaning | unit | default | range |\n|---|---|---|---|---|---|\n";
  forEveryNumber([&](const auto& p) {
    text += QString("| `%1` | %2 | %3 | %4 | %5 | %6 to %7 |\n")
                .arg(p.key, p.name, p.meaning, p.unit.symbol, QString::number(usual.*p.member),
                     QString::number(p.least), QString::number(p.most));
  });
  return text;
}

QString switchesTable() {
  const sim::RefereeRules usual;
  QString text = "| key | rule | default |\n|---|---|---|\n";
  for (const auto& one : sim::refereeSwitches) {
    text += QString("| `%1` | %2 | %3 |\n")
                .arg(one.key, one.name, usual.*one.member ? "true" : "false");
  }
  return text;
}

}  // namespace

class TestRefereeParameters : public QObject {
  Q_OBJECT
 private slots:
  void everyValueHasOneRow() {
    sim::RefereeRules rules;
    std::set<const void*> named, found;
    std::set<std::string> keys;
    forEveryNumber([&](const auto& p) {
      named.insert(&(rules.*p.member));
      keys.insert(p.key);
    });
    for (const auto& one : sim::refereeSwitches) {
      named.insert(&(rules.*one.member));
      keys.insert(one.key);
    }
    sim::visitRefereeRules(rules, [&found](auto&... values) {
      const auto look = [&found]<class T>(T& value) {
        if constexpr (std::is_arithmetic_v<T>) found.insert(&value);
      };
      (look(values), ...);
    });
    QVERIFY(named == found);
    QCOMPARE(keys.size(), named.size());
  }

  void whatIsOutOfRangeIsRefused() {
    forEveryNumber([](const auto& p) {
      sim::RefereeRules rules;
      using Number = std::remove_reference_t<decltype(rules.*p.member)>;
      rules.*p.member = static_cast<Number>(p.most);
      QVERIFY2(sim::validate(rules), p.key);
      rules.*p.member = static_cast<Number>(p.most + 1);
      const auto refused = sim::validate(rules);
      QVERIFY2(!refused, p.key);
      QVERIFY(refused.error().context.ends_with(p.key));
    });
  }

  // PITCHBOARD_WRITE_DOCS=1 puts the tables into the document instead.
  void theDocumentHasTheTables() {
    QFile file(QString(PITCHBOARD_SOURCE_DIR) + "/docs/referee.md");
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(file.readAll());
    file.close();
    QString right = text;
    for (const auto& [name, table] :
         {std::pair<QString, QString>{"refereeParameters", numbersTable()},
          {"refereeSwitches", switchesTable()}}) {
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
    QVERIFY2(text == right, "run PITCHBOARD_WRITE_DOCS=1 tst_referee_parameters");
  }
};

PITCHBOARD_TEST(TestRefereeParameters)

}  // namespace tst_referee_parameters

#include "tst_referee_parameters.moc"
