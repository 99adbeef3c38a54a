// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which robots are selected, and which one the view follows: the same everywhere in the window. UI
// thread only.

#include <QObject>
#include <algorithm>
#include <optional>
#include <vector>

#include <base/ids.h>

namespace pitchboard::ui {

class RobotSelection : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  const std::vector<RobotId>& ids() const { return m_ids; }
  bool contains(RobotId id) const {
    return std::find(m_ids.begin(), m_ids.end(), id) != m_ids.end();
  }
  void set(const std::vector<RobotId>& ids) {
    if (ids == m_ids) return;
    m_ids = ids;
    emit changed(m_ids);
  }
  /// With this robot in it, or without, if it was there.
  std::vector<RobotId> toggled(RobotId id) const {
    std::vector<RobotId> ids = m_ids;
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found != ids.end())
      ids.erase(found);
    else
      ids.push_back(id);
    return ids;
  }
  void toggle(RobotId id) { set(toggled(id)); }

  /// The same by a mouse outside of the field, to which the keys then belong: `chosen`.
  void choose(const std::vector<RobotId>& ids) {
    set(ids);
    emit chosen();
  }

  std::optional<RobotId> followed() const { return m_followed; }
  void follow(std::optional<RobotId> id) {
    if (id == m_followed) return;
    m_followed = id;
    emit followedChanged(id);
  }

 signals:
  void changed(const std::vector<pitchboard::RobotId>& ids);
  void followedChanged(std::optional<pitchboard::RobotId> id);
  void chosen();
  // Asked for in one part of the window, opened by another.
  void poseRequested(pitchboard::RobotId id);
  void blackboardRequested(pitchboard::RobotId id);

 private:
  std::vector<RobotId> m_ids;
  std::optional<RobotId> m_followed;
};

}  // namespace pitchboard::ui
