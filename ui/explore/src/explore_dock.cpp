// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/explore/explore_dock.h>

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QWidget>
#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/explanation.h>
#include <ui/base/robot_text.h>
#include <ui/base/scrolled_form.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/explore/explorer.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

/// The probability of a goal of each team until a time after the explored moment, with its 95 %
/// band, and a line at the time that the field shows. UI thread only.
class GoalChart : public QWidget {
 public:
  explicit GoalChart(QWidget* parent);
  /// Null: an empty chart. It is read now and not kept.
  void show(const ExploredMoment* found, int second);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Line {
    std::optional<TeamColor> team;
    std::vector<link::Share> shares;
  };
  std::array<Line, 2> m_lines;
  double m_most = 0.1;  // at the upper edge
  int m_second = 0;
};

/// The team's colour; a neutral one if the team is unknown.
QColor teamLineColor(const std::optional<TeamColor>& team) {
  return team ? theme().team(*team) : theme().secondaryText;
}

GoalChart::GoalChart(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("goalChart"));
  setAccessibleName(QStringLiteral("Probability of a goal over time"));
}

QSize GoalChart::sizeHint() const {
  return {scaled(this, 200), scaled(this, 110)};
}

void GoalChart::show(const ExploredMoment* found, int second) {
  m_second = second;
  double most = 0.0;
  for (std::size_t side = 0; side < m_lines.size(); ++side) {
    Line& line = m_lines[side];
    line = {};
    if (found == nullptr) continue;
    line.team = found->teams[side];
    for (const link::ExploredTime& time : found->result.times) {
      line.shares.push_back(side == 0 ? time.goalLeft : time.goalRight);
      most = std::max(most, line.shares.back().high);
    }
  }
  constexpr std::array edges{0.05, 0.1, 0.2, 0.5};
  const auto fits = std::ranges::lower_bound(edges, most);
  m_most = fits == edges.end() ? 1.0 : *fits;
  update();
}

void GoalChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(themeFont(TypeRole::Secondary));
  const QFontMetrics metrics = painter.fontMetrics();
  const QString top = QStringLiteral("%1 %").arg(100.0 * m_most);
  const int left = metrics.horizontalAdvance(QStringLiteral("100 %")) + scaled(this, 4);
  const int below = metrics.height() + scaled(this, 2);
  const QRectF area(left, metrics.height() / 2.0, width() - left - scaled(this, 8),
                    height() - below - metrics.height() / 2.0);
  const auto at = [&](double second, double share) {
    return QPointF(area.left() + area.width() * second / Explorer::seconds,
                   area.bottom() - area.height() * share / m_most);
  };
  painter.fillRect(area, theme().view);
  painter.setPen(theme().innerLine);
  painter.drawRect(area);
  painter.drawLine(at(0, m_most / 2), at(Explorer::seconds, m_most / 2));
  painter.setPen(theme().secondaryText);
  const auto label = [&](double share, const QString& text) {
    painter.drawText(QRectF(0, at(0, share).y() - metrics.height() / 2.0, left - scaled(this, 4),
                            metrics.height()),
                     Qt::AlignRight | Qt::AlignVCenter, text);
  };
  label(m_most, top);
  label(0.0, QStringLiteral("0 %"));
  for (int second = 0; second <= Explorer::seconds; second += 10) {
    const QString text =
        second == Explorer::seconds ? QStringLiteral("%1 s").arg(second) : QString::number(second);
    const double wide = metrics.horizontalAdvance(text);
    const double x = std::min(at(second, 0).x() - wide / 2.0, width() - wide);
    painter.drawText(QPointF(x, height() - metrics.descent()), text);
  }
  for (const Line& line : m_lines) {
    if (line.shares.empty()) continue;
    QPolygonF band, middle;
    for (std::size_t i = 0; i < line.shares.size(); ++i) {
      const auto second = static_cast<double>(i);
      band << at(second, line.shares[i].high);
      middle << at(second, line.shares[i].value);
    }
    for (std::size_t i = line.shares.size(); i-- > 0;) {
      band << at(static_cast<double>(i), line.shares[i].low);
    }
    QColor fill = teamLineColor(line.team);
    painter.setPen(QPen(fill, 1.6));
    painter.drawPolyline(middle);
    fill.setAlphaF(0.22F);
    painter.setPen(Qt::NoPen);
    painter.setBrush(fill);
    painter.drawPolygon(band);
    painter.setBrush(Qt::NoBrush);
  }
  painter.setPen(QPen(theme().accentLine, 1.0));
  painter.drawLine(at(m_second, 0), at(m_second, m_most));
}

namespace {

QString shareText(const link::Share& share) {
  return QStringLiteral("%1 % (%2 to %3)")
      .arg(numberText(100.0 * share.value, 1), numberText(100.0 * share.low, 1),
           numberText(100.0 * share.high, 1));
}

class ExploreDock : public ScrolledForm {
 public:
  ExploreDock(const ExploreDockParts& parts, QWidget* parent)
      : ScrolledForm(parent, 8), m_parts(parts), m_explorer(parts.explorer) {
    addStart(form(), column());
    addResult(form(), column());
    finishForm();
    connect(m_explorer, &Explorer::changed, this, [this] { showAll(); });
    connect(m_parts.shown, &FrameSource::frameReceived, this, [this] { showPossible(); });
    connect(m_parts.shown, &FrameSource::restarted, this, [this] { showPossible(); });
    showAll();
  }

 protected:
  void changeEvent(QEvent* event) override {
    ScrolledForm::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) showAll();
  }
  void showEvent(QShowEvent* event) override {
    ScrolledForm::showEvent(event);
    showPossible();
  }

 private:
  void addStart(QWidget* form, QVBoxLayout* column) {
    m_start = new QPushButton(QStringLiteral("Explore from this moment"), form);
    m_start->setObjectName(QStringLiteral("exploreStart"));
    m_start->setToolTip(QStringLiteral(
        "Plays short games from the moment shown, in the background. Nothing is sent to robots."));
    connect(m_start, &QPushButton::clicked, m_explorer, &Explorer::start);
    column->addWidget(m_start);
    auto* running = new QHBoxLayout;
    m_progress = new QProgressBar(form);
    m_progress->setObjectName(QStringLiteral("exploreProgress"));
    m_progress->setRange(0, 100);
    m_progress->setFormat(QStringLiteral("%p %"));
    running->addWidget(m_progress, 1);
    m_cancel = new QPushButton(QStringLiteral("Cancel"), form);
    m_cancel->setObjectName(QStringLiteral("exploreCancel"));
    connect(m_cancel, &QPushButton::clicked, m_explorer, &Explorer::cancel);
    running->addWidget(m_cancel);
    m_clear = new QPushButton(QStringLiteral("Clear"), form);
    m_clear->setObjectName(QStringLiteral("exploreClear"));
    m_clear->setToolTip(QStringLiteral("Removes the result from the panel and the field"));
    connect(m_clear, &QPushButton::clicked, m_explorer, &Explorer::clear);
    running->addWidget(m_clear);
    column->addLayout(running);
    m_state = makeExplanation({}, form);
    m_state->setObjectName(QStringLiteral("exploreState"));
    column->addWidget(m_state);
  }

  void addResult(QWidget* form, QVBoxLayout* column) {
    m_result = new QWidget(form);
    auto* rows = new QVBoxLayout(m_result);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(scaled(this, 6));
    auto* time = new QHBoxLayout;
    m_slider = new QSlider(Qt::Horizontal, m_result);
    m_slider->setObjectName(QStringLiteral("exploreSecond"));
    m_slider->setAccessibleName(QStringLiteral("Time after the moment"));
    m_slider->setToolTip(QStringLiteral("Shows on the field where the ball may be at this time"));
    m_slider->setRange(0, Explorer::seconds);
    m_slider->setPageStep(5);
    connect(m_slider, &QSlider::valueChanged, m_explorer, &Explorer::showSecond);
    time->addWidget(m_slider, 1);
    m_second = new QLabel(m_result);
    m_second->setObjectName(QStringLiteral("exploreSecondText"));
    m_second->setMinimumWidth(
        m_second->fontMetrics().horizontalAdvance(QStringLiteral("Ball in 30 s")));
    time->addWidget(m_second);
    rows->addLayout(time);
    m_goals = new QLabel(m_result);
    m_goals->setObjectName(QStringLiteral("exploreGoals"));
    m_goals->setWordWrap(true);
    m_goals->setTextFormat(Qt::RichText);
    rows->addWidget(m_goals);
    m_chart = new GoalChart(m_result);
    rows->addWidget(m_chart);
    column->addWidget(m_result);
    m_notes = makeExplanation({}, form);
    m_notes->setObjectName(QStringLiteral("exploreNotes"));
    column->addWidget(m_notes);
  }

  void showPossible() {
    if (!isVisible()) return;  // frames come sixty times a second
    const FramePtr frame = m_parts.shown->frame();
    m_start->setEnabled(frame && !frame->robots.empty());
  }

  void showAll() {
    const bool running = m_explorer->isRunning();
    const ExploredMoment* found = m_explorer->found();
    const bool any = found != nullptr && !found->result.times.empty();
    m_progress->setVisible(running);
    m_cancel->setVisible(running);
    m_clear->setVisible(!running && any);
    m_progress->setValue(static_cast<int>(std::lround(100.0 * m_explorer->progress())));
    m_result->setVisible(any);
    m_notes->setVisible(found != nullptr);
    m_state->setText(stateText(found, any));
    const QSignalBlocker quiet(m_slider);
    m_slider->setValue(m_explorer->second());
    m_second->setText(QStringLiteral("Ball in %1 s").arg(m_explorer->second()));
    if (found != nullptr) {
      QStringList notes;
      for (const std::string& note : found->start.notes) notes << QString::fromStdString(note);
      m_notes->setText(notes.join(QLatin1Char('\n')));
    }
    if (!any) return;
    m_goals->setText(goalText(*found));
    m_chart->show(found, m_explorer->second());
  }

  QString stateText(const ExploredMoment* found, bool any) const {
    if (!m_explorer->problem().isEmpty()) return m_explorer->problem();
    if (found == nullptr) {
      return QStringLiteral(
                 "Shows where the ball may go in the next %1 s, and how likely a goal is.")
          .arg(Explorer::seconds);
    }
    const QString from = momentText(found->time, 2, m_parts.shown->clock());
    if (!any) return QStringLiteral("From %1").arg(from);
    return QStringLiteral("From %1 · %2 rollouts")
        .arg(from, countText(static_cast<qulonglong>(found->result.rollouts)));
  }

  QString goalText(const ExploredMoment& found) const {
    const link::ExploreResult& result = found.result;
    const auto line = [&](std::size_t side) {
      const auto& team = found.teams[side];
      const QString name = team        ? capitalised(info(*team).name)
                           : side == 0 ? QStringLiteral("Left team")
                                       : QStringLiteral("Right team");
      const link::Share& share = side == 0 ? result.last().goalLeft : result.last().goalRight;
      return QStringLiteral("<span style='color:%1'>■</span> %2 scores: %3")
          .arg(teamLineColor(team).name(), name, shareText(share));
    };
    return QStringLiteral("Within %1 s<br>").arg(result.seconds) + line(0) +
           QStringLiteral("<br>") + line(1);
  }

  ExploreDockParts m_parts;
  Explorer* m_explorer;
  QPushButton* m_start;
  QProgressBar* m_progress;
  QPushButton* m_cancel;
  QPushButton* m_clear;
  QLabel* m_state;
  QWidget* m_result;
  QSlider* m_slider;
  QLabel* m_second;
  QLabel* m_goals;
  GoalChart* m_chart;
  QLabel* m_notes;
};

}  // namespace

QWidget* makeExploreDock(const ExploreDockParts& parts, QWidget* parent) {
  return new ExploreDock(parts, parent);
}

}  // namespace pitchboard::ui
