// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one map of keys: shortcuts of all actions of the window, the list in Help, the panel of F1
// and the table in docs/studio.md are made from it. UI thread only.

#include <QString>
#include <span>
#include <vector>

class QAction;
class QWidget;

namespace pitchboard::ui {

struct KeyRow {
  const char* id;     ///< object name of its action; null: only listed (mouse, keys of a panel)
  const char* keys;   ///< portable, with a space between alternatives; of a listed row: as written
  const char* group;  ///< heading in lists
  const char* text = nullptr;   ///< what it does; null: what the action says
  const char* shown = nullptr;  ///< instead of `keys` in lists; empty: not listed
  bool repeats = false;         ///< while the key is held
};

/// How a row reads in a list.
struct KeyLine {
  QString keys, text, group;
};

std::span<const KeyRow> keyRows();

/// Gives the actions of a window their keys, which then work in the whole window, whatever is
/// shown of it and wherever the focus is.
class KeyMap {
 public:
  /// Every action of keyRows() is among the children of the window, which outlives the map.
  explicit KeyMap(QWidget& window);
  /// In the order of keyRows(); then the keys of the published simulator, if wanted.
  std::vector<KeyLine> lines(bool published) const;
  QAction* action(const char* id) const;

 private:
  QWidget& m_window;
};

}  // namespace pitchboard::ui
