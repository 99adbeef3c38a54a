// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The rows of a derived curve. Computed from the rows of its inputs on a worker thread, each row
// once, and kept in a series store of its own, so that drawing and statistics treat it like any
// other column. UI thread only.

#include <functional>
#include <memory>

#include <ui/plots/plot_layout.h>

#include "plot_feed.h"

namespace pitchboard::ui {

class DerivedSeries {
 public:
  explicit DerivedSeries(const CurveSpec& spec);
  ~DerivedSeries();
  DerivedSeries(const DerivedSeries&) = delete;
  DerivedSeries& operator=(const DerivedSeries&) = delete;

  /// Gives the rows of a variable, or nothing.
  using Lookup = std::function<ColumnView(const QString&)>;
  /// Starts work on what is new; never waits for it. With another generation nothing that was found
  /// before holds.
  void update(const Lookup& find, quint64 generation);
  /// What is ready; nothing while an input is missing or the description is wrong.
  ColumnView view() const;
  /// A sentence for the legend when there is nothing to see.
  QString note() const { return m_note; }
  /// The description can never work: an expression with an error.
  bool isFaulty() const;
  /// Rows are still being computed.
  bool isWorking() const;

 private:
  struct Work;
  std::shared_ptr<Work> m_work;
  QString m_note;
};

}  // namespace pitchboard::ui
