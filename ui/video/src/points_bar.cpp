// SPDX-License-Identifier: GPL-3.0-or-later
#include "points_bar.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>

#include <ui/base/theme.h>

#include "video_camera.h"

namespace pitchboard::ui {
namespace {

constexpr std::size_t pointsOfField = 4;

}  // namespace

PointsBar::PointsBar(QWidget* parent)
    : QWidget(parent),
      m_choice(new QComboBox(this)),
      m_hint(new QLabel(this)),
      m_clear(new QPushButton(QStringLiteral("Remove points"), this)) {
  m_choice->setObjectName(QStringLiteral("fieldPoint"));
  m_choice->setAccessibleName(QStringLiteral("Point of the field"));
  m_choice->setToolTip(
      QStringLiteral("The point that you click next, as it is on the field panel"));
  m_hint->setObjectName(QStringLiteral("fieldPointHint"));
  m_hint->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  m_clear->setObjectName(QStringLiteral("clearPoints"));
  auto* finished = new QPushButton(QStringLiteral("Done"), this);
  finished->setObjectName(QStringLiteral("pointsDone"));
  auto* row = new QHBoxLayout(this);
  const int gap = scaled(this, 4);
  row->setContentsMargins(gap, 0, gap, gap);
  row->setSpacing(gap);
  row->addWidget(m_choice);
  row->addWidget(m_hint, 1);
  row->addWidget(m_clear);
  row->addWidget(finished);
  connect(finished, &QPushButton::clicked, this, &PointsBar::done);
  connect(m_choice, &QComboBox::currentIndexChanged, this, [this] { emit nextChanged(); });
  connect(m_clear, &QPushButton::clicked, this, [this] {
    if (m_camera == nullptr) return;
    m_camera->setLandmarks({});
    m_choice->setCurrentIndex(0);
    showState();
    emit nextChanged();
  });
}

void PointsBar::start(VideoCamera* camera, const sim::FieldSpec& field) {
  m_camera = camera;
  m_marks = fieldMarks(field);
  {
    const QSignalBlocker quiet(m_choice);
    m_choice->clear();
    for (const FieldMark& mark : m_marks) m_choice->addItem(mark.name);
  }
  goToNext();
  showState();
  emit nextChanged();
}

std::optional<Point> PointsBar::next() const {
  const auto index = static_cast<std::size_t>(std::max(m_choice->currentIndex(), 0));
  const bool isOpen = m_camera != nullptr && m_camera->kept().landmarks.size() < pointsOfField;
  return isOpen && index < m_marks.size() ? std::optional(m_marks[index].place) : std::nullopt;
}

bool PointsBar::isPlaced(const Point& field) const {
  return m_camera != nullptr &&
         std::ranges::any_of(m_camera->kept().landmarks, [&](const telemetry::VideoLandmark& mark) {
           return mark.field == field;
         });
}

/// The first point that is not placed yet, beginning with the corners.
void PointsBar::goToNext() {
  const auto free = std::ranges::find_if(
      m_marks, [this](const FieldMark& mark) { return !isPlaced(mark.place); });
  if (free != m_marks.end()) m_choice->setCurrentIndex(static_cast<int>(free - m_marks.begin()));
}

void PointsBar::place(const Point& picture) {
  const auto field = next();
  if (!field) return;
  auto landmarks = m_camera->kept().landmarks;
  std::erase_if(landmarks,
                [&field](const telemetry::VideoLandmark& mark) { return mark.field == *field; });
  landmarks.push_back({*field, picture});
  m_camera->setLandmarks(std::move(landmarks));
  goToNext();
  showState();
  emit nextChanged();
}

void PointsBar::showState() {
  const auto& landmarks =
      m_camera == nullptr ? std::vector<telemetry::VideoLandmark>() : m_camera->kept().landmarks;
  m_clear->setEnabled(!landmarks.empty());
  const std::size_t count = landmarks.size();
  m_choice->setEnabled(count < pointsOfField);
  m_hint->setText(
      count < pointsOfField
          ? QStringLiteral("Click it in the picture (%1 of 4). Choose another point if it is not "
                           "seen.")
                .arg(count + 1)
      : groundToPicture(landmarks)
          ? QStringLiteral("Drag a point to correct it.")
          : QStringLiteral("These points do not form a field. Drag the one that is wrong."));
  m_hint->setToolTip(m_hint->text());
}

}  // namespace pitchboard::ui
