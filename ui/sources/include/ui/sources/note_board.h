// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The notes that are drawn on what is shown: texts, arrows and circles at a moment. Every source
// has its own; those of a recording are kept beside its file, those of a match and of Live also
// beside the file into which it is being recorded. All changes can be undone. Which tool draws next
// is known here, so that it draws on the field, on plots and on videos alike. UI thread only; files
// are written on a worker thread.

#include <QObject>
#include <QUndoStack>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include <telemetry/session/drawn_notes.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

class QAction;
class QMenu;

namespace pitchboard::ui {

class FrameSource;
class MatchController;
class ReplayController;
class SessionRecording;
class ShownMoment;

class NoteBoard : public QObject {
  Q_OBJECT
 public:
  struct Entry {
    quint64 id = 0;  ///< stays while the note is moved, changed, and brought back
    telemetry::DrawnNote note;
  };

  /// All must outlive it; `recording` may be null.
  NoteBoard(ShownMoment* shown, MatchController* match, ReplayController* replay,
            SessionRecording* recording, QObject* parent);
  ~NoteBoard() override;  ///< writes what has not been written

  ShownMoment* shown() const { return m_shown; }
  /// Returns the notes of the source that is shown.
  const std::vector<Entry>& entries() const;
  std::vector<telemetry::DrawnNote> notes() const;
  std::optional<telemetry::DrawnNote> find(quint64 id) const;

  /// Adds a note; returns 0 if there are too many, and notKept() says so.
  quint64 add(const telemetry::DrawnNote& note);
  void change(quint64 id, const telemetry::DrawnNote& note);
  void remove(const std::vector<quint64>& ids);
  QUndoStack* undoStack() { return &m_undo; }

  /// What the next press of the mouse draws; empty: nothing.
  std::optional<telemetry::NoteShape> tool() const { return m_tool; }
  void setTool(std::optional<telemetry::NoteShape> tool);
  /// Checkable, in the order of NoteShape.
  const std::array<QAction*, 3>& tools() const { return m_tools; }
  /// Somebody holds a note with the mouse, which cancel() gives up.
  void setHeld(bool on) { m_isHeld = on; }
  /// Gives up what is being drawn or moved, and the tool; returns whether there was any of them.
  bool cancel();
  /// How long the next note is shown (s): as long as the last one.
  double duration() const { return m_duration; }
  /// Waits until all files are written.
  void flush();

 signals:
  void changed();
  void toolChanged();
  void cancelled();
  /// A note could not be kept, as a sentence.
  void notKept(const QString& sentence);

 private:
  class Change;
  using Before = std::vector<std::pair<quint64, std::optional<telemetry::DrawnNote>>>;
  std::vector<Entry>& own();
  void put(quint64 id, const std::optional<telemetry::DrawnNote>& note);
  void push(const QString& text, Before before, Before after);
  void forget(FrameSource* source);
  /// The source goes on from this time.
  void forgetAfter(FrameSource* source, double time);
  void takeRecording();
  void beginRecorded();
  void changedHere();
  void listEvents();
  void keep();
  void write(const std::string& session, std::vector<telemetry::DrawnNote> notes);
  void writeNext();

  ShownMoment* m_shown;
  ReplayController* m_replay;
  SessionRecording* m_recording;
  std::map<FrameSource*, std::vector<Entry>> m_of;
  std::vector<telemetry::DrawnNote> m_recordedBefore;  // in this recording, of a Live that ended
  QUndoStack m_undo;
  quint64 m_lastId = 0;
  std::optional<telemetry::NoteShape> m_tool;
  std::array<QAction*, 3> m_tools{};
  bool m_isHeld = false;
  double m_duration = telemetry::DrawnNote::usualDuration;
  std::map<std::string, std::vector<telemetry::DrawnNote>> m_toWrite;  // by recording
  bool m_isWriting = false;
  UiQueue m_ui;
  Workers m_worker;  // last: waits for its work before the rest goes
};

/// Returns what was drawn where: "Arrow on the field".
QString titleOf(const telemetry::DrawnNote& note);
/// Adds the menu with the tools.
QMenu* addNoteTools(QMenu* menu, const NoteBoard& board);

}  // namespace pitchboard::ui
