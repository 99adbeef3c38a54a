// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of which a session keeps rounded singles.

#include <QtTest>

#include <array>
#include <bit>
#include <limits>

#include <telemetry/session/session_export.h>

#include "session_format.h"
#include "session_rig.h"

namespace tst_session_resolution {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

GroupInfo group(int words) {
  GroupInfo info{"match", {}, {}};
  for (int i = 0; i < words; ++i) {
    info.columns.push_back(
        {"W" + std::to_string(i), ColumnType::Int32, "", "", ColumnKind::Number, {}});
  }
  info.columns.push_back({"COARSE", ColumnType::Float64, "cm", "", ColumnKind::Number, {}, 0.25});
  info.columns.push_back({"EXACT", ColumnType::Float64, "m", "", ColumnKind::Number, {}});
  info.columns.push_back(
      {"FINE", ColumnType::Float64, "m/s", "", ColumnKind::Number, {}, 1.0 / 1024});
  info.columns.push_back({"SPARE", ColumnType::Float64, "m/s", "", ColumnKind::Number, {}, 1.0});
  return info;
}

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

class TestSessionResolution : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

 private slots:
  void roundedAndInPlace_data() {
    QTest::addColumn<int>("words");
    for (const int words : {0, 1, 2, 3}) QTest::addRow("%d words", words) << words;
  }
  void roundedAndInPlace() {
    QFETCH(int, words);
    const std::string path = m_folder.filePath(QString::number(words)).toStdString();
    const GroupInfo info = group(words);
    const std::vector<std::array<double, 4>> rows{{12.3, 1.0 / 3, 0.1, 2.5},
                                                  {-12.4, nothing, -0.1, 1e300},
                                                  {nothing, -0.0, endless, -endless},
                                                  {1e-9, 5e-324, 1e9 + 0.5, -0.4}};
    const std::vector<std::array<double, 4>> wanted{{12.25, 1.0 / 3, 102.0 / 1024, 2.0},
                                                    {-12.5, nothing, -102.0 / 1024, endless},
                                                    {nothing, -0.0, endless, -endless},
                                                    {0.0, 5e-324, 1e9, -0.0}};
    std::vector<std::uint32_t> numbers;
    for (int i = 0; i < words; ++i) numbers.push_back(0xdead0000U + static_cast<std::uint32_t>(i));
    auto writer = SessionWriter::create(path, sessionInfo());
    const auto id = (*writer)->addGroup(info);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      (*writer)->append(id, {static_cast<double>(i), numbers, rows[i]});
    }
    QVERIFY((*writer)->finish());
    const auto compare = [&](const SessionReader& reader) {
      QVERIFY(reader.groups()[0].info == info);
      const auto found = rowsOf(reader, everything);
      QCOMPARE(found.size(), wanted.size());
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        QVERIFY(found[i].words == numbers);
        for (std::size_t c = 0; c < wanted[i].size(); ++c) {
          QVERIFY2(
              same(found[i].values[c], wanted[i][c]),
              qPrintable(QString("row %1, column %2: %3").arg(i).arg(c).arg(found[i].values[c])));
        }
      }
    };
    const auto reader = SessionReader::open(path);
    compare(*reader);
    // Written again they are the same: rounding twice is rounding once.
    QVERIFY(exportFile(*reader, ExportFormat::Mcap, {}, path + ".clip"));
    compare(*SessionReader::open(path + ".clip"));
    ExportSelection part;
    part.variables = {"EXACT", "SPARE"};
    QVERIFY(exportFile(*reader, ExportFormat::Mcap, part, path + ".part"));
    const auto last = rowsOf(*SessionReader::open(path + ".part"), everything);
    QVERIFY(same(last.at(3).values.at(0), 5e-324) && same(last[3].values.at(1), -0.0));
  }

  void whatIsNoResolutionIsNoGroup_data() {
    QTest::addColumn<QByteArray>("resolution");
    QTest::addColumn<bool>("good");
    QTest::newRow("a number") << QByteArray("0.5") << true;
    for (const char* bad : {"0", "-1", "\"x\"", "null", "[]", "1e999"})
      QTest::newRow(bad) << QByteArray(bad) << false;
  }
  void whatIsNoResolutionIsNoGroup() {
    QFETCH(QByteArray, resolution);
    QFETCH(bool, good);
    const auto json = [&](const char* type) {
      return "{\"name\":\"g\",\"columns\":[{\"name\":\"A\",\"type\":\"" + std::string(type) +
             "\",\"resolution\":" + resolution.toStdString() + "}]}";
    };
    QCOMPARE(session::groupFromJson(json("float64")).has_value(), good);
    QVERIFY(!session::groupFromJson(json("float32")));
  }

  void aFileOf016HasOneConditionForALostValue() {
    GroupInfo group{"g",
                    {{"LOST", ColumnType::Int32, "", "", ColumnKind::Flag, {}},
                     {"A", ColumnType::Float32, "cm", "", ColumnKind::Number, {}}},
                    {}};
    group.columns[1].lost = {{"LOST", 1.0}};
    std::string text = session::groupToJson(group);
    const std::string now = R"("lost":[{"column":"LOST","value":1.0}])";
    const auto at = text.find(now);
    QVERIFY2(at != std::string::npos, text.c_str());
    QVERIFY(session::groupFromJson(text) == group);
    text.replace(at, now.size(), R"("lost_by":"LOST","lost_when":1.0)");
    QVERIFY(session::groupFromJson(text) == group);
  }

  void factsAreWrittenByTheirNames() {
    GroupInfo group{"B1", {}, RobotFacts{}, MatchFacts{"rigid-body", 5, 60.0}};
    RobotFacts& robot = *group.robot;
    robot.uid = {7};
    robot.slot = 3;
    robot.number = 4;
    robot.team = pitchboard::TeamColor::Red;
    robot.order = pitchboard::RobotOrder{true, {2, 4, 1}};
    robot.place = 0;
    robot.name = "Ana";
    robot.live = true;
    robot.boardKey = 0;
    robot.imuStartsAt180 = false;
    robot.battery = BatteryVolts{16.8, 14.2, 13.0};
    robot.fieldOfView_deg = 61.3;
    const GroupAttributes written = attributesOf(group);
    QCOMPARE(written, (GroupAttributes{{"battery_empty", "13"},
                                       {"battery_full", "16.8"},
                                       {"battery_low", "14.2"},
                                       {"field_of_view", "61.3"},
                                       {"imu180", "0"},
                                       {"key", "0"},
                                       {"live", "1"},
                                       {"name", "Ana"},
                                       {"number", "4"},
                                       {"order", "1 2 4 1"},
                                       {"physics", "rigid-body"},
                                       {"place", "0"},
                                       {"robot", "3"},
                                       {"seed", "5"},
                                       {"team", "red"},
                                       {"tick_rate", "60"},
                                       {"uid", "7"}}));
    QVERIFY(session::groupFromJson(session::groupToJson(group)) == group);
    readAttributes({{"number", "-3"}, {"team", "green"}, {"seed", "x"}, {"radius", "nan"}}, group);
    QVERIFY(!group.robot && !group.match);
  }

  void aFileOfVersionOneHasHeadings() {
    GroupInfo group{"g", {{"A", ColumnType::Float64, "m", "Truth", ColumnKind::Number, {}}}, {}};
    std::string text = session::groupToJson(group);
    const auto at = text.find("category");
    QVERIFY(at != std::string::npos);
    QVERIFY(session::groupFromJson(text) == group);
    text.replace(at, 8, "heading");
    QVERIFY(session::groupFromJson(text) == group);
  }
};

PITCHBOARD_TEST(TestSessionResolution)

}  // namespace tst_session_resolution

#include "tst_session_resolution.moc"
