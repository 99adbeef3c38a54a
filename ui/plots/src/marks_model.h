// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The table beside the plots: what each curve is at A and at B, and what it does between them.

#include <QAbstractTableModel>
#include <QColor>
#include <QList>
#include <optional>

#include "curve.h"

namespace pitchboard::ui {

struct MarksRow {
  QString name;
  QString unit;
  QColor color;
  std::optional<double> a, b;           ///< the last sample at or before the mark
  telemetry::SeriesStatistics between;  ///< no samples: nothing lies between
  QString aText, bText;                 ///< labels of codes; empty for numbers
  QString session = {};                 ///< caption of the compared session; empty: of none
  bool operator==(const MarksRow&) const;
};

class MarksModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Name, AtA, AtB, Delta, Mean, Sigma, Min, Max, Rms, columns };
  using QAbstractTableModel::QAbstractTableModel;

  void setRows(QList<MarksRow> rows);
  const QList<MarksRow>& rows() const { return m_rows; }
  /// The table as text with tabs, with a first line of headings.
  QString text() const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  QString cell(const MarksRow& row, int column) const;
  QList<MarksRow> m_rows;
};

/// Of a curve, between the earlier and the later mark, or over `measured` instead.
MarksRow marksRow(const Curve& curve, double a, double b,
                  std::optional<telemetry::TimeRange> measured = {});
/// The same of a curve in a compared session, or over all of that session; nothing where it has
/// none, or is hidden.
std::optional<MarksRow> marksRow(const Curve& curve, const ComparedRows& session, double a,
                                 double b, bool isWhole);

}  // namespace pitchboard::ui
