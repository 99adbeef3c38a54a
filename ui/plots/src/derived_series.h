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
  /// before holds. `shown`: where rows are wanted, in case the inputs are larger than memory.
  void update(const Lookup& find, quint64 generation, telemetry::TimeRange shown);
  /// What is ready; nothing while an input is missing or the description is wrong.
  ColumnView view() const;
  /// Inputs that there are not, by name.
  const QStringList& missing() const { return m_missing; }
  /// A sentence for the legend when there is nothing to see although nothing is missing.
  QString note() const { return m_note; }
  /// The description can never work: an expression with an error.
  bool isFaulty() const;
  /// Rows are still being computed.
  bool isWorking() const;
  /// Another stretch of a session that is larger than memory is being computed.
  bool isMoving() const { return m_next != nullptr; }

 private:
  struct Work;
  std::shared_ptr<Work> fresh(quint64 generation) const;
  bool takeStretch(const std::vector<ColumnView>& views, telemetry::TimeRange shown);
  void start(std::vector<ColumnView> views, double until);

  std::shared_ptr<Work> m_work;
  std::shared_ptr<Work> m_next;  // of another stretch; takes the place of m_work once it is done
  QString m_note;
  QStringList m_missing;
};

}  // namespace pitchboard::ui
