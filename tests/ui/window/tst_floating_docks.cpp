// SPDX-License-Identifier: GPL-3.0-or-later
// Panels that float, on an X server of this test's own with a window manager (openbox): what is
// above what, says the server by way of xdotool.
#include <QDockWidget>
#include <QProcess>
#include <QScreen>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>
#include <algorithm>
#include <cstdio>

#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/window/main_window.h>

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

/// Ends with its owner.
class Program : public QProcess {
 public:
  ~Program() override {
    if (state() == NotRunning) return;
    terminate();
    if (!waitForFinished()) kill();
    waitForFinished();
  }
};

/// The window of the root that is seen there, frame included; empty while the server does not say.
QByteArray windowAt(const QPoint& place) {
  QProcess look;
  look.start(QStringLiteral("xdotool"),
             {QStringLiteral("mousemove"), QString::number(place.x()), QString::number(place.y()),
              QStringLiteral("getmouselocation"), QStringLiteral("--shell")});
  if (!look.waitForFinished() || look.exitCode() != 0) return {};
  for (const QByteArray& line : look.readAllStandardOutput().split('\n')) {
    if (line.startsWith("WINDOW=")) return line.mid(7);
  }
  return {};
}

void click(const QPoint& place) {
  QProcess::execute(QStringLiteral("xdotool"),
                    {QStringLiteral("mousemove"), QString::number(place.x()),
                     QString::number(place.y()), QStringLiteral("click"), QStringLiteral("1")});
}

}  // namespace

class TestFloatingDocks : public QObject {
  Q_OBJECT

  struct Studio {
    MatchController controller;
    MainWindow window;
    explicit Studio(QSettings* settings) : controller(options()), window(&controller, settings) {
      window.resize(1200, 800);
      window.show();
    }
    static link::MatchOptions options() {
      link::MatchOptions made;
      made.cognition = link::Cognition::Inline;
      return made;
    }
    QDockWidget* dock() { return window.findChild<QDockWidget*>(QStringLiteral("variables")); }
    /// A place of the window that no panel at (200, 250) covers.
    QPoint ground() { return window.geometry().center() + QPoint(120, 0); }
  };

 private slots:
  void theyComeBackAboveTheWindow_data() {
    QTest::addColumn<QPoint>("place");
    QTest::newRow("over the field") << QPoint(200, 250);
    // As after a larger screen.
    QTest::newRow("beyond the screen") << QPoint(1500, 700);
  }
  void theyComeBackAboveTheWindow() {
    QFETCH(const QPoint, place);
    const QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    {
      Studio s(&settings);
      QVERIFY(QTest::qWaitForWindowActive(&s.window));
      const auto buttons = s.dock()->titleBarWidget()->findChildren<QToolButton*>();
      const auto button =
          std::ranges::find(buttons, QStringLiteral("Float or dock"), &QToolButton::accessibleName);
      QVERIFY(button != buttons.end());
      QTest::mouseClick(*button, Qt::LeftButton);
      QTRY_VERIFY(s.dock()->isFloating() && s.dock()->isVisible());
      s.dock()->setGeometry(QRect(place, QSize(300, 300)));
      QTRY_COMPARE(s.dock()->geometry().topLeft(), place);
      s.window.close();
    }
    Studio s(&settings);
    QVERIFY(QTest::qWaitForWindowExposed(&s.window));
    QTRY_VERIFY(s.dock()->isFloating() && s.dock()->isVisible());
    QVERIFY(QTest::qWaitForWindowExposed(s.dock()));
    const QRect screen = s.window.screen()->geometry();
    QTRY_VERIFY(screen.contains(s.dock()->geometry()));
    QTRY_VERIFY(s.window.geometry().intersects(s.dock()->geometry()));
    QByteArray panel, window;
    const auto isAbove = [&] {
      const QRect both = s.dock()->geometry() & s.window.geometry();
      panel = windowAt(both.center());
      window = windowAt(s.ground());
      return !panel.isEmpty() && !window.isEmpty() && panel != window;
    };
    QTRY_VERIFY2(isAbove(), qPrintable(QStringLiteral("at the panel %1, at the window %2")
                                           .arg(QLatin1String(panel), QLatin1String(window))));
    // Working in the window does not bury it.
    click(s.ground());
    QTRY_VERIFY(s.window.isActiveWindow());
    QTRY_VERIFY(isAbove());
  }
};

int main(int argc, char** argv) {
  Program server, manager;
  server.start(QStringLiteral("Xvfb"),
               {QStringLiteral("-displayfd"), QStringLiteral("1"), QStringLiteral("-screen"),
                QStringLiteral("0"), QStringLiteral("1600x1000x24"), QStringLiteral("-nolisten"),
                QStringLiteral("tcp")});
  constexpr int patience = 30'000;
  if (!server.waitForReadyRead(patience)) {
    std::fprintf(stderr, "error: Xvfb does not start; install the Debian package xvfb\n");
    return 1;
  }
  qputenv("DISPLAY", ":" + server.readLine().trimmed());
  qputenv("QT_QPA_PLATFORM", "xcb");
  manager.start(QStringLiteral("openbox"), QStringList());
  if (!manager.waitForStarted(patience)) {
    std::fprintf(stderr, "error: openbox does not start; install the Debian package openbox\n");
    return 1;
  }
  QApplication application(argc, argv);
  setTheme(application, ThemeChoice::Dark);
  TestFloatingDocks test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_floating_docks.moc"
