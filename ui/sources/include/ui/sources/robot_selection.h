// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The selected robots, and the one that the view follows, shared by the whole window. UI thread
// only.

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
  /// Returns the selection with this robot added, or removed if it is selected.
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

  /// Selects robots by a click outside the field; emits `chosen`, so that the field gets the keys.
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
  // Requests from one part of the window to another.
  void poseRequested(pitchboard::RobotKey id);
  void blackboardRequested(pitchboard::RobotKey id);

 private:
  std::vector<RobotKey> m_ids;
  std::optional<RobotKey> m_followed;
};

}  // namespace pitchboard::ui
