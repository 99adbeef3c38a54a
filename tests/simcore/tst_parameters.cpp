// SPDX-License-Identifier: GPL-3.0-or-later
#include <QFile>
#include <QtTest>

#include <array>
#include <charconv>
#include <limits>
#include <set>
#include <string>

#include <simcore/world/parameters.h>
#include <simcore/world/state_values.h>

namespace tst_parameters {

using namespace pitchboard;

namespace {

/// The addresses of all numbers that a visitor of state_values comes by.
struct Numbers {
  std::set<const double*> found;
  void value(const double& number) { found.insert(&number); }
  void label(const double& number, std::uint64_t /*form*/) { found.insert(&number); }
  template <class Other>
  void value(const Other&) {}
};

/// Six digits are enough for people.
std::string readable(double value) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  return {text.data(), end.ptr};
}

template <class Values, std::size_t N>
QString tableOf(const std::array<sim::Parameter<Values>, N>& parameters) {
  const Values usual{};
  QString text = "| key | name | meaning | unit | default | range |\n|---|---|---|---|---|---|\n";
  for (const auto& p : parameters) {
    text += QString("| `%1` | %2 | %3 | %4 | %5 | %6 to %7 |\n")
                .arg(p.key, p.name, p.meaning, p.unit.symbol,
                     QString::fromStdString(readable(p.written(usual.*p.member))),
                     QString::fromStdString(readable(p.least)), QString::number(p.most, 'g', 10));
  }
  return text;
}

}  // namespace

class TestParameters : public QObject {
  Q_OBJECT

 private slots:
  void everyNumberOfTheStateHasOneRow() {
    const auto same = []<class Values>(const Values& values, const auto& parameters,
                                       const Numbers& numbers) {
      std::set<const double*> named;
      std::set<std::string> keys, names;
      for (const auto& p : parameters) {
        named.insert(&(values.*p.member));
        keys.insert(p.key);
        names.insert(p.name);
      }
      return named == numbers.found && keys.size() == parameters.size() &&
             names.size() == parameters.size();
    };
    const sim::NoiseParameters noise;
    Numbers ofNoise;
    sim::state_values::noise(noise, ofNoise);
    QVERIFY(same(noise, sim::noiseParameters, ofNoise));
    const sim::RigidBodySettings body;
    const sim::Surface surface;
    Numbers ofBody, ofSurface;
    sim::state_values::surface(surface, ofSurface);
    QVERIFY(same(surface, sim::surfaceParameters, ofSurface));
    sim::state_values::rigidBody(body, surface, ofBody);
    for (const double* number : ofSurface.found) ofBody.found.erase(number);
    QVERIFY(same(body, sim::rigidBodyParameters, ofBody));
    const sim::RobotModel model;
    Numbers ofModel, ofItsNoise;
    sim::state_values::robotModel(model, ofModel);
    sim::state_values::noise(model.noise, ofItsNoise);
    for (const double* number : ofItsNoise.found) ofModel.found.erase(number);
    QVERIFY(same(model, sim::robotModelParameters, ofModel));
    const sim::FieldSpec field;
    Numbers ofField;
    sim::state_values::field(field, ofField);
    QVERIFY(same(field, sim::fieldParameters, ofField));
  }

  void whatASliderReachesIsAllowed() {
    const auto check = [](const auto& parameters) {
      for (const auto& p : parameters) {
        QVERIFY2(p.shown.decimals >= 0 && p.shown.least < p.shown.most, p.key);
        QVERIFY2(p.shown.least / p.shown.factor >= p.least, p.key);
        QVERIFY2(p.shown.most / p.shown.factor <= p.most, p.key);
      }
    };
    check(sim::noiseParameters);
    check(sim::rigidBodyParameters);
    check(sim::robotModelParameters);
  }

  void theEdgesOfARangeAreAllowedAndNothingBeyond() {
    const auto check = []<class Values>(const auto& parameters, const Values& usual,
                                        const auto& valid) {
      for (const auto& p : parameters) {
        Values values = usual;
        for (const double edge : {p.least, p.most}) {
          values.*p.member = p.stored(edge);
          QVERIFY2(valid(values), p.key);
        }
        for (const double beyond :
             {p.least - 0.001 * p.most, p.most * 1.001, std::numeric_limits<double>::quiet_NaN()}) {
          values.*p.member = p.stored(beyond);
          const auto refused = valid(values);
          QVERIFY2(!refused, p.key);
          QVERIFY2(refused.error().context.ends_with(p.key), refused.error().text().c_str());
        }
      }
    };
    check(sim::noiseParameters, sim::NoiseParameters{},
          [](const auto& values) { return sim::validate(values); });
    check(sim::rigidBodyParameters, sim::RigidBodySettings{},
          [](const auto& values) { return sim::validate(values); });
    check(sim::robotModelParameters, sim::RobotModel{},
          [](const auto& values) { return sim::validate(values); });
    check(std::array{sim::tickRateParameter}, sim::SimulationSettings{},
          [](const auto& values) { return sim::validate(values); });
  }

  // PITCHBOARD_WRITE_DOCS=1 puts the tables into the document instead.
  void theDocumentHasTheTables() {
    QFile file(QString(PITCHBOARD_SOURCE_DIR) + "/docs/scenarios.md");
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(file.readAll());
    file.close();
    QString right = text;
    const auto put = [&right](const QString& name, const QString& table) {
      const QString mark = "<!-- " + name + " -->\n";
      const auto begin = right.indexOf(mark);
      QVERIFY2(begin >= 0, qPrintable(name));
      const auto end = right.indexOf("<!-- end -->", begin);
      QVERIFY2(end >= 0, qPrintable(name));
      right.replace(begin, end - begin, mark + table);
    };
    put("fieldParameters", tableOf(sim::fieldParameters));
    put("surfaceParameters", tableOf(sim::surfaceParameters));
    put("noiseParameters", tableOf(sim::noiseParameters));
    put("rigidBodyParameters", tableOf(sim::rigidBodyParameters));
    put("robotModelParameters", tableOf(sim::robotModelParameters));
    if (qEnvironmentVariableIsSet("PITCHBOARD_WRITE_DOCS")) {
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(right.toUtf8());
      return;
    }
    const QStringList lines = text.split('\n');
    const QStringList rightLines = right.split('\n');
    for (qsizetype i = 0; i < std::min(lines.size(), rightLines.size()); ++i) {
      QCOMPARE(lines[i], rightLines[i]);
    }
    QCOMPARE(lines.size(), rightLines.size());
  }
};

PITCHBOARD_TEST(TestParameters)

}  // namespace tst_parameters

#include "tst_parameters.moc"
