// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_feed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include <robotlink/frame/match_frame.h>
#include <telemetry/formats/meanings.h>
#include <ui/base/robot_text.h>
#include <ui/base/time_axis.h>
#include <ui/sources/linked_time.h>

#include "derived_series.h"

namespace pitchboard::ui {
namespace {

const QString curvePrefix = QStringLiteral("curve/");
constexpr std::string_view keeperBehaviour = "keeper";
constexpr Beat::Milliseconds mostOften{32}, leastOften{100};  // between two looks

bool isColumn(const std::string& saved, const telemetry::ColumnInfo& column) {
  return column.name == saved || column.name == telemetry::presentName(saved);
}

}  // namespace

PlotFeed::PlotFeed(FrameSource* source, LinkedTime* time, QObject* parent)
    : QObject(parent), m_source(source), m_time(time) {
  constexpr Beat::Milliseconds most{250};
  const auto look = [this] {
    if (m_running) refresh();
  };
  m_refresh = Beat::display().add(nullptr, mostOften, look, most);
  connect(source, &FrameSource::frameReceived, this, &PlotFeed::refreshSoon);
  connect(source, &FrameSource::rowsAppended, this, &PlotFeed::refreshSoon);
  connect(source, &FrameSource::rowsCame, this, look);
  connect(source, &FrameSource::restarted, this, &PlotFeed::forget);
}

PlotFeed::~PlotFeed() = default;

void PlotFeed::setRunning(bool on) {
  if (on == m_running) return;
  m_running = on;
  if (on)
    refresh();
  else
    m_views.clear();  // they keep their rows in memory
}

void PlotFeed::setTimeOfPixel(double seconds) {
  const auto milliseconds = std::clamp(seconds * 1e3, static_cast<double>(mostOften.count()),
                                       static_cast<double>(leastOften.count()));
  m_refresh->setLeast(Beat::Milliseconds(std::lround(milliseconds)));
}

void PlotFeed::refreshSoon() {
  if (m_running) m_refresh->want();
}

void PlotFeed::take(std::shared_ptr<const telemetry::SeriesStore> store) {
  std::erase_if(m_firstOf, [](const auto& one) { return one.first.expired(); });
  if (m_store && !m_first.isEmpty() && !m_robots.isEmpty()) m_firstOf[m_store] = m_first;
  m_store = std::move(store);
  if (const auto before = m_firstOf.find(m_store); before != m_firstOf.end())
    m_first = before->second;
}

void PlotFeed::forget() {
  m_found.clear();
  m_views.clear();
  take(nullptr);
  m_groupNames.clear();
  m_first.clear();
  m_firstAsked.clear();
  ++m_generation;
  ++m_looks;
  if (m_running) refresh();
}

void PlotFeed::refresh() {
  m_refresh->settle();
  const auto store = m_source->series();
  const quint64 revision = store ? store->groupsRevision() : 0;
  if (store != m_store) {
    take(store);
    m_storeRevision = revision;
    m_groupNames = store ? store->groupNames() : std::vector<std::string>();
    m_found.clear();
    ++m_generation;
    ++m_looks;
  } else if (revision != m_storeRevision) {
    m_storeRevision = revision;
    ++m_looks;
    noteNames();
    lookAgain();
  }
  orderRobots();
  findFirst();
  m_rowsRead = m_store ? m_store->pagesRevision() : 0;
  for (const ComparedRows& session : m_compared) m_rowsRead += session.rows->pagesRevision();
  m_views.clear();
  m_namedWorking = false;
  for (auto& [name, curve] : m_named) {
    const bool asked = std::exchange(curve.updated, false);
    m_namedWorking = m_namedWorking || (asked && curve.rows && curve.rows->isWorking());
  }
  m_time->refresh();
  emit refreshed();
}

void PlotFeed::orderRobots() {
  const FramePtr frame = m_source->frame();
  if (!frame) return;
  std::vector<const link::RobotFrame*> robots;
  for (const link::RobotFrame& robot : frame->robots) robots.push_back(&robot);
  const auto isTheirs = [&frame](const link::RobotFrame* robot) {
    return orderOf(robot->key, frame->teams).isTheirs;
  };
  std::ranges::stable_sort(robots, {}, [&](const link::RobotFrame* robot) {
    return std::tuple(isTheirs(robot), robot->behaviour == keeperBehaviour, robot->key);
  });
  QStringList now;
  for (const link::RobotFrame* robot : robots) now << QString::fromStdString(robot->name);
  const qsizetype ours = std::ranges::find_if(robots, isTheirs) - robots.begin();
  if (now == m_robots && ours == m_ours) return;
  m_ours = ours;
  // Chosen before anybody knew who keeps the goal.
  if (m_robots.isEmpty() && !m_firstOf.contains(m_store)) m_first.clear();
  m_robots = std::move(now);
  ++m_looks;
  ++m_generation;  // drawn again in a match that is paused, too
}

std::optional<bool> PlotFeed::isMoving(const QString& group, const QStringList& columns) const {
  constexpr double lately = 5.0;  // s
  const auto all = m_store->range();
  if (!all) return false;
  // Of a recording what comes next, of a source that goes on what came last.
  const auto moment = m_time->shown()->chosenTime();
  const telemetry::TimeRange looked{moment.value_or(all->end - lately),
                                    moment ? *moment + lately : all->end};
  for (const QString& column : columns) {
    const auto id = findVariable(*m_store, group + QLatin1Char('/') + column);
    const auto view = id ? m_store->view(id->group) : nullptr;
    if (!view || view->info().columns[id->column].kind != telemetry::ColumnKind::Number) continue;
    if (!view->hasEveryRow(looked) && view->isReading(looked)) return std::nullopt;
    telemetry::SeriesBucket values;
    view->buckets(id->column, looked, std::span(&values, 1));
    if (values.samples > 0 && values.min < values.max) return true;
  }
  return false;
}

QString PlotFeed::firstGroup(const QStringList& columns) {
  QStringList groups = groupsWith(columns);
  if (groups.isEmpty()) return {};
  const auto rank = [this](const QString& group) {
    const qsizetype place = m_robots.indexOf(group);
    return place < 0 ? m_robots.size() : place;
  };
  // Ours before others (of a simulated match the first team), keepers last, and whoever is at the
  // ball first.
  const FramePtr frame = m_source->frame();
  const auto choice = [&](const QString& group) {
    const qsizetype place = rank(group);
    const bool isTheirs = place >= m_ours;
    if (frame) {
      for (const link::RobotFrame& robot : frame->robots) {
        if (robotName(robot) != group) continue;
        const double far = frame->ballKnown ? distance(robot.pose.position, frame->snapshot.ball)
                           : robot.ball     ? robot.ball->distance
                                            : std::numeric_limits<double>::infinity();
        return std::tuple(isTheirs, robot.key.team, robot.behaviour == keeperBehaviour, far, place);
      }
    }
    return std::tuple(isTheirs, std::numeric_limits<int>::max(), false,
                      std::numeric_limits<double>::infinity(), place);
  };
  std::ranges::stable_sort(groups, {}, choice);
  // Guests give way to the first robot of ours, even if they were received before it.
  if (rank(groups.front()) < m_ours) {
    groups.removeIf([&](const QString& group) { return rank(group) >= m_ours; });
  }
  if (groups.contains(m_first)) return m_first;
  // A robot that was not read yet counts as moving, so that the choice does not depend on the order
  // in which robots are read.
  const auto moving = std::ranges::find_if(
      groups, [&](const QString& group) { return isMoving(group, columns).value_or(true); });
  if (moving == groups.end() || !isMoving(*moving, columns)) {
    if (std::ranges::find(m_firstAsked, columns) == m_firstAsked.end()) {
      m_firstAsked.push_back(columns);
    }
    return groups.front();
  }
  m_first = *moving;
  m_firstAsked.clear();
  ++m_looks;  // others that asked before
  ++m_generation;
  return m_first;
}

void PlotFeed::findFirst() {
  // A robot that is gone leaves its place to another one.
  if (!m_first.isEmpty() && m_store && !m_store->findGroup(m_first.toStdString())) m_first.clear();
  for (const QStringList& columns : std::exchange(m_firstAsked, {})) {
    if (!m_first.isEmpty()) break;
    (void)firstGroup(columns);
  }
}

// A curve stays that of its robot, whatever the robot is called from now on.
void PlotFeed::noteNames() {
  if (!m_store) return;
  const std::vector<std::string> now = m_store->groupNames();
  GroupNames renamed;
  const std::size_t known = m_groupNames.size();
  m_groupNames.resize(now.size());
  for (std::size_t id = 0; id < now.size(); ++id) {
    std::string& before = m_groupNames[id];
    // While two have one name, nobody can say whose a curve of this name is.
    if (now[id] == before || std::ranges::count(now, now[id]) > 1) continue;
    if (id < known && !before.empty() && !now[id].empty()) {
      renamed[QString::fromStdString(before)] = QString::fromStdString(now[id]);
    }
    before = now[id];
  }
  if (renamed.empty()) return;
  if (const auto first = renamed.find(m_first); first != renamed.end()) m_first = first->second;
  m_found.clear();
  ++m_generation;
  emit groupsRenamed(renamed);
}

// A robot that is received for the first time says nothing new of the others: their derived curves
// stay.
void PlotFeed::lookAgain() {
  bool changed = false;
  std::erase_if(m_found, [&](const auto& known) {
    const bool other = findVariable(*m_store, known.first) != known.second;
    changed = changed || other;
    return other;
  });
  // What is waited for may have come.
  if (m_missed || changed) ++m_generation;
  m_missed = false;
}

void PlotFeed::setNamedCurves(const std::map<QString, CurveSpec>& curves) {
  bool changed = false;
  std::erase_if(m_named, [&](const auto& known) {
    const auto now = curves.find(known.first);
    const bool gone = now == curves.end() || !sameData(now->second, known.second.spec);
    changed = changed || gone;
    return gone;
  });
  for (const auto& [name, spec] : curves) {
    if (m_named.contains(name)) continue;
    changed = true;
    Named& made = m_named[name];
    made.spec = spec;
    if (spec.kind != CurveKind::Variable) made.rows = std::make_unique<DerivedSeries>(spec);
  }
  // Only what is made of them has to be computed again.
  if (changed && m_namedAsked) ++m_generation;
}

ColumnView PlotFeed::named(const QString& name) {
  m_namedAsked = true;
  const auto found = m_named.find(name);
  if (found == m_named.end() || found->second.inWork) return {};
  Named& curve = found->second;
  if (!curve.rows) return find(curve.spec.inputs.value(0));
  if (!curve.updated) {
    curve.updated = curve.inWork = true;
    curve.rows->update([this](const QString& input) { return find(input); }, m_generation,
                       m_time->range());
    curve.inWork = false;
  }
  // What is computed from these rows waits for those of the stretch that is shown.
  return curve.rows->isMoving() ? ColumnView{} : curve.rows->view();
}

QStringList PlotFeed::groupsWith(const QStringList& columns) const {
  QStringList groups;
  if (!m_store) return groups;
  for (telemetry::GroupId id = 0; id < m_store->groups(); ++id) {
    const auto view = m_store->view(id);
    if (!view) continue;
    const auto& info = view->info();
    const bool all = std::ranges::all_of(columns, [&](const QString& wanted) {
      return std::ranges::any_of(info.columns, [saved = wanted.toStdString()](const auto& column) {
        return isColumn(saved, column);
      });
    });
    if (all) groups << QString::fromStdString(info.name);
  }
  return groups;
}

QString PlotFeed::presentName(const QString& name) const {
  const auto id = m_store ? findVariable(*m_store, name) : std::nullopt;
  const auto view = id ? m_store->view(id->group) : nullptr;
  if (!view) return name;
  return QString::fromStdString(view->info().name + "/" + view->info().columns[id->column].name);
}

ColumnView PlotFeed::find(const QString& name) {
  if (!m_store) return {};
  if (name.startsWith(curvePrefix)) return named(name.mid(curvePrefix.size()));
  auto known = m_found.find(name);
  if (known == m_found.end()) {
    const auto id = findVariable(*m_store, name);
    if (!id) {
      m_missed = true;
      return {};
    }
    known = m_found.emplace(name, *id).first;
  }
  auto& view = m_views[known->second.group];
  if (!view) view = m_store->view(known->second.group);
  if (!view) return {};
  return {view, known->second.column};
}

void PlotFeed::setCompared(std::vector<ComparedRows> sessions) {
  std::erase_if(sessions, [](const ComparedRows& session) { return session.rows == nullptr; });
  for (ComparedRows& session : sessions) {
    const auto known = std::ranges::find(m_compared, session.id, &ComparedRows::id);
    const bool isSame = known != m_compared.end() && known->rows == session.rows;
    session.generation = isSame ? known->generation : ++m_comparedGeneration;
  }
  m_compared = std::move(sessions);
}

ColumnView PlotFeed::find(const ComparedRows& session, const QString& name) const {
  const auto id = session.isHidden ? std::nullopt : findVariable(*session.rows, name);
  if (!id) return {};
  return {session.rows->view(id->group), id->column};
}

QString PlotFeed::timeText(double time, int decimals) const {
  return momentText(time, decimals, m_clock);
}

QStringList PlotFeed::names() const {
  QStringList all;
  if (!m_store) return all;
  for (telemetry::GroupId group = 0; group < m_store->groups(); ++group) {
    const auto view = m_store->view(group);
    if (!view) continue;
    const QString prefix = QString::fromStdString(view->info().name) + QLatin1Char('/');
    for (const auto& column : view->info().columns) {
      all << prefix + QString::fromStdString(column.name);
    }
  }
  for (const auto& [name, curve] : m_named) all << curvePrefix + name;
  return all;
}

}  // namespace pitchboard::ui
