// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for the field view in builds that do not have it.
#include <QImage>

#include <ui/field_view.h>
#include <ui/theme.h>

namespace pitchboard::ui {
struct FieldView::Private {
  std::vector<RobotId> selection;
};
FieldView::FieldView(MatchController*, QWidget* parent)
    : QWidget(parent), d(std::make_unique<Private>()) {
  setFocusPolicy(Qt::StrongFocus);
}
FieldView::~FieldView() = default;
std::vector<RobotId> FieldView::selection() const { return d->selection; }
void FieldView::select(const std::vector<RobotId>& ids) { d->selection = ids; }
std::vector<QAction*> FieldView::layerActions() const { return {}; }
std::vector<QAction*> FieldView::viewActions() const { return {}; }
void FieldView::fitField() {}
void FieldView::setFlipped(bool) {}
bool FieldView::isFlipped() const { return false; }
QImage FieldView::picture(QSize size) const {
  QImage image(size, QImage::Format_RGB32);
  image.fill(theme().grass);
  return image;
}
}  // namespace pitchboard::ui
