// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Runs the benchmarks of a program that paints: with the studio's theme, and without a screen
// unless one is asked for. Window thread.

#include <QApplication>

#include <benchmark/benchmark.h>
#include <ui/base/theme.h>

inline int runWithoutScreen(int argc, char** argv) {
  if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  const QApplication application(argc, argv);
  pitchboard::ui::setTheme(*qApp, pitchboard::ui::ThemeChoice::Dark);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
