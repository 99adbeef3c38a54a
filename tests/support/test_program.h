// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One program holds the tests of a folder, so that they are compiled together and linked once:
// `tests_ui tst_timeline` runs one of them, and arguments behind the name go to QtTest. A test is a
// file tst_NAME.cpp with a namespace of that name, in which it registers its class. ctest runs each
// test in a process of its own. Included before everything else in every test, by the compiler's
// command line.

#include <QtTest>

#include "patience.h"

#ifdef QT_GUI_LIB
#include <QCursor>
#include <QGuiApplication>
#endif
#ifdef QT_WIDGETS_LIB
#include <QApplication>
#endif

namespace pitchboard::tests {

/// Adds the test in this file to the program. Called before main().
bool registerTest(const char* file, int (*run)(int argc, char** argv));

template <class Application, class Test>
int runTest(int argc, char** argv) {
  Application application(argc, argv);
  application.setAttribute(Qt::AA_Use96Dpi, true);
#ifdef QT_GUI_LIB
  // Since Qt 6.8 a menu closes at a click before which the pointer was nowhere. A real pointer
  // always is somewhere.
  if constexpr (std::is_base_of_v<QGuiApplication, Application>) {
    QCursor::setPos(1, 1);
    QCoreApplication::processEvents();
  }
#endif
  Test test;
  return QTest::qExec(&test, argc, argv);
}

#ifdef QT_WIDGETS_LIB
using GuiApplication = QApplication;
#elif defined(QT_GUI_LIB)
using GuiApplication = QGuiApplication;
#endif

}  // namespace pitchboard::tests

#define PITCHBOARD_REGISTER_TEST(Test, Application) \
  [[maybe_unused]] static const bool registered =   \
      pitchboard::tests::registerTest(__FILE__, pitchboard::tests::runTest<Application, Test>);
/// A test without windows.
#define PITCHBOARD_TEST(Test) PITCHBOARD_REGISTER_TEST(Test, QCoreApplication)
/// A test with windows or pictures.
#define PITCHBOARD_GUI_TEST(Test) PITCHBOARD_REGISTER_TEST(Test, pitchboard::tests::GuiApplication)
