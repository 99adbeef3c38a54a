// SPDX-License-Identifier: GPL-3.0-or-later
#include "align_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include <ui/base/number_box.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

/// "0.36 s per hour slow": how the camera's clock differs, or how slowly it plays.
QString driftText(double rate) {
  constexpr double hour = 3600.0, slowMotion = 0.02;
  if (std::abs(rate - 1.0) > slowMotion) return QStringLiteral("plays at ×%1").arg(rate, 0, 'f', 3);
  const double seconds = (rate - 1.0) * hour;
  return QStringLiteral("clock %1 s per hour %2")
      .arg(std::abs(seconds), 0, 'f', 2)
      .arg(seconds >= 0.0 ? QStringLiteral("slow") : QStringLiteral("fast"));
}

}  // namespace

AlignBar::AlignBar(ShownMoment* shown, QWidget* parent)
    : QWidget(parent),
      m_shown(shown),
      m_slider(new QSlider(Qt::Horizontal, this)),
      m_place(new QLabel(this)),
      m_same(new QPushButton(QStringLiteral("This picture is this moment"), this)),
      m_second(new QPushButton(QStringLiteral("Add as second moment"), this)),
      m_clock(new QPushButton(QStringLiteral("Use camera clock"), this)),
      m_begin(new NumberBox(this)),
      m_drift(new QLabel(this)) {
  makeRows();
  connect(m_slider, &QSlider::valueChanged, this, [this] {
    showState();
    emit indexChanged();
  });
  connect(m_same, &QPushButton::clicked, this, [this] { declare(false); });
  connect(m_second, &QPushButton::clicked, this, [this] { declare(true); });
  connect(m_clock, &QPushButton::clicked, this, [this] {
    if (const auto begin = beginByClock(*m_camera, *m_shown)) emit aligned({{*begin, 0.0}});
  });
  connect(m_begin, &QDoubleSpinBox::valueChanged, this, &AlignBar::shiftTo);
  connect(shown, &ShownMoment::moved, this, &AlignBar::showState);
}

void AlignBar::makeRows() {
  m_slider->setObjectName(QStringLiteral("videoPosition"));
  m_slider->setAccessibleName(QStringLiteral("Position in the video"));
  m_slider->setToolTip(QStringLiteral("Goes through the video while the session stands still"));
  m_place->setObjectName(QStringLiteral("videoPlace"));
  m_place->setFont(themeFont(TypeRole::Secondary));
  m_same->setObjectName(QStringLiteral("videoSameMoment"));
  m_second->setObjectName(QStringLiteral("videoSecondMoment"));
  m_second->setToolTip(QStringLiteral(
      "Corrects a camera whose clock runs fast or slow: choose a moment far from the first one"));
  m_clock->setObjectName(QStringLiteral("videoClock"));
  m_begin->setObjectName(QStringLiteral("videoBegin"));
  m_begin->setAccessibleName(QStringLiteral("Start of the video"));
  m_begin->setPrefix(QStringLiteral("starts at "));
  m_begin->setSuffix(QStringLiteral(" s"));
  m_begin->setDecimals(3);
  m_begin->setSingleStep(0.01);
  m_begin->setRange(-1e7, 1e7);
  m_begin->setToolTip(
      QStringLiteral("Moment of the session at the first picture. Arrow keys shift it by 10 ms"));
  m_drift->setObjectName(QStringLiteral("videoDrift"));
  m_drift->setFont(themeFont(TypeRole::Secondary));
  auto* finished = new QPushButton(QStringLiteral("Done"), this);
  finished->setObjectName(QStringLiteral("alignDone"));
  connect(finished, &QPushButton::clicked, this, &AlignBar::done);
  const auto stepper = [this](const char* icon, const char* tip, int pictures) {
    auto* button = new QToolButton(this);
    button->setIcon(themedIcon(QLatin1String(icon)));
    button->setToolTip(QString::fromUtf8(tip));
    button->setAccessibleName(button->toolTip());
    button->setAutoRepeat(true);
    button->setAutoRaise(true);
    connect(button, &QToolButton::clicked, this, [this, pictures] { step(pictures); });
    return button;
  };
  const int gap = scaled(this, 4);
  auto* scrub = new QHBoxLayout;
  scrub->setSpacing(gap);
  scrub->addWidget(stepper("go-previous", "Previous picture", -1));
  scrub->addWidget(m_slider, 1);
  scrub->addWidget(stepper("go-next", "Next picture", 1));
  scrub->addWidget(m_place);
  scrub->addWidget(m_drift);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(gap);
  buttons->addWidget(m_same);
  buttons->addWidget(m_second);
  buttons->addWidget(m_clock);
  buttons->addWidget(m_begin);
  buttons->addStretch(1);
  buttons->addWidget(finished);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(gap, 0, gap, gap);
  column->setSpacing(gap);
  column->addLayout(scrub);
  column->addLayout(buttons);
}

void AlignBar::start(VideoCamera* camera) {
  if (m_camera != nullptr) m_camera->disconnect(this);
  m_camera = camera;
  if (camera == nullptr || camera->times().empty()) return showState();
  connect(camera, &VideoCamera::alignmentChanged, this, &AlignBar::showState);
  {
    const QSignalBlocker quiet(m_slider);
    m_slider->setRange(0, static_cast<int>(camera->times().size()) - 1);
    m_slider->setPageStep(qRound(std::max(camera->info()->picturesPerSecond, 1.0)));
    m_slider->setValue(static_cast<int>(camera->wanted()));
  }
  showState();
  emit indexChanged();
}

std::size_t AlignBar::index() const {
  return static_cast<std::size_t>(m_slider->value());
}

void AlignBar::step(int pictures) {
  m_slider->setValue(m_slider->value() + pictures);
}

std::optional<double> AlignBar::beginByClock(const VideoCamera& camera, const ShownMoment& shown) {
  const auto clock = shown.source()->clock();
  if (camera.info() == nullptr || !camera.info()->created || !clock) return {};
  const auto created = std::chrono::duration_cast<std::chrono::milliseconds>(
      camera.info()->created->time_since_epoch());
  return static_cast<double>(created.count() - clock->toMSecsSinceEpoch()) / 1000.0;
}

telemetry::VideoAnchor AlignBar::here() const {
  return {m_shown->time(), m_camera->times()[index()]};
}

void AlignBar::declare(bool isSecond) {
  if (m_camera == nullptr || m_camera->times().empty()) return;
  const auto& anchors = m_camera->kept().anchors;
  if (isSecond && !anchors.empty()) {
    emit aligned({anchors.front(), here()});
  } else {
    emit aligned({here()});
  }
}

void AlignBar::shiftTo(double begin) {
  if (m_camera != nullptr) emit shifted(m_camera->anchorsFrom(begin));
}

void AlignBar::showState() {
  const bool isReady = m_camera != nullptr && !m_camera->times().empty();
  for (QWidget* widget : std::initializer_list<QWidget*>{m_slider, m_same, m_begin}) {
    widget->setEnabled(isReady);
  }
  if (!isReady) return;
  const telemetry::VideoAnchor now = here();
  m_place->setText(QStringLiteral("%1 · picture %2 of %3")
                       .arg(momentText(now.video, 3))
                       .arg(index() + 1)
                       .arg(m_camera->times().size()));
  const auto& anchors = m_camera->kept().anchors;
  m_same->setToolTip(QStringLiteral("Shows the picture at %1 of the video at %2 of the session")
                         .arg(momentText(now.video, 3), momentText(now.session, 3)));
  m_second->setEnabled(!anchors.empty());
  const bool hasClocks = beginByClock(*m_camera, *m_shown).has_value();
  m_clock->setEnabled(hasClocks);
  m_clock->setToolTip(
      hasClocks ? QStringLiteral("Aligns by the time of day at which the file says it began")
                : QStringLiteral("The file does not say when it was recorded, or the session "
                                 "has no time of day"));
  {
    const QSignalBlocker quiet(m_begin);
    m_begin->setValue(m_camera->alignment().offset);
  }
  m_drift->setText(anchors.size() == 2 ? driftText(m_camera->alignment().rate) : QString());
}

}  // namespace pitchboard::ui
