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

  const std::vector<RobotUid>& ids() const { return m_ids; }
  bool contains(RobotUid id) const {
    return std::find(m_ids.begin(), m_ids.end(), id) != m_ids.end();
  }
  void set(const std::vector<RobotUid>& ids) {
    if (ids == m_ids) return;
    m_ids = ids;
    emit changed(m_ids);
  }
  /// Returns the selection with this robot added, or removed if it is selected.
  std::vector<RobotUid> toggled(RobotUid id) const {
    std::vector<RobotUid> ids = m_ids;
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found != ids.end())
      ids.erase(found);
    else
      ids.push_back(id);
    return ids;
  }
  void toggle(RobotUid id) { set(toggled(id)); }

  /// Selects robots by a click outside the field; emits `chosen`, so that the field gets the keys.
  void choose(const std::vector<RobotUid>& ids) {
    set(ids);
    emit chosen();
  }

  std::optional<RobotUid> followed() const { return m_followed; }
  void follow(std::optional<RobotUid> id) {
    if (id == m_followed) return;
    m_followed = id;
    emit followedChanged(id);
  }

 signals:
  void changed(const std::vector<pitchboard::RobotUid>& ids);
  void followedChanged(std::optional<pitchboard::RobotUid> id);
  void chosen();
  // Requests from one part of the window to another.
  void poseRequested(pitchboard::RobotUid id);
  void blackboardRequested(pitchboard::RobotUid id);

 private:
  std::vector<RobotUid> m_ids;
  std::optional<RobotUid> m_followed;
};

}  // namespace pitchboard::ui
