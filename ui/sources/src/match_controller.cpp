// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/match_controller.h>

#include <algorithm>
#include <map>

#include <robotlink/processes/process_manager.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/state_archive.h>
#include <ui/base/robot_text.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/retired_match.h>

namespace pitchboard::ui {
namespace {

using CatalogPtr = std::shared_ptr<const link::VariableCatalog>;

// A match refers to its catalog until its thread has ended.
struct RunnerWithCatalog {
  CatalogPtr catalog;
  std::unique_ptr<link::MatchRunner> runner;
};

std::shared_ptr<link::MatchRunner> holding(CatalogPtr catalog,
                                           std::unique_ptr<link::MatchRunner> runner) {
  const auto both =
      std::make_shared<RunnerWithCatalog>(RunnerWithCatalog{std::move(catalog), std::move(runner)});
  return {both, both->runner.get()};
}

}  // namespace

MatchController::MatchController(link::MatchOptions options, QObject* parent)
    : FrameSource(parent),
      m_options(std::move(options)),
      m_nextCatalog(&link::VariableCatalog::published(), [](const auto*) {}),
      m_catalog(m_nextCatalog),
      m_news(Beat::display().addSource([this] { poll(); })),
      m_edits(new MatchEdits(this)),
      m_memory(new MatchMemory(this)) {
  connect(m_edits, &MatchEdits::failed, this, &MatchController::refuse);
  connect(m_memory, &MatchMemory::failed, this, &MatchController::refuse);
}

// Runners' commands and the worker post back to this object: they must be gone while it is whole.
MatchController::~MatchController() {
  ++m_generation;
  m_runner.reset();
  m_worker.waitForDone();
}

struct MatchController::Opening {
  std::shared_ptr<link::MatchRunner> runner;
  link::Cognition cognition = link::Cognition::Inline;
  QString error;  // of a match that plays otherwise than asked for, or not at all

  /// `observers` see the match from its first tick.
  void start(const link::Scenario& scenario, const link::MatchOptions& options, bool paused,
             CatalogPtr catalog, const std::vector<std::shared_ptr<link::TickObserver>>& observers);
  /// The same from a moment of it, paused; `observers` do not see the beginning again.
  void resume(const link::Moment& moment, const link::Scenario& scenario,
              const link::MatchOptions& options, CatalogPtr catalog,
              const std::vector<std::shared_ptr<link::TickObserver>>& observers);
};

void MatchController::Opening::start(
    const link::Scenario& scenario, const link::MatchOptions& options, bool paused,
    CatalogPtr catalog, const std::vector<std::shared_ptr<link::TickObserver>>& observers) {
  const auto textOf = [](const Error& reason) { return QString::fromStdString(reason.text()); };
  cognition = options.cognition;
  auto made = link::MatchRunner::start(scenario, options, paused, *catalog, observers);
  if (!made && options.cognition != link::Cognition::Inline) {
    const Error reason = made.error();
    link::MatchOptions inside = options;
    inside.cognition = cognition = link::Cognition::Inline;
    inside.systemV = false;
    inside.runtime = {};
    made = link::MatchRunner::start(scenario, inside, paused, *catalog, observers);
    if (made) {
      error = QStringLiteral(
                  "Cannot run separate robot processes: %1. They run inside the studio instead, "
                  "and other programs cannot open their blackboards. %2, then restart the match.")
                  .arg(textOf(reason), reason.code == ErrorCode::Conflict
                                           ? QStringLiteral("Close the other program")
                                           : QStringLiteral("Fix this"));
    }
  }
  if (made)
    runner = holding(std::move(catalog), std::move(*made));
  else
    error = QStringLiteral("Cannot play the match: %1").arg(textOf(made.error()));
}

void MatchController::Opening::resume(
    const link::Moment& moment, const link::Scenario& scenario, const link::MatchOptions& options,
    CatalogPtr catalog, const std::vector<std::shared_ptr<link::TickObserver>>& observers) {
  start(scenario, options, true, std::move(catalog), {});
  if (!runner) return;
  runner->execute([&](link::SimulatedMatch& match) {
    if (const auto restored = match.restore(moment); !restored) {
      error = QStringLiteral("Cannot continue the match where it was: %1")
                  .arg(QString::fromStdString(restored.error().text()));
    }
    return link::Changed::Yes;
  });
  for (const auto& observer : observers) runner->observe(observer);
}

std::shared_ptr<const telemetry::SeriesStore> MatchController::series() const {
  return m_memory->series();
}

FramePtr MatchController::frameAt(double time) const {
  return m_memory->frameAt(time);
}

bool MatchController::observe(const std::shared_ptr<link::TickObserver>& observer) {
  if (!m_runner) return false;
  m_runner->observe(observer);
  return true;
}

void MatchController::stopObserving(const std::shared_ptr<link::TickObserver>& observer) {
  if (m_runner) m_runner->stopObserving(observer);
}

QString MatchController::emptyText() const {
  if (isOpening()) return QStringLiteral("Opening…");
  if (isOpen()) return QStringLiteral("No robots on the field.\nRight-click the field to add one.");
  return m_whyNotOpened.isEmpty()
             ? QStringLiteral("No match is open.\nChoose a scenario in the tool bar.")
             : QStringLiteral("The match could not be opened.\nTry again, or choose a scenario.");
}

std::shared_ptr<link::MatchRunner> MatchController::retire() {
  if (m_runner) emit ending();
  ++m_generation;
  if (m_runner) m_runner->setNews({});
  m_opening = false;
  m_whenOpen.clear();
  m_runTo.reset();
  m_frame.reset();
  m_memory->forget();
  return std::move(m_runner);
}

void MatchController::setCatalog(std::shared_ptr<const link::VariableCatalog> catalog) {
  m_nextCatalog = std::move(catalog);
}

void MatchController::close() {
  m_worker.start([old = retire()]() mutable { old.reset(); });
  emit scenarioChanged();
  emit restarted();
  emit transportChanged();
}

void MatchController::open(const link::Scenario& scenario, bool paused) {
  openAfter(scenario, paused, {});
}

link::Scenario MatchController::beginning() const {
  return isOpen() || isOpening() ? m_edits->setUp(m_beginning) : m_beginning;
}

void MatchController::restart(std::function<void()> between) {
  if (!m_edits->allowsChange()) return;
  const bool over = m_frame && m_frame->finished;
  m_edits->replaceMatch(
      beginning(),
      over ? QStringLiteral("Play the match again") : QStringLiteral("Restart the match"),
      (over ? QStringLiteral("Match started again") : QStringLiteral("Match restarted")) +
          (beginning() == m_beginning
               ? QString()
               : QStringLiteral(
                     " with what you set up (open the scenario again for its own setup)")),
      m_paused, std::move(between));
}

std::shared_ptr<RetiredMatch> MatchController::remember() {
  auto retired = std::make_shared<RetiredMatch>();
  retired->scenario = m_scenario;
  retired->beginning = beginning();
  retired->options = m_openedWith;
  retired->catalog = m_catalog;
  retired->paused = m_paused || (m_frame && m_frame->finished);
  if (m_runner) {
    m_runner->setPaused(true);
    m_runner->read([&](const link::SimulatedMatch& match) {
      retired->scenario = match.toScenario();
      retired->moment = link::presentMoment(match, *m_memory->archive());
    });
    poll();
  }
  retired->memory = m_memory->kept();
  emit retiring(*retired);
  // The rows of one match that is not played are enough.
  if (m_lastRetired) m_lastRetired->memory = {};
  m_lastRetired = retired;
  return retired;
}

std::shared_ptr<RetiredMatch> MatchController::replace(const link::Scenario& scenario, bool paused,
                                                       std::function<void()> between) {
  auto retired = remember();
  openAfter(scenario, paused, std::move(between));
  return retired;
}

std::shared_ptr<RetiredMatch> MatchController::bringBack(
    const std::shared_ptr<RetiredMatch>& retired) {
  const RetiredMatch back = *retired;  // remember() takes its rows
  auto replaced = remember();
  const bool hadRows = back.memory.rows != nullptr;
  m_options.cognition = back.options.cognition;
  m_options.match = back.options.match;
  m_nextCatalog = back.catalog;
  openAfter(back.scenario, back.paused, {}, std::make_shared<RetiredMatch>(back));
  if (hadRows) {
    emit eventsRecorded(back.events);
    emit broughtBack(back);
  }
  if (back.moment) m_memory->reportLosses(*back.moment, m_options.cognition);
  return replaced;
}

void MatchController::openAfter(const link::Scenario& scenario, bool paused,
                                std::function<void()> between,
                                const std::shared_ptr<RetiredMatch>& from) {
  auto old = retire();
  m_scenario = scenario;
  m_beginning = from ? from->beginning : scenario;
  m_paused = paused;
  m_opening = true;
  m_whyNotOpened.clear();
  m_catalog = m_nextCatalog;
  m_memory->begin(from ? from->memory : MatchMemory::Kept{});
  m_options.speed = m_speed;
  m_openedWith = m_options;
  std::vector<std::shared_ptr<link::TickObserver>> observers = m_memory->observers();
  emit preparing(observers);
  m_worker.start([this, old = std::move(old), between = std::move(between), scenario, paused, from,
                  options = m_options, catalog = m_catalog, observers = std::move(observers),
                  generation = m_generation.load()]() mutable {
    old.reset();
    if (between) between();
    if (generation != m_generation) return;
    const auto opening = std::make_shared<Opening>();
    if (from && from->moment)
      opening->resume(*from->moment, scenario, options, catalog, observers);
    else
      opening->start(scenario, options, paused, catalog, observers);
    m_toUi.post([this, opening, generation] {
      if (generation == m_generation)
        take(*opening);
      else
        m_worker.start([opening] { opening->runner.reset(); });
    });
  });
  emit scenarioChanged();
  emit restarted();
  emit transportChanged();
}

void MatchController::take(Opening& opening) {
  m_opening = false;
  m_warnedAboutRealTime = false;
  m_cognition = opening.cognition;
  m_runner = std::move(opening.runner);
  if (!m_runner) m_whyNotOpened = std::exchange(opening.error, {});
  if (m_runner) {
    m_runner->setSpeed(m_speed);
    m_runner->setPaused(m_paused);
    if (m_runTo) m_runner->runTo(*m_runTo);
    for (link::MatchRunner::Command& command : m_whenOpen) m_runner->post(std::move(command));
    m_runner->setNews([this] { m_toUi.post([this] { m_news->want(); }); });
  }
  m_whenOpen.clear();
  m_runTo.reset();
  emit opened();
  emit transportChanged();
  if (!opening.error.isEmpty()) emit errorOccurred(opening.error);
  poll();
}

void MatchController::poll() {
  if (!m_runner) return;
  if (FramePtr frame = m_runner->latest(m_frame ? m_frame->serial : 0)) {
    m_frame = std::move(frame);
    emit frameReceived(m_frame);
  }
  // A receiver may have opened another match.
  if (!m_runner) return;
  if (const auto events = m_runner->drainEvents(); !events.empty()) {
    reportRealTimePrograms(events);
    emit eventsReceived(events);
  }
  if (!m_runner) return;
  if (const auto lines = m_runner->drainLog(); !lines.empty()) emit logReceived(lines);
}

void MatchController::settle() {
  if (!m_runner) return;
  m_runner->read([](const link::SimulatedMatch&) {});
  poll();
}

void MatchController::setPace(link::RobotsPace pace) {
  m_options.pace = pace;
  post([pace](link::SimulatedMatch& match) {
    match.pace().robotsPace = pace;
    return link::Changed::No;
  });
  emit transportChanged();
}

void MatchController::setWaitForTeamPrograms(bool on) {
  m_options.waitForTeamPrograms = on;
  post([on](link::SimulatedMatch& match) {
    match.pace().waitForTeamPrograms = on;
    return link::Changed::No;
  });
  emit transportChanged();
}

void MatchController::warnAboutRealTimePrograms() {
  if (m_warnedAboutRealTime || !m_frame) return;
  QStringList names;
  for (const link::RobotFrame& robot : m_frame->robots) {
    if (robot.ofOthers) names << robotName(robot.identity);
  }
  if (names.empty()) return;
  m_warnedAboutRealTime = true;
  emit errorOccurred(QStringLiteral("The processes of %1 were not started by this match, so they "
                                    "keep running at ×1 when it pauses or changes speed. To make "
                                    "them follow, choose their programs under Runtime on the card.")
                         .arg(names.join(QStringLiteral(", "))));
}

void MatchController::reportRealTimePrograms(std::span<const link::MatchEvent> events) {
  std::map<std::string, QStringList> programs;  // by reason
  for (const link::MatchEvent& event : events) {
    if (event.kind != link::MatchEventKind::ProcessRealTime) continue;
    programs[event.detail] << QString::fromStdString(event.name + ' ' + event.process);
  }
  for (const auto& [reason, names] : programs) {
    emit errorOccurred(QStringLiteral("Real time only: %1. %2.")
                           .arg(names.join(QStringLiteral(", ")), capitalised(reason)));
  }
}

void MatchController::refuse(const QString& sentence) {
  m_refused = true;
  emit errorOccurred(sentence, Trouble::Refused);
}

void MatchController::setPaused(bool paused) {
  if (!m_runner && !m_opening) return;
  if (paused) warnAboutRealTimePrograms();
  m_paused = paused;
  m_runTo.reset();
  if (m_runner) m_runner->setPaused(paused);
  emit transportChanged();
}

void MatchController::stepOnce() {
  if (!m_runner) return;
  m_paused = true;
  m_runner->stepOnce();
  emit transportChanged();
}

void MatchController::runTo(std::uint64_t tick) {
  if (!m_runner && !m_opening) return;
  m_paused = true;
  if (m_runner)
    m_runner->runTo(tick);
  else
    m_runTo = tick;
  emit transportChanged();
}

void MatchController::skip(std::function<bool(const link::MatchEvent&)> wanted) {
  if (!m_runner || !m_frame || !m_edits->allowsChange()) return;
  if (const QStringList programs = realTimePrograms(); !programs.isEmpty()) {
    refuse(QStringLiteral("%1 uses real time (\"clock\": \"real\"), so the match cannot skip.")
               .arg(programs.join(QStringLiteral(", "))));
    return;
  }
  constexpr double longest = 20 * 60.0;  // s
  m_runner->skip(std::move(wanted),
                 static_cast<std::uint64_t>(longest * m_frame->settings->tickRate));
}

void MatchController::skipToKickOff() {
  skip([](const link::MatchEvent& event) { return event.state == PlayState::Playing; });
}

void MatchController::skipToEvent(const EventFilter& shown) {
  skip([shown](const link::MatchEvent& event) { return shown.shows(event); });
}

/// Returns the programs whose profile asks for real time.
QStringList MatchController::realTimePrograms() const {
  QStringList names;
  if (!m_frame) return names;
  for (const link::RobotFrame& robot : m_frame->robots) {
    for (const link::ProcessStatus& one : robot.processes()) {
      if (one.isTeamProgram && one.clock == link::ProcessClock::Real) {
        names << robotName(robot.identity) + QLatin1Char(' ') + QString::fromStdString(one.name);
      }
    }
  }
  return names;
}

void MatchController::setSpeed(double timesRealTime) {
  const QStringList realTime = timesRealTime != 1.0 ? realTimePrograms() : QStringList();
  if (!realTime.isEmpty()) {
    emit transportChanged();  // who showed the new speed shows the old one again
    emit askedForSpeed(realTime, timesRealTime);
    return;
  }
  changeSpeed(timesRealTime);
}

void MatchController::answerSpeed(double timesRealTime, RealTimePrograms what) {
  if (what == RealTimePrograms::RestartWithMatchTime) {
    post({.whatFailed = QStringLiteral("Could not restart the programs with match time"),
          .carryOut =
              [](link::SimulatedMatch& match) { return match.robots().restartWithMatchTime(); },
          .changes = link::Changed::No});
  } else {
    setWaitForTeamPrograms(false);  // it would wait for them at ×1
  }
  changeSpeed(timesRealTime);
}

void MatchController::changeSpeed(double timesRealTime) {
  if (timesRealTime != 1.0) warnAboutRealTimePrograms();
  m_speed = timesRealTime;
  if (m_runner) m_runner->setSpeed(timesRealTime);
  emit transportChanged();
}

link::Scenario MatchController::currentMoment() {
  link::Scenario moment = m_scenario;
  if (m_runner) {
    m_runner->read([&moment](const link::SimulatedMatch& match) { moment = match.toScenario(); });
  }
  return moment;
}

std::uint64_t MatchController::stateHash() {
  std::uint64_t hash = 0;
  if (m_runner) {
    m_runner->read(
        [&hash](const link::SimulatedMatch& match) { hash = match.simulation().hash(); });
  }
  return hash;
}

void MatchController::post(MatchOrder order) {
  post([this, order = std::move(order),
        generation = m_generation.load()](link::SimulatedMatch& match) {
    const Result<void> done = order.carryOut(match);
    const link::Changed changed = done ? order.changes : link::Changed::No;
    if (done && !order.onSuccess && !m_refused) return changed;
    const QString sentence = done ? QString()
                                  : order.whatFailed + QStringLiteral(": ") +
                                        QString::fromStdString(done.error().text());
    m_toUi.post(
        [this, sentence, onFailure = order.onFailure, onSuccess = order.onSuccess, generation] {
          if (generation != m_generation) return;
          if (sentence.isEmpty()) {
            if (m_refused.exchange(false)) emit obeyed();
            if (onSuccess) onSuccess();
            return;
          }
          if (onFailure) onFailure();
          refuse(sentence);
        });
    return changed;
  });
}

void MatchController::post(link::MatchRunner::Command command) {
  if (m_runner)
    m_runner->post(std::move(command));
  else if (m_opening)
    m_whenOpen.push_back(std::move(command));
}

}  // namespace pitchboard::ui
