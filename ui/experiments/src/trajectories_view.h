// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The ways of robots and ball on the field in the first runs of a condition, as the published
// figure 5 shows them; of one run or of two to compare, when they are chosen. Metres. UI thread.

#include <QWidget>
#include <vector>

#include "experiment_play.h"

namespace pitchboard::ui {

class TrajectoriesView : public QWidget {
 public:
  explicit TrajectoriesView(QWidget* parent);

  void show(const PlayedPtr& played, std::size_t condition);
  /// Runs that stand out; the others stay faint. Empty: all are alike.
  void highlight(std::vector<std::size_t> numbers);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  PlayedPtr m_played;
  std::size_t m_condition = 0;
  std::vector<std::size_t> m_highlighted;
};

}  // namespace pitchboard::ui
