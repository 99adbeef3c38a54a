// SPDX-License-Identifier: GPL-3.0-or-later
#include "alarms.h"

#include <QApplication>
#include <QEvent>
#include <QMenu>
#include <QPainter>
#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <algorithm>

#include <ui/base/elide_text.h>
#include <ui/base/theme.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

using Kind = link::MatchEventKind;

const QString kindsKey = QStringLiteral("alarms/kinds");
const QString rulesKey = QStringLiteral("alarms/rules");
const QString soundKey = QStringLiteral("alarms/sound");

struct Offer {
  Kind kind;
  const char* text;
};
// What somebody at a match has to act on; a further one is a line here.
constexpr Offer offers[] = {
    {Kind::RobotOffline, "A robot went offline"},
    {Kind::BatteryLow, "A robot's battery is low"},
    {Kind::Penalised, "A robot is penalised"},
    {Kind::Fall, "A robot fell"},
    {Kind::ProcessDied, "A process died"},
    {Kind::ProcessNotResponding, "A process stopped responding"},
    {Kind::RefereeOffline, "The referee went offline"},
    {Kind::SecondSender, "Two programs send as one robot"},
    {Kind::PortLost, "A port cannot be opened"},
    {Kind::PortsShared, "Another program receives on the robots' ports"},
    {Kind::Goal, "A goal"},
};

}  // namespace

/// A red edge with the reason on a plate, which stays a little longer. Lets the mouse through.
class AlarmFrame : public QWidget {
 public:
  explicit AlarmFrame(QWidget* host) : QWidget(host) {
    setObjectName(QStringLiteral("alarmFrame"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    host->installEventFilter(this);
    hide();
    m_edge.setSingleShot(true);
    m_plate.setSingleShot(true);
    connect(&m_edge, &QTimer::timeout, this, qOverload<>(&QWidget::update));
    connect(&m_plate, &QTimer::timeout, this, &QWidget::hide);
  }
  void raiseWith(const QString& sentence) {
    setAccessibleName(sentence);
    setGeometry(parentWidget()->rect());
    show();
    raise();
    update();
    m_edge.start(edgeMilliseconds);
    m_plate.start(plateMilliseconds);
  }
  bool hasEdge() const { return isVisible() && m_edge.isActive(); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Resize) setGeometry(parentWidget()->rect());
    return QWidget::eventFilter(watched, event);
  }
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (m_edge.isActive()) {
      const double wide = scaled(this, 6);
      painter.setPen(QPen(theme().errorText, wide));
      painter.drawRect(QRectF(rect()).adjusted(wide / 2, wide / 2, -wide / 2, -wide / 2));
    }
    const QFont font = themeFont(TypeRole::Body, true);
    const QFontMetricsF metrics(font);
    const double most = width() - scaled(this, 64);
    const QString text = elideText(metrics, accessibleName(), most);
    QRectF plate(0, scaled(this, 44), metrics.horizontalAdvance(text) + scaled(this, 24),
                 scaled(this, 28));
    plate.moveLeft((width() - plate.width()) / 2);
    painter.setPen(theme().errorText);
    painter.setBrush(theme().errorGround);
    painter.drawRoundedRect(plate, 3, 3);
    painter.setFont(font);
    painter.setPen(theme().text);
    painter.drawText(plate, Qt::AlignCenter, text);
  }

 private:
  static constexpr int edgeMilliseconds = 1500, plateMilliseconds = 5000;
  QTimer m_edge, m_plate;
};

Alarms::Alarms(ShownMoment* sources, QWidget* field, QSettings* settings, QObject* parent)
    : QObject(parent),
      m_frame(new AlarmFrame(field)),
      m_settings(settings),
      m_ring(&QApplication::beep) {
  if (settings != nullptr) {
    for (const QString& name : settings->value(kindsKey).toStringList()) {
      if (const auto kind = link::matchEventKind(name.toStdString())) m_chosen.insert(*kind);
    }
    m_rules = settings->value(rulesKey, true).toBool();
    m_sound = settings->value(soundKey).toBool();
  }
  for (FrameSource* source : sources->sources()) {
    connect(source, &FrameSource::eventsReceived, this, &Alarms::take);
    connect(source, &FrameSource::rewound, m_frame, &QWidget::hide);
  }
}

bool Alarms::isRaised() const {
  return m_frame->hasEdge();
}

void Alarms::keep() {
  if (m_settings == nullptr) return;
  QStringList names;
  for (const Kind kind : m_chosen) {
    const std::string_view name = link::info(kind).name;
    names << QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
  }
  m_settings->setValue(kindsKey, names);
  m_settings->setValue(rulesKey, m_rules);
  m_settings->setValue(soundKey, m_sound);
}

void Alarms::fill(QMenu* menu) {
  for (const Offer& offer : offers) {
    QAction* action = menu->addAction(QString::fromUtf8(offer.text));
    action->setCheckable(true);
    action->setChecked(m_chosen.contains(offer.kind));
    connect(action, &QAction::toggled, this, [this, kind = offer.kind](bool on) {
      if (on)
        m_chosen.insert(kind);
      else
        m_chosen.erase(kind);
      keep();
    });
  }
  QAction* rules = menu->addAction(QStringLiteral("A rule of severity error is broken"));
  rules->setCheckable(true);
  rules->setChecked(m_rules);
  connect(rules, &QAction::toggled, this, [this](bool on) {
    m_rules = on;
    keep();
  });
  menu->addSeparator();
  QAction* sound = menu->addAction(QStringLiteral("Play a sound"));
  sound->setCheckable(true);
  sound->setChecked(m_sound);
  connect(sound, &QAction::toggled, this, [this](bool on) {
    m_sound = on;
    keep();
    if (on) m_ring();
  });
}

void Alarms::take(const std::vector<link::MatchEvent>& events) {
  const auto first = std::find_if(events.begin(), events.end(), [this](const auto& event) {
    return m_chosen.contains(event.kind);
  });
  if (first == events.end()) return;
  const auto all = std::count_if(
      first, events.end(), [this](const auto& event) { return m_chosen.contains(event.kind); });
  QString sentence = QString::fromStdString(sentenceOf(*first));
  if (all > 1) sentence += QStringLiteral(" (and %1 more)").arg(all - 1);
  raise(sentence);
}

void Alarms::raiseForRule(const QString& sentence) {
  if (m_rules) raise(sentence);
}

void Alarms::raise(const QString& sentence) {
  m_frame->raiseWith(sentence);
  QApplication::alert(m_frame->parentWidget()->window());
  if (m_sound) m_ring();
}

}  // namespace pitchboard::ui
