// SPDX-License-Identifier: GPL-3.0-or-later
#include "stretch_bar.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <algorithm>
#include <map>
#include <set>

#include <robotlink/session/session_events.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

constexpr int rangeDecimals = 2;
constexpr std::size_t mostDetails = 12;  // of a kind of event; more are no choice

/// Offers the kinds of events that there are when it opens; others can be typed.
class EventBox : public QComboBox {
 public:
  EventBox(StretchBar* bar, const char* name, const QString& event) : QComboBox(bar), m_bar(bar) {
    setObjectName(QLatin1String(name));
    setEditable(true);
    setInsertPolicy(QComboBox::NoInsert);
    setMinimumContentsLength(11);
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    setToolTip(QStringLiteral("An event, such as goal or referee:PLAYING (kind:detail)"));
    setCurrentText(event);
  }
  void showPopup() override {
    fill();
    QComboBox::showPopup();
  }

 private:
  void fill() {
    std::map<std::string, std::set<std::string>> kinds;
    for (const telemetry::SessionEvent& event : m_bar->events()) {
      auto& details = kinds[event.kind];
      if (event.facts && !event.facts->detail.empty()) details.insert(event.facts->detail);
    }
    const QString text = currentText();
    const QSignalBlocker quiet(this);
    clear();
    for (const auto& [kind, details] : kinds) {
      addItem(QString::fromStdString(kind));
      if (details.size() > mostDetails) continue;
      for (const std::string& detail : details) {
        addItem(QString::fromStdString(kind + ":" + detail));
      }
    }
    setCurrentIndex(findText(text));
    setCurrentText(text);
  }

  StretchBar* m_bar;
};

}  // namespace

StretchBar::StretchBar(ShownMoment* shown, QWidget* parent)
    : QWidget(parent),
      m_shown(shown),
      m_kind(new QComboBox(this)),
      m_first(new EventBox(this, "statisticsFirstEvent", QStringLiteral("referee:PLAYING"))),
      m_to(new QLabel(QStringLiteral("to"), this)),
      m_last(new EventBox(this, "statisticsLastEvent", QStringLiteral("goal"))),
      m_condition(new QLineEdit(this)) {
  m_kind->setObjectName(QStringLiteral("statisticsStretch"));
  m_kind->setAccessibleName(QStringLiteral("Stretch"));
  m_kind->addItems({QStringLiteral("Selected range"), QStringLiteral("A to B"),
                    QStringLiteral("Everything"), QStringLiteral("Between events")});
  m_kind->setToolTip(QStringLiteral(
      "Part of the time that is described. Drag in the timeline with Shift to select a range"));
  auto* holds = new QLabel(QStringLiteral("while"), this);
  m_condition->setObjectName(QStringLiteral("statisticsWhile"));
  m_condition->setAccessibleName(QStringLiteral("Condition"));
  m_condition->setPlaceholderText(QStringLiteral("always; or e.g. VISION_BALL_DIST < 100"));
  m_condition->setToolTip(
      QStringLiteral("Only samples at which this expression holds. A name without a robot is that "
                     "of each robot"));
  m_condition->setClearButtonEnabled(true);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(scaled(this, 4));
  for (QWidget* part : std::initializer_list<QWidget*>{m_kind, m_first, m_to, m_last, holds}) {
    row->addWidget(part);
  }
  row->addWidget(m_condition, 1);
  connect(m_kind, &QComboBox::currentIndexChanged, this, [this] {
    showKind();
    emit changed();
  });
  for (QComboBox* box : {m_first, m_last}) {
    connect(box, &QComboBox::activated, this, &StretchBar::changed);
    connect(box->lineEdit(), &QLineEdit::editingFinished, this, &StretchBar::changed);
  }
  const auto apply = [this] {
    if (std::exchange(m_applied, condition()) != condition()) emit changed();
  };
  connect(m_condition, &QLineEdit::editingFinished, this, apply);
  connect(m_condition, &QLineEdit::textChanged, this, [this, apply] {
    if (m_condition->text().isEmpty()) apply();
  });
  showKind();
}

StretchBar::Kind StretchBar::kind() const {
  return static_cast<Kind>(m_kind->currentIndex());
}

void StretchBar::showKind() {
  for (QWidget* part : std::initializer_list<QWidget*>{m_first, m_to, m_last}) {
    part->setVisible(kind() == Kind::Events);
  }
}

std::optional<telemetry::TimeRange> StretchBar::range() const {
  if (kind() == Kind::Selection) return m_shown->selection();
  if (kind() != Kind::Marks || !m_shown->hasMarks()) return {};
  const double a = *m_shown->mark(TimeMark::A), b = *m_shown->mark(TimeMark::B);
  return telemetry::TimeRange{std::min(a, b), std::max(a, b)};
}

std::optional<std::pair<std::string, std::string>> StretchBar::between() const {
  if (kind() != Kind::Events) return {};
  return std::pair(m_first->currentText().trimmed().toStdString(),
                   m_last->currentText().trimmed().toStdString());
}

QString StretchBar::condition() const {
  return m_condition->text().trimmed();
}

void StretchBar::setCondition(const QString& text) {
  m_applied = text;
  m_condition->setText(text);
}

QString StretchBar::text() const {
  const auto range = this->range();
  QString text;
  if (range) {
    text = QStringLiteral("%1 to %2")
               .arg(momentText(range->begin, rangeDecimals, m_shown->clock()),
                    momentText(range->end, rangeDecimals, m_shown->clock()));
  } else if (kind() == Kind::Selection) {
    text = QStringLiteral("Everything, because no range is selected");
  } else if (kind() == Kind::Marks) {
    text = QStringLiteral("Everything, because A and B are not set");
  } else if (kind() == Kind::Events) {
    text = QStringLiteral("From each %1 to the next %2")
               .arg(m_first->currentText().trimmed(), m_last->currentText().trimmed());
  } else {
    text = QStringLiteral("Everything");
  }
  return condition().isEmpty() ? text : text + QStringLiteral(", while %1").arg(condition());
}

std::vector<telemetry::SessionEvent> StretchBar::events() const {
  std::vector<telemetry::SessionEvent> out;
  const EventList* events = m_shown->events();
  if (events == nullptr) return out;
  for (const link::MatchEvent& event : events->events()) out.push_back(link::sessionEvent(event));
  return out;
}

}  // namespace pitchboard::ui
