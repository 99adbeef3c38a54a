// SPDX-License-Identifier: GPL-3.0-or-later
// File > Add recording of a robot: the clock is estimated, shown, compared and changed by hand.

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QTimer>

#include <telemetry/session/session_reader.h>
#include <ui/base/notice_bar.h>
#include <ui/base/number_box.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

#include "../support/joined_recordings.h"
#include "../support/menu_entry.h"
#include "studio_rig.h"

namespace tst_join_dialog {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace joined_recordings;

namespace {

constexpr int patience_ms = 60'000;

/// Chooses a file in the next file dialog.
class OpenAnswer : public QObject {
 public:
  explicit OpenAnswer(const QString& path) {
    connect(&m_timer, &QTimer::timeout, this, [this, path] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (dialog == nullptr) return;
      m_timer.stop();
      dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))->setText(path);
      QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Open),
                        Qt::LeftButton);
      if (dialog->isVisible()) dialog->reject();
    });
    m_timer.start(10);
  }

 private:
  QTimer m_timer;
};

struct Window : studio_rig::Studio {
  QDialog* dialog = nullptr;

  void open(const QString& session) {
    window.openSession(session);
    QTRY_VERIFY_WITH_TIMEOUT(
        window.shown()->source() == window.replay() && window.replay()->path() == session,
        patience_ms);
  }
  void ask(const QString& recording) {
    QAction* entry = menu_entry::downFrom(window.menuBar(),
                                          {"File", QStringLiteral("Add recording of a robot…")});
    QVERIFY(entry != nullptr && entry->isEnabled());
    const OpenAnswer answer(recording);
    entry->trigger();
    dialog = window.findChild<QDialog*>(QStringLiteral("joinDialog"));
    QVERIFY(dialog != nullptr && dialog->isVisible());
  }
  template <class Widget>
  Widget* find(const char* name) const {
    auto* found = dialog->findChild<Widget*>(QLatin1String(name));
    if (found == nullptr) qFatal("there is no %s", name);
    return found;
  }
  QString text(const char* label) const { return find<QLabel>(label)->text(); }
  bool isReady() const { return find<QPushButton>("joinStart")->isEnabled(); }
  void type(const char* box, const QString& number) const {
    auto* edit = find<NumberBox>(box);
    edit->setFocus();
    edit->selectAll();
    QTest::keyClicks(edit, number);
  }
  void click(const char* button) const {
    QTest::mouseClick(find<QPushButton>(button), Qt::LeftButton);
  }
  /// ms, of the line about the changes that agree; −1: there is none yet.
  double residual() const {
    static const QRegularExpression number(QStringLiteral("residual ([0-9.]+) ms"));
    const auto found = number.match(text("joinAgreement"));
    return found.hasMatch() ? found.captured(1).toDouble() : -1.0;
  }
};

}  // namespace

class TestJoinDialog : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_live, m_first, m_other;
  std::size_t m_rows = 0;

 private slots:
  void initTestCase() {
    constexpr double length = 90.0;
    const auto played = playedBy("B1", 5, length);
    m_rows = played->rows.size();
    m_live = m_folder.filePath(QStringLiteral("live.mcap"));
    m_first = m_folder.filePath(QStringLiteral("flight.mcap"));
    m_other = m_folder.filePath(QStringLiteral("other.mcap"));
    LiveSession live(m_live.toStdString());
    live.addBoard("R1", 1, *played);
    live.addBoard("R2", 2, *playedBy("B2", 5, length));
    live.finish();
    writeOwn(m_first.toStdString(), partOf(*played, 0, m_rows / 2), 1, 1, "5000000");
    writeOwn(m_folder.filePath(QStringLiteral("flight-002.mcap")).toStdString(),
             partOf(*played, m_rows / 2 - 1, m_rows), 1, 2, "5000000");
    writeOwn(m_other.toStdString(), *playedBy("B1", 6, length), 1);
  }

  void theEstimateIsShownAndCanBeChanged() {
    Window s;
    s.open(m_live);
    s.ask(m_first);
    QTRY_VERIFY2_WITH_TIMEOUT(s.isReady(), qPrintable(s.text("joinMessage")), patience_ms);
    QVERIFY2(s.text("joinRecording").startsWith("flight.mcap and 1 more file, "),
             qPrintable(s.text("joinRecording")));
    QCOMPARE(s.find<QComboBox>("joinRobot")->currentText(), QStringLiteral("R1"));
    const double found = s.find<NumberBox>("joinOffset")->value();
    QVERIFY2(std::abs(found - plantedOffset) < 0.010, qPrintable(QString::number(found)));
    QVERIFY(std::abs(s.find<NumberBox>("joinDrift")->value() - 1e6 * plantedDrift) < 50.0);
    for (const char* estimate : {"joinOffsetEstimate", "joinDriftEstimate"}) {
      QVERIFY2(s.text(estimate).contains(QStringLiteral("±")), qPrintable(s.text(estimate)));
    }
    QTRY_VERIFY(s.residual() > 0.0);
    QVERIFY2(s.residual() < 30.0, qPrintable(s.text("joinAgreement")));
    QVERIFY(!s.find<QPushButton>("joinUseEstimate")->isEnabled());
    // A tenth of a second later nearly every change is as much apart.
    s.type("joinOffset", QString::number(found + 0.1, 'f', 3));
    QTRY_VERIFY2(std::abs(s.residual() - 100.0) < 20.0, qPrintable(s.text("joinAgreement")));
    s.click("joinUseEstimate");
    QTRY_VERIFY2(s.residual() < 30.0, qPrintable(s.text("joinAgreement")));
    QCOMPARE(s.find<NumberBox>("joinOffset")->value(), found);
    // What is set by hand is taken.
    s.type("joinOffset", QStringLiteral("-12.5"));
    s.type("joinDrift", QStringLiteral("80"));
    QTRY_VERIFY2(std::abs(s.residual() - 155.0) < 20.0, qPrintable(s.text("joinAgreement")));
    s.click("joinStart");
    QTRY_VERIFY_WITH_TIMEOUT(s.window.replay()->path() != m_live, patience_ms);
    const auto made =
        telemetry::SessionReader::open(s.window.replay()->path().toStdString()).value();
    double first = 1e9;
    std::size_t rows = 0;
    made.rows({-1e18, 1e18}, {}, [&](telemetry::GroupId group, const telemetry::RowView& row) {
      if (made.groups()[group].info.name != "R1") return true;
      first = std::min(first, row.time);
      ++rows;
      return true;
    });
    QVERIFY2(rows >= m_rows, qPrintable(QString::number(rows)));
    // Its first row is at second 0 of the match, 12.345 s after the recording's second 0 was.
    QVERIFY2(std::abs(first - (plantedOffset * -1.0 - 12.5)) < 0.02,
             qPrintable(QString::number(first)));
    QTRY_VERIFY2(s.window.notices()->text().contains(QStringLiteral("(2 files)")),
                 qPrintable(s.window.notices()->text()));
  }

  /// Of another match: it says so, and what can be done.
  void aRecordingThatDoesNotFitIsToldBeforeItIsJoined() {
    Window s;
    s.open(m_live);
    s.ask(m_other);
    QTRY_VERIFY_WITH_TIMEOUT(s.isReady(), patience_ms);
    QVERIFY2(s.text("joinMessage").contains("different robots"), qPrintable(s.text("joinMessage")));
    // Another robot can be chosen.
    auto* robot = s.find<QComboBox>("joinRobot");
    QCOMPARE(robot->count(), 2);
    QTest::keyClick(robot, Qt::Key_Down);
    QTRY_VERIFY_WITH_TIMEOUT(s.isReady(), patience_ms);
    QCOMPARE(robot->currentText(), QStringLiteral("R2"));
    QVERIFY2(s.text("joinMessage").contains("R2"), qPrintable(s.text("joinMessage")));
    // Nothing is joined.
    QTest::keyClick(s.dialog, Qt::Key_Escape);
    QTRY_VERIFY(s.window.findChild<QDialog*>(QStringLiteral("joinDialog")) == nullptr);
    QCOMPARE(s.window.replay()->path(), m_live);
  }

  void aFileThatIsNoRecordingOfARobotIsRefused() {
    Window s;
    s.open(m_live);
    const QString text = m_folder.filePath(QStringLiteral("text.mcap"));
    QFile file(text);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("no recording") > 0);
    file.close();
    s.ask(text);
    QTRY_VERIFY_WITH_TIMEOUT(!s.text("joinMessage").startsWith("Comparing"), patience_ms);
    QVERIFY2(s.text("joinMessage").contains("MCAP"), qPrintable(s.text("joinMessage")));
    QVERIFY(!s.isReady());
  }
};

PITCHBOARD_GUI_TEST(TestJoinDialog)

}  // namespace tst_join_dialog

#include "tst_join_dialog.moc"
