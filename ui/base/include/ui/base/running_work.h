// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The work that ends if the studio is closed, such as an experiment or a recording: who does it
// adds it here, and the window asks before it closes. UI thread only; owned by the window.

#include <QObject>
#include <QPointer>
#include <QString>
#include <QStringList>
#include <functional>
#include <utility>
#include <vector>

namespace pitchboard::ui {

class RunningWork {
 public:
  /// Returns a sentence that says what runs and what becomes of it when the studio closes; empty
  /// while nothing runs.
  using Describe = std::function<QString()>;

  /// `describe` is called as long as `owner` exists.
  void add(const QObject* owner, Describe describe) {
    m_parts.emplace_back(owner, std::move(describe));
  }
  /// Returns the sentences about everything that runs.
  QStringList sentences() const {
    QStringList all;
    for (const auto& [owner, describe] : m_parts) {
      const QString sentence = owner ? describe() : QString();
      if (!sentence.isEmpty()) all << sentence;
    }
    return all;
  }

 private:
  std::vector<std::pair<QPointer<const QObject>, Describe>> m_parts;
};

}  // namespace pitchboard::ui
