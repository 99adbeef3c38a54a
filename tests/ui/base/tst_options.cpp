// SPDX-License-Identifier: GPL-3.0-or-later
// Command line, settings, JSON and dialog of a table say the same of each option.

#include <QAbstractSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QtTest>
#include <nlohmann/json.hpp>
#include <span>

#include <app/option_arguments.h>
#include <app/usage.h>
#include <base/option_json.h>
#include <robotlink/live/live_options.h>
#include <robotlink/live/live_state.h>
#include <ui/base/number_box.h>
#include <ui/base/option_form.h>
#include <ui/sources/live_settings.h>

namespace tst_options {

using namespace pitchboard;
using namespace pitchboard::ui;
using Json = nlohmann::json;

namespace {

struct Sample {
  int count = 3;
  double length = 1.5;
  bool isOn = false;
  std::string text = "usual";
  std::vector<std::string> names;
  std::uint64_t added = 7;
};

std::vector<Option<Sample>> sampleTable() {
  return {
      {{.name = "count",
        .key = "count",
        .form = "N",
        .title = "Count",
        .text = "How many there are",
        .min = 1,
        .max = 9,
        .isRecorded = true},
       optionMember<Sample, &Sample::count>},
      {{.name = "length",
        .key = "length",
        .form = "X",
        .title = "Length",
        .text = "How long it is",
        .unit = "m",
        .min = 0.5,
        .max = 2.5,
        .isRecorded = true},
       optionMember<Sample, &Sample::length>},
      {{.name = "on", .key = "isOn", .title = "On", .text = "Whether it is on", .isRecorded = true},
       optionMember<Sample, &Sample::isOn>},
      {{.name = "text",
        .key = "text",
        .form = "TEXT",
        .title = "Text",
        .text = "What it says",
        .isRecorded = true},
       optionMember<Sample, &Sample::text>},
      {{.name = "name",
        .key = "names",
        .form = "NAME",
        .title = "Names",
        .text = "What they are called",
        .isRecorded = true},
       optionMember<Sample, &Sample::names>},
  };
}

QString oneLine(const std::string& text) {
  return QString::fromStdString(text).simplified();
}

/// What the four say of each row is what the row says, and the default is that of the struct.
template <class Values>
void compareAll(std::span<const Option<Values>> table) {
  CLI::App app;
  OptionValues given;
  shared::addOptions(app, table, Values{}, given);
  const QString help = oneLine(shared::helpText(app, CLI::AppFormatMode::All));
  QTemporaryDir folder;
  QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
  saveOptions(settings, QStringLiteral("here/"), table, Values{});
  Json json = Json::object();
  writeOptions(json, table, Values{});
  QWidget dialog;
  auto* form = new QFormLayout(&dialog);
  OptionForm<Values> rows;
  for (const Option<Values>& option : table) {
    if (option.info.title) rows.add(form, option, &dialog);
  }
  rows.show(Values{});
  for (const Option<Values>& option : table) {
    const OptionInfo& info = option.info;
    const OptionValue usual = option.access.get(Values{});
    const QString text = oneLine(info.text);
    if (info.name) {
      const QString line = help.mid(help.indexOf(QStringLiteral(" --%1 ").arg(info.name)));
      QVERIFY2(line.contains(text), info.name);
      if (!optionText(usual).empty()) {
        QVERIFY2(line.contains(QStringLiteral("[%1]").arg(oneLine(optionText(usual)))), info.name);
      }
    }
    if (info.key) {
      const auto saved =
          settingOf(settings, QStringLiteral("here/") + QString::fromUtf8(info.key), usual);
      QVERIFY2(saved && *saved && **saved == usual, info.key);
    }
    if (info.isRecorded) {
      QVERIFY2(optionFromJson(json.at(info.key), usual) == usual, info.key);
    }
    if (!info.title) continue;
    auto* widget = dialog.findChild<QWidget*>(QString::fromUtf8(info.key));
    QVERIFY2(widget, info.key);
    QCOMPARE(widget->toolTip().simplified(), text);
    const auto* label = qobject_cast<QLabel*>(form->labelForField(widget));
    QCOMPARE(label ? label->text() : widget->property("text").toString(),
             QString::fromUtf8(info.title));
    if (const auto* box = qobject_cast<QSpinBox*>(widget)) {
      QCOMPARE(box->minimum(), static_cast<int>(info.min));
      QCOMPARE(box->maximum(), static_cast<int>(info.max));
      QCOMPARE(box->value(), std::get<int>(usual));
    } else if (const auto* number = qobject_cast<NumberBox*>(widget)) {
      QCOMPARE(number->minimum(), info.min);
      QCOMPARE(number->maximum(), info.max);
      QCOMPARE(number->value(), std::get<double>(usual));
      QCOMPARE(number->suffix().trimmed(), QString::fromUtf8(info.unit));
    }
  }
  // The form gives back what it shows.
  Values read{};
  QVERIFY(rows.read(read));
  for (const Option<Values>& option : table) {
    QVERIFY(option.access.get(read) == option.access.get(Values{}));
  }
}

template <class Values>
std::string problemOfLine(std::span<const Option<Values>> table, const std::string& line) {
  CLI::App app;
  Values values;
  shared::addOptions(app, table, values);
  shared::addHelp(app);
  try {
    app.parse(line);
  } catch (const CLI::ParseError& error) {
    return shared::problemText(app, error);
  }
  return {};
}

}  // namespace

class TestOptions : public QObject {
  Q_OBJECT
 private slots:
  void allSayTheSame() {
    compareAll<link::LiveOptions>(link::liveOptionTable());
    const auto table = sampleTable();
    compareAll<Sample>(table);
  }

  void aRowMoreIsInAllOfThem() {
    auto table = sampleTable();
    table.push_back({{.name = "added",
                      .key = "added",
                      .form = "N",
                      .title = "Added",
                      .text = "A row more",
                      .isRecorded = true},
                     optionMember<Sample, &Sample::added>});
    compareAll<Sample>(table);
    QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    Sample values, again, read;
    CLI::App app;
    shared::addOptions(app, table, values);
    app.parse(
        "--added 18446744073709551615 --count 5 --length 2 --on --text now --name a --name b");
    QCOMPARE(values.added, std::numeric_limits<std::uint64_t>::max());
    QCOMPARE(values.count, 5);
    QVERIFY(values.isOn);
    QCOMPARE(values.names, (std::vector<std::string>{"a", "b"}));
    saveOptions(settings, {}, table, values);
    QVERIFY(loadOptions(settings, {}, table, again));
    Json json = Json::object();
    writeOptions(json, table, values);
    readOptions(Json::parse(json.dump()), table, read);
    for (const auto& option : table) {
      QVERIFY(option.access.get(again) == option.access.get(values));
      QVERIFY(option.access.get(read) == option.access.get(values));
    }
  }

  void aRangeHoldsEverywhere() {
    const auto table = sampleTable();
    const std::span<const Option<Sample>> all(table);
    QCOMPARE(problemOfLine(all, "--count 10"), std::string("--count must be from 1 to 9, not 10"));
    QCOMPARE(problemOfLine(all, "--length 3"),
             std::string("--length must be from 0.5 to 2.5, not 3"));
    QCOMPARE(problemOfLine(all, "--count x"),
             std::string("--count must be a whole number, not \"x\""));
    QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    settings.setValue(QStringLiteral("count"), 10);
    settings.setValue(QStringLiteral("length"), QStringLiteral("nan"));
    settings.setValue(QStringLiteral("text"), QStringLiteral("kept"));
    Sample values;
    const auto loaded = loadOptions(settings, {}, all, values);
    QVERIFY(!loaded);
    QCOMPARE(values.count, 3);
    QCOMPARE(values.length, 1.5);
    QCOMPARE(values.text, std::string("kept"));
    readOptions(Json{{"count", 10}, {"length", 2}, {"names", 3}}, all, values);
    QCOMPARE(values.count, 3);
    QCOMPARE(values.length, 2.0);  // a whole number is a real one, too
    QVERIFY(!setOption(values, table[0], std::string("5")));
  }

  /// A state that was written by version 0.22.
  void recordedOptionsOfBeforeAreRead() {
    const link::LiveOptions usual;
    Json state = Json::parse(link::LiveState(usual).text(usual, 0.0, {}));
    Json& options = state["options"];
    options["ourTeam"] = 12;
    options["ourColour"] = "";
    options["timeout"] = 4'500'000'000;
    options["battery"] = {{"cells", 3}, {"full", 4.2}, {"low", 3.5}, {"empty", 3.3}};
    for (const char* key : {"cells", "fullPerCell", "lowPerCell", "emptyPerCell"}) {
      options.erase(key);
    }
    auto read = link::LiveState::read(state.dump(), {});
    QVERIFY(read);
    QCOMPARE(read->options.ourTeam, 12);
    QVERIFY(read->options.team.timeout == std::chrono::milliseconds(4500));
    QVERIFY(read->options.team.battery == (telemetry::BatteryLimits{3, 4.2, 3.5, 3.3}));
    options["ourColour"] = "red";
    read = link::LiveState::read(state.dump(), {});
    QVERIFY(read->options.ourColour == TeamColor::Red);
    QCOMPARE(read->options.ourTeam, 0);
  }

  /// Settings that were written by version 0.22: numbers, and addresses in one text.
  void settingsOfBeforeAreRead() {
    QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    settings.setValue(QStringLiteral("live/ourTeam"), 12);
    settings.setValue(QStringLiteral("live/senders"), QStringLiteral("192.168.0.0/24, 10.0.0.7"));
    settings.setValue(QStringLiteral("live/refereeSenders"), QString());
    settings.setValue(QStringLiteral("live/profileFile"), QString());
    settings.setValue(QStringLiteral("live/catalogs"),
                      QStringList{QStringLiteral("/not/there.json")});
    const LiveSettings live = loadLiveSettings(settings);
    QVERIFY(live.problem.contains(QStringLiteral("/not/there.json")));
    QCOMPARE(live.options.ourTeam, 12);
    QCOMPARE(live.options.team.senders.texts(),
             (std::vector<std::string>{"192.168.0.0/24", "10.0.0.7"}));
    QVERIFY(live.options.refereeSenders.empty());
    QVERIFY(live.options.catalogs.empty());
  }
};

PITCHBOARD_GUI_TEST(TestOptions)

}  // namespace tst_options

#include "tst_options.moc"
