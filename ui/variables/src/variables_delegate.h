// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Paints stars and sparklines, and edits values: a value that cannot be is refused beside the
// editor, which stays open until it is mended or left with Escape.

#include <QStyledItemDelegate>

namespace pitchboard::ui {

class VariablesDelegate : public QStyledItemDelegate {
  Q_OBJECT
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  /// The name in a room of so many pixels: in little room it leaves out the heading that it stands
  /// under, BALL_DIST of Vision.
  static QString nameFor(const QModelIndex& index, const QFont& font, double room);
  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const override;
  void setEditorData(QWidget* editor, const QModelIndex& index) const override;
  void setModelData(QWidget* editor, QAbstractItemModel* model,
                    const QModelIndex& index) const override;
  void updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                            const QModelIndex& index) const override;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// Words of a code that are wider than their column go on over the sparkline.
  bool flowsOver(const QStyleOptionViewItem& option, const QModelIndex& index) const;
  void paintFlowing(QPainter* painter, const QStyleOptionViewItem& option,
                    const QModelIndex& index) const;
  void paintPlain(QPainter* painter, const QStyleOptionViewItem& option,
                  const QModelIndex& index) const;
  void paintSpark(QPainter* painter, const QStyleOptionViewItem& option,
                  const QModelIndex& index) const;
};

}  // namespace pitchboard::ui
