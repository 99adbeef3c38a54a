// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/robots/robots_dock.h>

#include <QDockWidget>
#include <QEvent>
#include <QLabel>
#include <QMainWindow>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include <base/angles.h>
#include <ui/base/floating_place.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/live_overlay.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/pose_difference.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

RobotsDock::RobotsDock(const RobotsContext& context, QWidget* parent)
    : QScrollArea(parent), m_context(context) {
  constexpr Beat::Milliseconds least{100}, most{250};
  setObjectName(QStringLiteral("robotCards"));
  setFrameShape(QFrame::NoFrame);
  // A click on a card selects; the keys stay with the field.
  setFocusPolicy(Qt::NoFocus);
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* list = new QWidget(this);
  list->setBackgroundRole(QPalette::Base);
  list->setAutoFillBackground(true);
  viewport()->setBackgroundRole(QPalette::Base);
  m_column = new QVBoxLayout(list);
  const int gap = scaled(this, 4);
  m_column->setContentsMargins(gap, gap, gap, gap);
  m_column->setSpacing(gap);
  m_empty = new QLabel(list);
  m_empty->setObjectName(QStringLiteral("noRobots"));
  m_empty->setFont(themeFont(TypeRole::Secondary));
  m_empty->setForegroundRole(QPalette::PlaceholderText);
  m_empty->setContentsMargins(scaled(this, 8), scaled(this, 8), scaled(this, 8), 0);
  m_empty->setWordWrap(true);
  m_column->addWidget(m_empty);
  m_column->addStretch(1);
  setWidget(list);
  m_dropMark = new QFrame(list);
  m_dropMark->setObjectName(QStringLiteral("dropMark"));
  m_dropMark->setAutoFillBackground(true);
  m_dropMark->hide();
  loadParts();

  m_clock.start();
  const auto refreshSeen = [this] {
    if (isVisible() || !m_floating.empty()) refresh();
  };
  m_refresh = Beat::display().add(nullptr, least, refreshSeen, most);
  connect(context.shown, &FrameSource::frameReceived, this, [this] { m_refresh->want(); });
  connect(context.shown, &FrameSource::restarted, this, [this] {
    m_tracker.reset();
    refresh();
  });
  connect(context.selection, &RobotSelection::changed, this, &RobotsDock::showSelection);
}

QSize RobotsDock::sizeHint() const {
  return {scaled(this, 256), scaled(this, 300)};
}

std::vector<CardState> RobotsDock::states() {
  const FramePtr frame = m_context.shown->frame();
  if (!frame) return {};
  std::vector<CardState> cards = m_tracker.update(*frame, m_clock.elapsed());
  const FramePtr other = m_context.overlay != nullptr ? m_context.overlay->other() : nullptr;
  if (!other) return cards;
  for (CardState& card : cards) {
    if (const link::RobotFrame* robot = frame->robot(card.id)) {
      const auto difference = poseDifference(*other, *robot);
      if (!difference) continue;
      const QString text = differenceText(*difference);
      card.detail = text + QStringLiteral(" · ") + card.detail;
      card.detailTip += QStringLiteral("\nSimulated and live pose differ by %1").arg(text);
      card.values.push_back({QStringLiteral("BELIEF_ERROR"),
                             numberText(difference->metres * 100, 1), QStringLiteral("cm")});
      card.values.push_back({QStringLiteral("BELIEF_ERROR_THETA"),
                             numberText(degreesFromRadians(difference->radians), 1),
                             QStringLiteral("°")});
    }
  }
  return cards;
}

void RobotsDock::refresh() {
  showCards(states());
}

void RobotsDock::showCards(const std::vector<CardState>& states) {
  m_empty->setVisible(states.empty());
  if (states.empty()) m_empty->setText(m_context.shown->emptyText());
  for (auto known = m_cards.begin(); known != m_cards.end();) {
    const RobotUid id = (known++)->first;
    if (std::any_of(states.begin(), states.end(), [id](const auto& s) { return s.id == id; })) {
      continue;
    }
    removeCard(id);
  }
  bool isNew = false;
  for (const CardState& state : states) {
    RobotCard*& card = m_cards[state.id];
    if (card == nullptr) {
      card = makeCard();
      card->setCollapsed(states.size() >= many);
      isNew = true;
    }
    card->setState(state);
    m_places[state.id] = state.order;
    if (std::ranges::find(m_order, state.id) == m_order.end()) {
      const auto isBehind = [&](RobotUid known) { return m_places.at(known) > state.order; };
      m_order.insert(std::ranges::find_if(m_order, isBehind), state.id);
    }
  }
  if (sortCards() || isNew) arrange();
  showSelection();
}

/// Ours first, then by number, until somebody arranges them by hand. Returns whether one moved.
bool RobotsDock::sortCards() {
  const auto listed = [this](RobotUid robot) { return m_places.at(robot); };
  if (m_isArranged || std::ranges::is_sorted(m_order, {}, listed)) return false;
  std::ranges::stable_sort(m_order, {}, listed);
  return true;
}

void RobotsDock::removeCard(RobotUid robot) {
  const auto card = m_cards.find(robot);
  if (card == m_cards.end()) return;
  delete card->second;
  m_cards.erase(card);
  if (!m_isArranged) {
    std::erase(m_order, robot);
    m_places.erase(robot);
  }
  if (const auto window = m_floating.find(robot); window != m_floating.end()) {
    window->second->deleteLater();
    m_floating.erase(window);
  }
}

RobotCard* RobotsDock::makeCard() {
  auto* card = new RobotCard(widget());
  card->setParts(m_parts);
  connect(card, &RobotCard::clicked, this, [this, card](Qt::KeyboardModifiers modifiers) {
    RobotSelection* selection = m_context.selection;
    const RobotUid id = card->state().id;
    m_tracker.looked(id);
    const std::vector<RobotUid> ids =
        modifiers & Qt::ControlModifier ? selection->toggled(id) : std::vector<RobotUid>{id};
    // Keyboard focus stays on the card.
    if (card->hasFocus())
      selection->set(ids);
    else
      selection->choose(ids);
  });
  connect(card, &RobotCard::menuRequested, this,
          [this, card](const QPoint& at) { showMenu(card, at); });
  connect(card, &RobotCard::dragged, this, [this, card](const QPoint& at) { follow(card, at); });
  connect(card, &RobotCard::dropped, this, [this, card](const QPoint& at) { drop(card, at); });
  return card;
}

void RobotsDock::arrange() {
  int place = 0;
  for (const RobotUid id : m_order) {
    const auto card = m_cards.find(id);
    if (card == m_cards.end() || m_floating.count(id) != 0) continue;
    m_column->removeWidget(card->second);
    m_column->insertWidget(place++, card->second);
  }
}

QList<RobotCard*> RobotsDock::cards() const {
  QList<RobotCard*> listed;
  for (const RobotUid id : m_order) {
    const auto card = m_cards.find(id);
    if (card != m_cards.end() && m_floating.count(id) == 0) listed.append(card->second);
  }
  return listed;
}

void RobotsDock::moveCard(RobotUid id, qsizetype place) {
  QList<RobotCard*> listed = cards();
  std::vector<RobotUid> ids;
  for (const RobotCard* card : listed) {
    if (card->state().id != id) ids.push_back(card->state().id);
  }
  const auto at = std::clamp<qsizetype>(place, 0, static_cast<qsizetype>(ids.size()));
  const RobotUid before =
      at < static_cast<qsizetype>(ids.size()) ? ids[static_cast<std::size_t>(at)] : RobotUid{};
  std::erase(m_order, id);
  m_order.insert(std::find(m_order.begin(), m_order.end(), before), id);
  m_isArranged = true;
  arrange();
}

void RobotsDock::follow(RobotCard* card, const QPoint& at) {
  if (m_floating.count(card->state().id) != 0) return;
  if (!viewport()->rect().contains(viewport()->mapFromGlobal(at))) {
    setCursor(Qt::DragCopyCursor);
    m_dropMark->hide();
    return;
  }
  unsetCursor();
  const qsizetype place = placeAt(card, at);
  if (cards().indexOf(card) != place) moveCard(card->state().id, place);
  showDropMark(place);
}

/// The place that the card would have in the list, among the others.
qsizetype RobotsDock::placeAt(RobotCard* card, const QPoint& globalPosition) const {
  const QPoint here = widget()->mapFromGlobal(globalPosition);
  qsizetype place = 0;
  for (const RobotCard* other : cards()) {
    if (other != card && other->geometry().center().y() < here.y()) ++place;
  }
  return place;
}

/// A line where the card that is dragged would go.
void RobotsDock::showDropMark(qsizetype place) {
  QList<RobotCard*> others = cards();
  others.removeIf([](const RobotCard* card) { return card->isDragged(); });
  if (others.isEmpty()) return;
  const int thick = scaled(this, 3), gap = m_column->spacing();
  const QRect beside = others[std::min(place, others.size() - 1)]->geometry();
  const int middle = place < others.size() ? beside.top() - gap / 2 : beside.bottom() + gap / 2;
  m_dropMark->setGeometry(beside.left(), middle - thick / 2, beside.width(), thick);
  QPalette palette = m_dropMark->palette();
  palette.setColor(QPalette::Window, theme().accentLine);
  m_dropMark->setPalette(palette);
  m_dropMark->raise();
  m_dropMark->show();
}

void RobotsDock::drop(RobotCard* card, const QPoint& at) {
  unsetCursor();
  m_dropMark->hide();
  const RobotUid id = card->state().id;
  if (m_floating.count(id) != 0) return;
  if (viewport()->rect().contains(viewport()->mapFromGlobal(at))) return;
  floatCard(id);
  if (QDockWidget* window = floating(id)) window->move(at);
}

QDockWidget* RobotsDock::floating(RobotUid id) const {
  const auto window = m_floating.find(id);
  return window == m_floating.end() ? nullptr : window->second;
}

void RobotsDock::floatCard(RobotUid id) {
  const auto card = m_cards.find(id);
  // Not window(): while this panel floats, that is its dock.
  QMainWindow* main = nullptr;
  for (QWidget* above = this; above != nullptr && main == nullptr; above = above->parentWidget()) {
    main = qobject_cast<QMainWindow*>(above);
  }
  if (card == m_cards.end() || m_floating.count(id) != 0 || main == nullptr) return;
  auto* dock = new QDockWidget(card->second->state().name, main);
  dock->setObjectName(QStringLiteral("card-%1").arg(id.value));
  m_column->removeWidget(card->second);
  dock->setWidget(card->second);
  dock->installEventFilter(this);
  m_floating[id] = dock;
  main->addDockWidget(Qt::LeftDockWidgetArea, dock);
  dock->setFloating(true);
  dock->adjustSize();
  moveBesideTools(dock);
  dock->show();
  card->second->show();
}

bool RobotsDock::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Close) {
    for (const auto& [id, dock] : m_floating) {
      if (dock != watched) continue;
      unfloat(id);
      break;
    }
  }
  return QScrollArea::eventFilter(watched, event);
}

void RobotsDock::unfloat(RobotUid id) {
  QDockWidget* dock = m_floating.at(id);
  m_floating.erase(id);
  RobotCard* card = m_cards.at(id);
  card->setParent(widget());
  arrange();
  card->show();
  dock->deleteLater();
}

void RobotsDock::showSelection() {
  const std::vector<RobotUid>& chosen = m_context.selection->ids();
  for (const auto& [id, card] : m_cards) {
    card->setSelected(m_context.selection->contains(id));
    if (!chosen.empty() && id == chosen.back() && widget()->isAncestorOf(card)) {
      ensureWidgetVisible(card, 0, 0);
    }
  }
}

void RobotsDock::setAllCollapsed(bool collapsed) {
  for (const auto& [id, card] : m_cards) card->setCollapsed(collapsed);
}

QWidget* makeRobotsDock(const RobotsContext& context, QWidget* parent) {
  return new RobotsDock(context, parent);
}

}  // namespace pitchboard::ui
