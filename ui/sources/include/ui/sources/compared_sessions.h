// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The sessions that are compared with the source that is shown, in the order in which they were
// opened: at most maxComparedSessions. Files are opened one after the other. UI thread only; owns
// the sessions.

#include <QObject>
#include <QStringList>
#include <deque>
#include <optional>
#include <vector>

#include <ui/base/session_mark.h>
#include <ui/sources/frame_source.h>

namespace pitchboard::ui {

class ComparedSession;
class ShownMoment;

class ComparedSessions : public QObject {
  Q_OBJECT
 public:
  ComparedSessions(ShownMoment* shown, QObject* parent);

  /// Opens these files in addition; returns immediately. changed() follows for each, and failed()
  /// once for all that cannot be opened. The same file may be opened several times.
  void open(const QStringList& paths);
  /// Closes a session; the others keep colour and alignment.
  void remove(ComparedSession* session);
  void removeAll();
  const std::vector<ComparedSession*>& all() const { return m_sessions; }
  bool isEmpty() const { return m_sessions.empty(); }
  /// Returns the session with this id; null if it was closed.
  ComparedSession* find(quint64 id) const;

  /// Limits the memory for rows, in bytes, shared by all of them: a session gets what the others
  /// leave, and at least a sixteenth.
  void setMemoryBudget(std::size_t bytes);
  void alignAllByTime();
  bool areAlignedByTime() const;

  /// Asks for `session` to be opened in place of the source that is shown; openRequested() follows.
  void openInstead(ComparedSession* session);
  /// Returns whether opening this file was asked for by openInstead().
  bool isInstead(const QString& path) const { return m_instead && m_instead->path == path; }
  /// The file is shown now: the session that it was is closed, the file that was shown before is
  /// compared in its place, and all keep their alignment to each other.
  void finishInstead();
  void forgetInstead() { m_instead.reset(); }

 signals:
  /// A session was opened, closed, aligned, or is shown elsewhere.
  void changed();
  /// More files are being opened.
  void started();
  /// The rows of a session are more.
  void rowsCame();
  /// What could not be opened, as sentences.
  void failed(const QString& sentences);
  /// The frame of a session that belongs to the moment shown; null if there is none.
  void momentReached(int number, const pitchboard::ui::FramePtr& frame);
  void openRequested(const QString& path);

 private:
  struct Asked {
    QString path;
    std::optional<double> offset;  // s; nothing: aligned by time
  };
  struct Instead {
    quint64 session;
    QString path, shown;
    double offset, time;  // s; the moment shown
  };
  void openNext();
  void take();
  int freeNumber() const;
  std::size_t budgetOfNext() const;

  ShownMoment* m_shown;
  std::vector<ComparedSession*> m_sessions;
  ComparedSession* m_opening = nullptr;
  std::deque<Asked> m_asked;  // the first one is m_opening's
  QStringList m_problems;
  std::optional<Instead> m_instead;
  quint64 m_lastId = 0;
  std::size_t m_budget = std::size_t{1} << 30;
};

}  // namespace pitchboard::ui
