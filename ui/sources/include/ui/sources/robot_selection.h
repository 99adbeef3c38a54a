// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which robots are selected, and which one the view follows: the same everywhere in the window. UI
// thread only.

#include <QObject>
#include <algorithm>
#include <optional>
#include <vector>

#include <base/robot_key.h>

namespace pitchboard::ui {

class RobotSelection : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  const std::vector<RobotKey>& ids() const { return m_ids; }
  bool contains(RobotKey id) const {
    return std::find(m_ids.begin(), m_ids.end(), id) != m_ids.end();
  }
  void set(const std::vector<RobotKey>& ids) {
    if (ids == m_ids) return;
    m_ids = ids;
    emit changed(m_ids);
  }
  /// With this robot in it, or without, if it was there.
  std::vector<RobotKey> toggled(RobotKey id) const {
    std::vector<RobotKey> ids = m_ids;
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found != ids.end())
      ids.erase(found);
    else
      ids.push_back(id);
    return ids;
  }
  void toggle(RobotKey id) { set(toggled(id)); }

  /// The same by a mouse outside of the field, to which the keys then belong: `chosen`.
  void choose(const std::vector<RobotKey>& ids) {
    set(ids);
    emit chosen();
  }

  std::optional<RobotKey> followed() const { return m_followed; }
  void follow(std::optional<RobotKey> id) {
    if (id == m_followed) return;
    m_followed = id;
    emit followedChanged(id);
  }

 signals:
  void changed(const std::vector<pitchboard::RobotKey>& ids);
  void followedChanged(std::optional<pitchboard::RobotKey> id);
  void chosen();
  // Asked for in one part of the window, opened by another.
  void poseRequested(pitchboard::RobotKey id);
  void blackboardRequested(pitchboard::RobotKey id);

 private:
  std::vector<RobotKey> m_ids;
  std::optional<RobotKey> m_followed;
};

}  // namespace pitchboard::ui
