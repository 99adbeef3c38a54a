// SPDX-License-Identifier: GPL-3.0-or-later
// The dialog that says what topics mean: a field is dragged onto x of robot 3, or put there with
// keys alone; the field shows the robot at a moment; problems are named until nothing is missing;
// the file that is saved is one that an import reads. Recordings are moved by dragging, and a
// Foxglove bridge is mapped like a recording.

#include <QComboBox>
#include <QDir>
#include <QDropEvent>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>

#include <ui/base/in_place_message.h>
#include <ui/base/number_box.h>
#include <ui/mapping/mapping_dialog.h>

#include "../../support/match_recordings.h"
#include "../../support/websocket_server.h"
#include "meaning_tree.h"
#include "offset_strip.h"
#include "topic_tree.h"

namespace tst_mapping_dialog {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

struct Dialog {
  MappingDialog* dialog;
  TopicTree* topics;
  MeaningTree* meanings;
  QListWidget* problems;
  QPushButton* use;

  explicit Dialog(MappingSource source) : dialog(new MappingDialog(std::move(source), nullptr)) {
    dialog->setAttribute(Qt::WA_DeleteOnClose, false);
    topics = dialog->findChild<TopicTree*>();
    meanings = dialog->findChild<MeaningTree*>();
    problems = dialog->findChild<QListWidget*>(QStringLiteral("mappingProblems"));
    use = dialog->findChild<QPushButton*>(QStringLiteral("mappingUse"));
    dialog->show();
  }
  ~Dialog() { delete dialog; }

  QTreeWidgetItem* rowOf(QTreeWidget* tree, const QStringList& names) const {
    QTreeWidgetItem* item = tree->invisibleRootItem();
    for (const QString& name : names) {
      item->setExpanded(true);
      QTreeWidgetItem* next = nullptr;
      for (int i = 0; i < item->childCount() && next == nullptr; ++i) {
        if (item->child(i)->text(0).startsWith(name)) next = item->child(i);
      }
      if (next == nullptr) return nullptr;
      item = next;
    }
    return item;
  }
  /// Drops a field on a row, with the events that a mouse makes.
  void drag(const link::TopicField& field, QTreeWidgetItem* onto) const {
    meanings->scrollToItem(onto);
    QMimeData data;
    data.setData(QString::fromLatin1(topicFieldMime), topicFieldBytes(field));
    const QPoint at = meanings->visualItemRect(onto).center();
    QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(meanings->viewport(), &enter);
    QDragMoveEvent move(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(meanings->viewport(), &move);
    QVERIFY(move.isAccepted());
    QDropEvent drop(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(meanings->viewport(), &drop);
    QVERIFY(drop.isAccepted());
  }
  QStringList sentences() const {
    QStringList texts;
    for (int i = 0; i < problems->count(); ++i) texts << problems->item(i)->text();
    return texts;
  }
  QString robotsShown() const {
    return dialog->findChild<QWidget*>(QStringLiteral("mappingField"))->accessibleName();
  }
};

const link::TopicField poseX{"/robot3/amcl_pose", "pose.pose.position.x"};
const link::TopicField poseY{"/robot3/amcl_pose", "pose.pose.position.y"};

}  // namespace

class TestMappingDialog : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  QString copyOf(const char* name, const QString& to) const {
    const QString path = m_folder.filePath(to);
    QFile::copy(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/recordings/") + name, path);
    return path;
  }

 private slots:
  void aFieldIsDraggedOntoXOfARobot() {
    const QString recording = copyOf("robot_walks.mcap", QStringLiteral("dragged.mcap"));
    Dialog d(mappingSource(QStringList{recording}));
    QTRY_VERIFY(d.dialog->isUpToDate() && d.topics->topLevelItemCount() > 3);
    // It begins with what is usual: nothing is missing, and both robots are on the field.
    QVERIFY2(d.sentences().isEmpty(), qPrintable(d.sentences().join('\n')));
    QVERIFY(d.use->isEnabled());
    QCOMPARE(d.robotsShown(), QStringLiteral("Field with robots: B3, B7"));
    QTreeWidgetItem* x = d.rowOf(d.topics, {"/robot3/amcl_pose", "pose", "pose", "position", "x"});
    QVERIFY(x != nullptr);
    QCOMPARE(x->text(1), QStringLiteral("m"));
    QVERIFY2(x->text(2).toDouble() != 0.0, qPrintable(x->text(2)));

    QTest::mouseClick(d.dialog->findChild<QPushButton*>(QStringLiteral("mappingAddRobot")),
                      Qt::LeftButton);
    const QString added = d.meanings->currentItem()->text(0);
    QCOMPARE(added, QStringLiteral("Robot 1, blue"));
    QVERIFY(
        d.sentences().contains(QStringLiteral("Robot 1: without a pose it is not on the field.")));
    d.drag(poseX, d.rowOf(d.meanings, {added, "Pose x"}));
    QCOMPARE(d.rowOf(d.meanings, {added, "Pose x"})->text(1),
             QStringLiteral("pose.pose.position.x"));
    QVERIFY(d.sentences().contains(QStringLiteral("Robot 1: the pose needs x and y.")));
    QVERIFY(!d.use->isEnabled());
    d.drag(poseY, d.rowOf(d.meanings, {added, "Pose y"}));
    QVERIFY(d.use->isEnabled());
    QTRY_VERIFY(d.dialog->isUpToDate());
    QCOMPARE(d.robotsShown(), QStringLiteral("Field with robots: B1, B3, B7"));

    // Delete clears a place.
    d.meanings->setCurrentItem(d.rowOf(d.meanings, {added, "Pose y"}));
    QTest::keyClick(d.meanings, Qt::Key_Delete);
    QVERIFY(!d.use->isEnabled());
    d.drag(poseY, d.rowOf(d.meanings, {added, "Pose y"}));

    QSignalSpy used(d.dialog, &MappingDialog::used);
    QTest::mouseClick(d.use, Qt::LeftButton);
    QCOMPARE(used.size(), 1);
    const QString file = m_folder.filePath(QStringLiteral("dragged.mapping.json"));
    QCOMPARE(used[0][0].toString(), file);
    QCOMPARE(used[0][1].toStringList(), QStringList{recording});
    const auto saved = link::mappingFromFile(file.toStdString());
    QVERIFY2(saved.has_value(), saved ? "" : saved.error().text().c_str());
    QCOMPARE(saved->robots.back().poses[0].x, poseX.path);
    // The next dialog continues with it.
    Dialog again(mappingSource(QStringList{recording}));
    QCOMPARE(again.dialog->mapping(), *saved);
  }

  void keysAreEnough() {
    Dialog d(mappingSource(QStringList{copyOf("robot_walks.mcap", QStringLiteral("keys.mcap"))}));
    QTRY_VERIFY(d.dialog->isUpToDate() && d.topics->topLevelItemCount() > 3);
    auto* filter = d.dialog->findChild<QLineEdit*>(QStringLiteral("mappingFilter"));
    QTest::keyClicks(filter, QStringLiteral("battery voltage"));
    QCOMPARE(d.topics->topLevelItemCount(), 1);
    QTreeWidgetItem* volts = d.rowOf(d.topics, {"/robot3/battery_state", "voltage"});
    QVERIFY(volts != nullptr);
    d.topics->setCurrentItem(volts);
    d.meanings->setCurrentItem(d.rowOf(d.meanings, {"Robot 7", "Battery voltage"}));
    auto* assign = d.dialog->findChild<QPushButton*>(QStringLiteral("mappingAssign"));
    QVERIFY(assign->isEnabled());
    QTest::keyClick(assign, Qt::Key_Space);
    QCOMPARE(d.rowOf(d.meanings, {"Robot 7", "Battery voltage"})->text(2),
             QStringLiteral("/robot3/battery_state"));
    // The menu lists every place.
    auto* menu = d.dialog->findChild<QToolButton*>(QStringLiteral("mappingUseAs"))->menu();
    emit menu->aboutToShow();
    QStringList robots;
    for (const QAction* action : menu->actions()) {
      if (action->menu() != nullptr) robots << action->text();
    }
    QCOMPARE(robots, (QStringList{"Robot 3, blue", "Robot 7, blue"}));
    // Team and number of the selected robot.
    auto* team = d.dialog->findChild<QComboBox*>(QStringLiteral("mappingTeam"));
    team->setCurrentText(QStringLiteral("red"));
    emit team->activated(team->currentIndex());
    QVERIFY(d.rowOf(d.meanings, {"Robot 7, red"}) != nullptr);
    QTRY_VERIFY(d.dialog->isUpToDate());
    QCOMPARE(d.robotsShown(), QStringLiteral("Field with robots: B3, R7"));
  }

  /// Values and robots are those of the slider's moment.
  void theFieldIsThatOfAMoment() {
    Dialog d(mappingSource(QStringList{copyOf("robot_walks.mcap", QStringLiteral("moment.mcap"))}));
    QTRY_VERIFY(d.dialog->isUpToDate() && d.topics->topLevelItemCount() > 3);
    QTreeWidgetItem* x = d.rowOf(d.topics, {"/robot3/amcl_pose", "pose", "pose", "position", "x"});
    const QString atEnd = x->text(2);
    auto* moment = d.dialog->findChild<QSlider*>(QStringLiteral("mappingMoment"));
    moment->setValue(moment->maximum() / 4);
    QTRY_VERIFY(d.dialog->isUpToDate());
    QVERIFY(x->text(2) != atEnd);
    moment->setValue(moment->maximum());
    QTRY_VERIFY(d.dialog->isUpToDate());
    QCOMPARE(x->text(2), atEnd);
  }

  void aRecordingIsMovedByDragging() {
    const auto write = [this](const char* name, const char* text) {
      QFile file(m_folder.filePath(QString::fromLatin1(name)));
      if (!file.open(QIODevice::WriteOnly) || file.write(text) < 0) qFatal("cannot write");
      return file.fileName();
    };
    const QString first = write("first.csv", "time,x\n1751364000,1\n1751364010,2\n");
    const QString second = write("second.csv", "time,y\n1751364002,1\n1751364004,2\n");
    link::TopicMapping mapping;
    mapping.recordings = {{"first.csv", link::RecordingClock::Auto, 0.0},
                          {"second.csv", link::RecordingClock::Auto, 0.0}};
    const std::string text = link::mappingText(mapping);
    write("first.mapping.json", text.c_str());
    Dialog d(mappingSource(QStringList{first, second}));
    auto* strip = d.dialog->findChild<OffsetStrip*>();
    QTRY_VERIFY(d.dialog->isUpToDate() && strip->isVisible());
    auto* times = d.dialog->findChild<QTableWidget*>(QStringLiteral("mappingTimes"));
    QCOMPARE(times->rowCount(), 2);
    const QRectF before = strip->barOf(1);
    const double second_px = strip->barOf(0).width() / 10.0;
    const QPoint from = before.center().toPoint();
    const QPoint to = from + QPoint(static_cast<int>(std::lround(3.0 * second_px)), 0);
    QTest::mousePress(strip, Qt::LeftButton, {}, from);
    QTest::mouseMove(strip, to);
    QTest::mouseRelease(strip, Qt::LeftButton, {}, to);
    const double moved = d.dialog->mapping().recordings[1].offset;
    QVERIFY2(std::abs(moved - 3.0) < 0.1, qPrintable(QString::number(moved)));
    QTRY_VERIFY(d.dialog->isUpToDate());
    auto* box = qobject_cast<NumberBox*>(times->cellWidget(1, 2));
    QCOMPARE(box->value(), moved);
    // Keys move it finely, and the box takes a number.
    strip->setFocus();
    QTest::keyClick(strip, Qt::Key_Left);
    QVERIFY(std::abs(d.dialog->mapping().recordings[1].offset - (moved - 0.01)) < 1e-9);
    QTRY_VERIFY(d.dialog->isUpToDate());
    box->setValue(-1.5);
    QCOMPARE(d.dialog->mapping().recordings[1].offset, -1.5);
    auto* clock = qobject_cast<QComboBox*>(times->cellWidget(0, 1));
    clock->setCurrentIndex(2);
    emit clock->activated(2);
    QVERIFY(d.dialog->mapping().recordings[0].clock == link::RecordingClock::Log);
    QTRY_VERIFY(d.dialog->isUpToDate());
    QTest::mouseClick(d.use, Qt::LeftButton);
    const auto saved = link::mappingFromFile(
        m_folder.filePath(QStringLiteral("first.mapping.json")).toStdString());
    QVERIFY(saved.has_value());
    QCOMPARE(saved->recordings[1].offset, -1.5);
  }

  /// The robot's clock was never set; the referee's log and its table have the kick-off in common.
  void recordingsAreAlignedByTheKickOff() {
    using match_recordings::writeRefereeLog;
    const auto path = [this](const char* name) { return m_folder.filePath(QLatin1String(name)); };
    const QString log = path("log.yaml"), robot = path("robot3.csv");
    writeRefereeLog(log.toStdString(), {{1.0, 2, 0}, {20.0, 3, 0}, {40.0, 4, 0}});
    match_recordings::writeRobotTable(robot.toStdString(), 500.0, 530.0,
                                      {{500.0, 2, 0}, {512.5, 3, 0}});
    Dialog d(mappingSource(QStringList{log, robot}));
    QTRY_VERIFY(d.dialog->isUpToDate());
    auto* align = d.dialog->findChild<QComboBox*>(QStringLiteral("mappingAlign"));
    QVERIFY(align->isVisible());
    QCOMPARE(align->currentText(), QStringLiteral("by their times"));
    const auto choose = [&](int which) {
      align->setCurrentIndex(which);
      emit align->activated(which);
      QTRY_VERIFY(d.dialog->isUpToDate());
    };
    choose(1);
    auto* message = d.dialog->findChild<InPlaceMessage*>(QStringLiteral("mappingMessage"));
    QVERIFY2(message->text().contains(QStringLiteral("robot3.csv")) &&
                 message->text().contains(QStringLiteral("no state of the game")),
             qPrintable(message->text()));
    QCOMPARE(align->currentText(), QStringLiteral("by their times"));
    // The mapping says what the states are.
    d.drag({"robot3", "state"}, d.rowOf(d.meanings, {"Referee", "Referee state"}));
    QTRY_VERIFY(d.dialog->isUpToDate());
    choose(1);
    QCOMPARE(align->currentText(), QStringLiteral("by the kick-off"));
    QCOMPARE(message->text(), QString());
    const double offset = 1'782'900'020.0 - 512.5;
    QCOMPARE(d.dialog->mapping().recordings[1].offset, offset);
    auto* times = d.dialog->findChild<QTableWidget*>(QStringLiteral("mappingTimes"));
    QCOMPARE(qobject_cast<NumberBox*>(times->cellWidget(1, 2))->value(), offset);
    auto* strip = d.dialog->findChild<OffsetStrip*>();
    const double second_px = strip->barOf(1).width() / 30.0;
    // The table begins 12.5 s before the kick-off, the log's game 19 s.
    QVERIFY(std::abs((strip->barOf(1).left() - strip->barOf(0).left()) / second_px - 6.5) < 0.2);
    // Who moves one aligns by hand.
    strip->setFocus();
    QTest::keyClick(strip, Qt::Key_Down);
    QTest::keyClick(strip, Qt::Key_Right);
    QTRY_VERIFY(d.dialog->isUpToDate());
    QCOMPARE(align->currentText(), QStringLiteral("by hand"));
    QVERIFY(!d.dialog->mapping().alignedBy);
    choose(0);
    QCOMPARE(d.dialog->mapping().recordings[1].offset, 0.0);
    choose(1);
    QTest::mouseClick(d.use, Qt::LeftButton);
    const auto saved = link::mappingFromFile(path("log.mapping.json").toStdString());
    QVERIFY(saved && saved->alignedBy == link::AlignEvent::KickOff);
    QCOMPARE(saved->recordings[1].offset, offset);
  }

  void aBridgeIsMapped() {
    WebSocketServer server("foxglove.sdk.v1");
    const auto address = telemetry::parseFoxgloveAddress(server.url()).value();
    const QString file = m_folder.filePath(QStringLiteral("bridge.json"));
    Dialog d(mappingSource(address, file));
    QTRY_VERIFY(server.isOpen());
    server.sendText(R"({"op":"serverInfo","name":"bridge","sessionId":"a"})");
    server.sendText(R"({"op":"advertise","channels":[{"id":1,"topic":"/where","encoding":"json",)"
                    R"("schemaName":"team/Where"},{"id":2,"topic":"/odd","encoding":"xml"}]})");
    QTRY_COMPARE(server.texts.size(), 1);
    QVERIFY(!server.texts[0].contains("\"channelId\":2"));
    const auto id = QJsonDocument::fromJson(server.texts[0])["subscriptions"][0]["id"].toInt();
    server.sendMessage(static_cast<quint32>(id), 1'751'364'000'000'000'000ULL,
                       R"({"px":1.5,"py":-0.5,"turn":90})");
    QTRY_VERIFY(d.dialog->isUpToDate() && d.topics->topLevelItemCount() == 2);
    QTest::mouseClick(d.dialog->findChild<QPushButton*>(QStringLiteral("mappingAddRobot")),
                      Qt::LeftButton);
    const QString robot = QStringLiteral("Robot 1, blue");
    d.drag({"/where", "px"}, d.rowOf(d.meanings, {robot, "Pose x"}));
    d.drag({"/where", "py"}, d.rowOf(d.meanings, {robot, "Pose y"}));
    d.drag({"/where", "turn"}, d.rowOf(d.meanings, {robot, "Pose heading"}));
    QTRY_VERIFY(d.dialog->isUpToDate());
    QCOMPARE(d.robotsShown(), QStringLiteral("Field with robots: B1"));
    QSignalSpy used(d.dialog, &MappingDialog::used);
    QTest::mouseClick(d.use, Qt::LeftButton);
    QCOMPARE(used.size(), 1);
    QVERIFY(link::mappingFromFile(file.toStdString()).has_value());
  }

  void whatCannotBeReadIsSaid() {
    Dialog d(mappingSource(QStringList{m_folder.filePath(QStringLiteral("none.mcap"))}));
    auto* message = d.dialog->findChild<InPlaceMessage*>(QStringLiteral("mappingMessage"));
    QTRY_VERIFY(message->text().contains(QStringLiteral("none.mcap")) && d.dialog->isUpToDate());
    QVERIFY(d.topics->topLevelItemCount() == 0);
  }
};

PITCHBOARD_GUI_TEST(TestMappingDialog)

}  // namespace tst_mapping_dialog

#include "tst_mapping_dialog.moc"
