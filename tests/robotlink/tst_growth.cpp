// SPDX-License-Identifier: GPL-3.0-or-later
// What is written and kept while a live session goes on must not grow faster than what was
// received. Counts bytes, groups and channels, never time; scripts/growth.sh measures time as well.
#include <QFileInfo>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <functional>

#include <robotlink/live/live_pipeline.h>
#include <robotlink/session/live_recorder.h>
#include <telemetry/session/session_reader.h>

namespace tst_growth {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::WallTime;

namespace {

struct Written {
  double bytes = 0.0;
  std::size_t groups = 0, channels = 0;
};

/// Records `count` datagrams of robot 1, which come 20 times a second.
Written record(const std::string& path, const LiveOptions& options, std::uint16_t port, int count,
               const std::function<std::string(int, double)>& text) {
  LivePipeline pipeline(options, WallTime{});
  auto recorder = LiveRecorder::create(path, options, WallTime{}).value();
  pipeline.observe(recorder, WallTime{});
  for (int i = 0; i < count; ++i) {
    const double time = 1.0 + 0.05 * i;
    const WallTime at{telemetry::Duration(std::llround(time * 1e9))};
    pipeline.take({at, {{0x0a00'0001}, 5000}, port, false, text(i, time)});
    (void)pipeline.advance(at);
  }
  pipeline.stopObserving(recorder);
  if (!recorder->finish()) qFatal("not written");
  const auto session = telemetry::SessionReader::open(path).value();
  Written out;
  out.bytes = static_cast<double>(QFileInfo(QString::fromStdString(path)).size());
  out.groups = session.groups().size();
  for (const telemetry::SessionGroup& group : session.groups()) {
    out.channels += group.channels.size();
  }
  return out;
}

}  // namespace

class TestGrowth : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  std::string path(const char* name) { return m_folder.filePath(name).toStdString(); }

  /// There are no more groups, and at most a few more channels, each of which describes all
  /// columns. `exponent` is that of the bytes: a row has every name so far, so that four times as
  /// many names are 16 times as many values, most of them those of the row before.
  static void compare(const Written& one, const Written& four, double exponent) {
    const double ratio = four.bytes / one.bytes;
    QVERIFY2(ratio <= std::pow(4.0, exponent),
             qPrintable(QString("%1 times the bytes").arg(ratio)));
    QCOMPARE(four.groups, one.groups);
    QVERIFY2(four.channels <= one.channels + 16,
             qPrintable(QString("%1 and %2 channels").arg(one.channels).arg(four.channels)));
  }

 private slots:
  void textsThatDifferInEveryMessage() {
    LiveOptions options;
    const std::string profile =
        "{\"name\": \"texts\", \"format\": \"json\", \"fields\": ["
        "{\"name\": \"NUMBER\", \"key\": \"robot\", \"type\": \"int\", \"meaning\": \"robot\"},"
        "{\"name\": \"STATE\", \"key\": \"state\", \"type\": \"text\"}]}";
    options.profile = telemetry::parseProfile(profile, "texts").value();
    const auto text = [](int i, double) {
      return "{\"robot\": 1, \"state\": \"looking " + std::to_string(i) + "\"}";
    };
    compare(record(path("texts.mcap"), options, 1241, 500, text),
            record(path("more texts.mcap"), options, 1241, 2000, text), 1.2);
  }

  void namesThatAppearOneByOne() {
    const auto text = [](int i, double time) {
      std::string out =
          "PB2 1 " + std::to_string(i) + ' ' + std::to_string(std::lround(1000 * time));
      for (int name = std::max(0, i - 20); name <= i; ++name) {
        out += " N" + std::to_string(name) + '=' + std::to_string(i);
      }
      return out + " OUT";
    };
    compare(record(path("names.mcap"), {}, 1341, 200, text),
            record(path("more names.mcap"), {}, 1341, 800, text), 1.4);
  }
};

PITCHBOARD_TEST(TestGrowth)

}  // namespace tst_growth

#include "tst_growth.moc"
