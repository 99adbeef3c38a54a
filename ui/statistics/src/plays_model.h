// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays of one or several sessions as a table, and which of them are shown. UI thread only.

#include <QAbstractTableModel>
#include <QDateTime>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <robotlink/report/play_event.h>
#include <ui/base/text_filter.h>

namespace pitchboard::ui {

/// What the table says of a play. Sorting and filtering ask for all of them.
struct PlayText {
  std::array<QString, 3> columns;  ///< kind, robot and what happened
  QString folded;                  ///< all of them, without upper and lower case, to be searched
  bool operator==(const PlayText&) const = default;
};
using PlayWords = std::vector<PlayText>;
/// Makes them; any thread.
PlayWords wordsOf(const std::vector<link::PlayEvent>& plays);

/// The plays of a session.
struct SessionPlays {
  quint64 id = 0;  ///< of a compared session; 0: of the source that is shown
  int number = 0;  ///< of its colour and mark (session_mark.h)
  QString name = {};
  double offset = 0.0;  ///< s, time of its second 0 in the source that is shown
  std::vector<link::PlayEvent> plays = {};
  PlayWords words = {};
  bool operator==(const SessionPlays&) const = default;
};

class PlaysModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, Session, Kind, Robot, What, columns };
  static constexpr int sortRole = Qt::UserRole;  ///< s, or the text
  using QAbstractTableModel::QAbstractTableModel;

  /// `clock`: the time of day at second 0; empty: times are shown in seconds. Words that are
  /// missing are made.
  void show(std::vector<SessionPlays> sessions, const std::optional<QDateTime>& clock);
  const link::PlayEvent& at(int row) const;
  const SessionPlays& sessionOf(int row) const;
  /// The time in the source that is shown, s.
  double timeOf(int row) const { return at(row).time + sessionOf(row).offset; }
  QString textOf(int row, int column) const;
  /// Returns whether this stands in some column but the time; `folded`: without upper and lower
  /// case.
  bool contains(int row, const QString& folded) const;
  /// Of columns other than the time.
  bool isBefore(int row, int other, int column) const {
    return wordOf(row, column) < wordOf(other, column);
  }
  const std::vector<SessionPlays>& sessions() const { return m_sessions; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  const PlayText& playText(int row) const;
  const QString& wordOf(int row, int column) const;

  std::vector<SessionPlays> m_sessions;
  std::vector<std::pair<std::size_t, std::size_t>> m_rows;  // session, and play of it
  std::optional<QDateTime> m_clock;
};

/// Plays of a kind, and of a team or a robot, that contain the filter text.
class PlaysFilter : public TextFilter {
  Q_OBJECT
 public:
  using TextFilter::TextFilter;
  /// Empty: all.
  void setKind(std::optional<link::PlayKind> kind) {
    if (std::exchange(m_kind, kind) != kind) filterAgain();
  }
  void setFilterText(const QString& text) { TextFilter::setFilterText(text.toCaseFolded()); }
  /// Of this robot, also as the other one, or of this team; empty: all.
  void setWho(std::string robot, std::optional<TeamColor> team) {
    const bool isOther = m_robot != robot || m_team != team;
    m_robot = std::move(robot);
    m_team = team;
    if (isOther) filterAgain();
  }
  /// Of the session with this id; empty: of all.
  void setSession(std::optional<quint64> id) {
    if (std::exchange(m_session, id) != id) filterAgain();
  }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;
  bool lessThan(const QModelIndex& a, const QModelIndex& b) const override;

 private:
  std::optional<link::PlayKind> m_kind;
  std::string m_robot;
  std::optional<TeamColor> m_team;
  std::optional<quint64> m_session;
};

}  // namespace pitchboard::ui
