// SPDX-License-Identifier: GPL-3.0-or-later
// The log under a flood: bench_log [LINES A SECOND=10000]. Ten seconds of lines, brought sixty
// times a second to a log that is filtered, follows its end and is painted each time, without a
// screen. Prints what of a frame of 16.7 ms that takes.

#include <sys/resource.h>

#include <QApplication>
#include <QTableView>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <ui/base/table_style.h>
#include <ui/base/theme.h>

#include "log_model.h"

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

double cpuMilliseconds() {
  rusage use{};
  ::getrusage(RUSAGE_SELF, &use);
  const auto ms = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) * 1e-3;
  };
  return ms(use.ru_utime) + ms(use.ru_stime);
}

void measure(const char* title, const QString& words, int perFrame) {
  LogModel model;
  LogFilter filter;
  filter.setSourceModel(&model);
  filter.setFilterText(words);
  QTableView table;
  table.setModel(&filter);
  styleTable(&table);
  table.resize(1200, 300);
  table.show();
  constexpr int frames = 600;
  std::vector<double> took;
  int next = 0;
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<LogLine> lines;
    for (int i = 0; i < perFrame; ++i, ++next) {
      lines.push_back({next / 10000.0, next % 3 == 0 ? "B1 decision" : "R2 localization",
                       "cycle " + std::to_string(next) + ": the ball is 83.2 cm away"});
    }
    const double before = cpuMilliseconds();
    model.append(lines);
    table.scrollToBottom();
    QCoreApplication::processEvents();
    took.push_back(cpuMilliseconds() - before);
  }
  std::sort(took.begin(), took.end());
  std::printf(
      "%-28s median %5.2f ms, 99 of 100 below %5.2f ms of a frame's 16.7 ms; %d lines kept\n",
      title, took[frames / 2], took[frames * 99 / 100], model.rowCount());
}

}  // namespace

int main(int argc, char** argv) {
  if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  const QApplication app(argc, argv);
  setTheme(*qApp, ThemeChoice::Dark);
  const int lines = argc > 1 ? std::atoi(argv[1]) : 10'000;
  if (lines < 60) {
    std::fprintf(stderr, "error: bench_log [LINES A SECOND], at least 60, for example 10000\n");
    return 2;
  }
  measure("all lines", {}, lines / 60);
  measure("filtered by two words", QStringLiteral("b1 ball"), lines / 60);
  measure("filtered by a rare word", QStringLiteral("77777"), lines / 60);
  return 0;
}
