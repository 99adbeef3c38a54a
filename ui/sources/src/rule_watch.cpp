// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/rule_watch.h>

#include <QFileInfo>
#include <QSettings>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <telemetry/query/moment_watch.h>
#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

using telemetry::RuleSeverity;

constexpr int pauseMilliseconds = 250;  // while rows come
// s; datagrams of robots are not read in the order of the times that their rows get.
constexpr double lateInLive = 0.5;
const QString rulesFileKey = QStringLiteral("rules/file");

QString fromUtf8(const std::string& text) {
  return QString::fromStdString(text);
}

}  // namespace

/// What a worker has; only one of its orders runs at a time.
struct RuleWatch::Search {
  explicit Search(std::vector<telemetry::MomentQuestion> questions) : watch(std::move(questions)) {}
  telemetry::MomentWatch watch;
  std::string path;     // of a recording; empty: rows in memory
  quint64 session = 0;  // id of a compared session; 0: the source that is shown
  double late = 0.0;    // s; so much before the newest row others may still come
  double part = 0.0;    // of the recording that has been read; the UI's
  std::atomic<bool> cancelled = false;

  static void stop(std::shared_ptr<Search>& search) {
    if (search) search->cancelled = true;
    search.reset();
  }
};

struct RuleWatch::Found {
  std::vector<BrokenRule> broken;
  std::vector<telemetry::UnansweredQuestion> unanswered;
  std::optional<Error> error;
};

RuleWatch::RuleWatch(ShownMoment* shown, ReplayController* replay, ComparedSessions* compared,
                     QSettings* settings, QObject* parent)
    : QAbstractTableModel(parent),
      m_shown(shown),
      m_replay(replay),
      m_compared(compared),
      m_settings(settings) {
  m_pause.setSingleShot(true);
  m_pause.setInterval(pauseMilliseconds);
  connect(&m_pause, &QTimer::timeout, this, &RuleWatch::advance);
  connect(shown, &ShownMoment::sourceChanged, this, &RuleWatch::restart);
  connect(shown, &FrameSource::rewound, this, &RuleWatch::restart);
  // Rows come with frames, with newer ones while the past is shown, or alone.
  connect(shown, &FrameSource::rowsAppended, this, &RuleWatch::takeRows);
  connect(shown, &FrameSource::frameReceived, this, &RuleWatch::takeRows);
  connect(shown, &ShownMoment::newestChanged, this, &RuleWatch::takeRows);
  connect(shown, &ShownMoment::timesOfDayChanged, this, [this] {
    if (!m_broken.empty()) emit dataChanged(index(0, From), index(rowCount() - 1, From));
  });
  connect(compared, &ComparedSessions::changed, this, &RuleWatch::followCompared);
  if (settings != nullptr) m_path = settings->value(rulesFileKey).toString();
  if (!m_path.isEmpty()) again();
}

RuleWatch::~RuleWatch() {
  Search::stop(m_search);
  Search::stop(m_reading);
}

Result<void> RuleWatch::open(const QString& path) {
  m_path = path;
  if (m_settings != nullptr) m_settings->setValue(rulesFileKey, path);
  auto rules = telemetry::rulesFromFile(path.toStdString());
  forgetAll();
  if (rules) m_rules = std::move(*rules);
  for (const telemetry::Rule& rule : m_rules) {
    m_ruleTexts.push_back(
        fromUtf8(std::string(nameOf(rule.severity)) + '\n' + rule.name + '\n' + rule.text));
  }
  m_fileProblem = rules ? QString() : fromUtf8(rules.error().text());
  restart();
  if (rules) return {};
  return tl::unexpected(rules.error());
}

void RuleWatch::again() {
  (void)open(m_path);
}

void RuleWatch::close() {
  m_path.clear();
  if (m_settings != nullptr) m_settings->remove(rulesFileKey);
  forgetAll();
  restart();
}

/// The rules, and what was found with them.
void RuleWatch::forgetAll() {
  Search::stop(m_reading);
  m_checked.clear();
  m_problems.clear();
  m_cut.clear();
  m_fileProblem.clear();
  beginResetModel();
  m_broken.clear();
  m_rules.clear();
  m_ruleTexts.clear();
  endResetModel();
}

void RuleWatch::cancel() {
  if (isRecording()) {
    Search::stop(m_search);
    m_running = false;
  }
  Search::stop(m_reading);
  m_cancelled = true;
  emit changed();
}

bool RuleWatch::isRecording() const {
  return m_shown->source() == m_replay;
}

bool RuleWatch::isComparing() const {
  return !m_compared->isEmpty();
}

double RuleWatch::progress() const {
  double files = static_cast<double>(m_compared->all().size());
  double done = static_cast<double>(m_checked.size()) + (m_reading ? m_reading->part : 0.0);
  if (isRecording()) {
    files += 1.0;
    done += m_search ? m_search->part : 1.0;
  }
  return files > 0.0 ? std::min(done / files, 1.0) : 1.0;
}

QStringList RuleWatch::problems() const {
  QStringList all;
  if (!m_fileProblem.isEmpty()) all << m_fileProblem;
  for (const auto& [id, problems] : m_problems) {
    const ComparedSession* session = m_compared->find(id);
    const QString who = session ? session->markedName() + QStringLiteral(": ") : QString();
    for (const QString& problem : problems) all << who + problem;
  }
  return all;
}

/// Checks the source that is shown from its beginning; compared sessions stay as they are.
void RuleWatch::restart() {
  Search::stop(m_search);
  m_pause.stop();
  m_running = m_cancelled = false;
  m_problems.erase(0);
  m_cut.erase(0);
  if (std::ranges::count(m_broken, quint64{0}, &BrokenRule::session) > 0) {
    beginResetModel();
    std::erase_if(m_broken, [](const BrokenRule& one) { return one.session == 0; });
    endResetModel();
  }
  listEvents();
  m_since = m_shown->now();
  if (!m_rules.empty() && (!isRecording() || !m_replay->path().isEmpty())) {
    m_search = std::make_shared<Search>(telemetry::questionsOf(m_rules));
    if (isRecording()) m_search->path = m_replay->path().toStdString();
    if (&m_shown->kind() == &SourceKind::Live) m_search->late = lateInLive;
    advance();
  }
  readNextCompared();
  emit changed();
}

void RuleWatch::takeRows() {
  if (m_search && m_search->path.empty() && !m_running && !m_pause.isActive()) m_pause.start();
}

void RuleWatch::advance() {
  const auto rows = m_shown->series();
  if (!m_search || m_running || (m_search->path.empty() && rows == nullptr)) return;
  m_running = true;
  start(m_worker, m_search, rows);
}

/// Sessions were opened, closed or aligned. What was found in them stays true.
void RuleWatch::followCompared() {
  const auto isClosed = [this](quint64 id) { return id != 0 && m_compared->find(id) == nullptr; };
  if (m_reading && isClosed(m_reading->session)) Search::stop(m_reading);
  std::erase_if(m_checked, isClosed);
  std::erase_if(m_cut, isClosed);
  std::erase_if(m_problems, [&](const auto& one) { return isClosed(one.first); });
  std::map<quint64, double> offsets{{0, 0.0}};
  for (const ComparedSession* one : m_compared->all()) offsets[one->id()] = one->offset();
  const auto isElsewhere = [&offsets](const BrokenRule& one) {
    const auto found = offsets.find(one.session);
    return found == offsets.end() || found->second != one.offset;
  };
  if (std::ranges::any_of(m_broken, isElsewhere)) {
    beginResetModel();
    std::erase_if(m_broken, [&](const BrokenRule& one) { return isClosed(one.session); });
    for (BrokenRule& one : m_broken) one.offset = offsets.at(one.session);
    std::ranges::stable_sort(m_broken, {}, &BrokenRule::from);
    endResetModel();
  }
  readNextCompared();
  emit changed();
}

void RuleWatch::readNextCompared() {
  if (m_rules.empty() || m_cancelled || m_reading) return;
  const auto& all = m_compared->all();
  const auto next = std::ranges::find_if(
      all, [this](const ComparedSession* one) { return !m_checked.contains(one->id()); });
  if (next == all.end()) return;
  m_reading = std::make_shared<Search>(telemetry::questionsOf(m_rules));
  m_reading->path = (*next)->path().toStdString();
  m_reading->session = (*next)->id();
  start(m_reader, m_reading, nullptr);
}

void RuleWatch::start(Workers& worker, const std::shared_ptr<Search>& search, const Rows& rows) {
  worker.start([this, search, rows] {
    int shown = 0;
    const auto progress = [this, search, &shown](double part) {
      constexpr int steps = 100;
      if (const int step = static_cast<int>(part * steps); std::exchange(shown, step) != step) {
        m_ui.post([this, part, search] {
          search->part = part;
          if (search == m_search || search == m_reading) emit changed();
        });
      }
      return !search->cancelled;
    };
    auto found = searched(*search, rows, progress);
    if (!found) return;
    m_ui.post([this, search, found = std::make_shared<Found>(std::move(*found))] {
      take(search, std::move(*found));
    });
  });
}

/// Runs on a worker. Returns nothing if it was cancelled.
std::optional<RuleWatch::Found> RuleWatch::searched(Search& search, const Rows& rows,
                                                    const std::function<bool(double)>& progress) {
  if (search.cancelled) return {};
  Found out;
  if (search.path.empty()) {
    const telemetry::QueryRows memory(*rows);
    // The newest moment may have no row of some robots yet.
    const auto range = memory.range();
    const double until = range ? std::nextafter(range->end, -1.0) - search.late : 0.0;
    if (range && !search.watch.advance(memory, until, progress)) return {};
  } else {
    telemetry::McapReaderOptions reading;
    reading.progress = [&progress](double) { return progress(0.0); };
    const auto session = telemetry::SessionReader::open(search.path, reading);
    const auto range = session ? session->range() : std::nullopt;
    if (search.cancelled) return {};
    if (!session) out.error = session.error();
    if (range && !search.watch.advance(*session, range->end, progress)) return {};
  }
  for (auto& one : search.watch.takeEnded()) {
    out.broken.push_back({std::move(one), false, search.session, 0.0});
  }
  for (auto& one : search.watch.open()) {
    out.broken.push_back({std::move(one), search.path.empty(), search.session, 0.0});
  }
  out.unanswered = search.watch.unanswered();
  return out;
}

void RuleWatch::take(const std::shared_ptr<Search>& search, Found&& found) {
  if (search != m_search && search != m_reading) return;
  search->part = 1.0;
  noteProblems(search->session, found);
  constexpr std::size_t many = 100;
  if (search == m_reading) {
    m_checked.insert(search->session);
    m_reading.reset();
    listAll(search->session, std::move(found.broken), maxBrokenCompared);
    readNextCompared();
  } else {
    m_running = false;
    if (found.broken.size() > many) {
      listAll(0, std::move(found.broken), maxBroken);
      listEvents();
    } else {
      listNew(std::move(found.broken));
    }
  }
  emit changed();
}

void RuleWatch::noteProblems(quint64 session, const Found& found) {
  QStringList problems;
  if (found.error) problems << fromUtf8(found.error->text());
  for (const telemetry::UnansweredQuestion& one : found.unanswered) {
    problems << QStringLiteral("%1 is not checked: %2")
                    .arg(fromUtf8(m_rules[one.question].name), fromUtf8(one.error.message));
  }
  if (problems.isEmpty())
    m_problems.erase(session);
  else
    m_problems[session] = problems;
}

/// Adds many at once, without a signal for each.
void RuleWatch::listAll(quint64 session, std::vector<BrokenRule>&& found, std::size_t most) {
  const auto isOfSession = [session](const BrokenRule& one) { return one.session == session; };
  const ComparedSession* compared = m_compared->find(session);
  for (BrokenRule& one : found) one.offset = compared != nullptr ? compared->offset() : 0.0;
  beginResetModel();
  std::erase_if(m_broken, [&](const BrokenRule& one) { return one.goesOn && isOfSession(one); });
  m_broken.insert(m_broken.end(), std::make_move_iterator(found.begin()),
                  std::make_move_iterator(found.end()));
  std::ranges::stable_sort(m_broken, {}, &BrokenRule::from);
  const auto all = static_cast<std::size_t>(std::ranges::count_if(m_broken, isOfSession));
  std::size_t tooMany = all > most ? all - most : 0;
  if (tooMany > 0) m_cut.insert(session);
  std::erase_if(m_broken, [&](const BrokenRule& one) {
    return tooMany > 0 && isOfSession(one) && tooMany-- > 0;
  });
  endResetModel();
}

/// Adds a few of the source that is shown, and tells of those that are news.
void RuleWatch::listNew(std::vector<BrokenRule>&& found) {
  QString sentence;
  int news = 0;
  for (BrokenRule& one : found) {
    const QString own = sentenceOf(one);
    if (list(std::move(one)) && news++ == 0) sentence = own;
  }
  if (news > 1) sentence += QStringLiteral(" (and %1 more)").arg(news - 1);
  if (news > 0) emit broke(sentence);
}

/// Adds a line, or continues that of a rule that was broken already. Returns whether it is new and
/// somebody should know now.
bool RuleWatch::list(BrokenRule&& one) {
  const auto known = std::ranges::find_if(m_broken, [&one](const BrokenRule& other) {
    return other.goesOn && other.session == 0 && other.moment.question == one.moment.question &&
           other.moment.range.begin == one.moment.range.begin &&
           other.moment.robot == one.moment.robot;
  });
  if (known != m_broken.end()) {
    *known = std::move(one);
    const int row = static_cast<int>(known - m_broken.begin());
    emit dataChanged(index(row, 0), index(row, columns - 1));
    return false;
  }
  const bool isNews = ruleOf(one).severity == RuleSeverity::Error &&
                      one.moment.range.begin >= m_since && !isRecording();
  const auto place = std::ranges::upper_bound(m_broken, one.from(), {}, &BrokenRule::from);
  const int row = static_cast<int>(place - m_broken.begin());
  m_shown->events()->add(eventOf(one));
  beginInsertRows({}, row, row);
  m_broken.insert(place, std::move(one));
  endInsertRows();
  dropOldest();
  return isNews;
}

/// Of the source that is shown, if it has too many.
void RuleWatch::dropOldest() {
  if (m_broken.size() <= maxBroken) return;
  const auto own = std::ranges::count(m_broken, quint64{0}, &BrokenRule::session);
  if (static_cast<std::size_t>(own) <= maxBroken) return;
  const auto oldest = std::ranges::find(m_broken, quint64{0}, &BrokenRule::session);
  const int row = static_cast<int>(oldest - m_broken.begin());
  beginRemoveRows({}, row, row);
  m_broken.erase(oldest);
  endRemoveRows();
  m_cut.insert(0);
}

/// A rule that is broken for a while is one event, at its beginning.
link::MatchEvent RuleWatch::eventOf(const BrokenRule& one) const {
  const telemetry::Rule& rule = ruleOf(one);
  RobotUid robot{};
  if (const FramePtr frame = m_shown->newest()) {
    const auto found = std::ranges::find(frame->robots, one.moment.robot, &link::RobotFrame::name);
    if (found != frame->robots.end()) robot = found->uid;
  }
  link::MatchEvent event = link::eventOf(link::MatchEventKind::RuleBroken, one.moment.range.begin,
                                         robot, one.moment.robot);
  event.value = static_cast<int>(rule.severity);
  event.detail = rule.text + " (" + std::string(nameOf(rule.severity)) + ')';
  return event;
}

void RuleWatch::listEvents() {
  std::vector<link::MatchEvent> events;
  for (const BrokenRule& one : m_broken) {
    if (one.session == 0) events.push_back(eventOf(one));
  }
  m_shown->events()->replace(link::MatchEventKind::RuleBroken, std::move(events));
}

QString RuleWatch::sourceNameOf(const BrokenRule& one) const {
  if (const ComparedSession* session = m_compared->find(one.session)) return session->path();
  return isRecording() ? m_replay->path() : QString::fromUtf8(m_shown->kind().name);
}

bool RuleWatch::contains(const BrokenRule& one, const QString& word) const {
  const auto has = [&word](const QString& text) {
    return text.contains(word, Qt::CaseInsensitive);
  };
  return has(m_ruleTexts[one.moment.question]) || has(fromUtf8(one.moment.robot)) ||
         has(sessionText(one)) || (one.goesOn && has(QStringLiteral("goes on")));
}

/// Empty while there is only one.
QString RuleWatch::sessionText(const BrokenRule& one) const {
  if (!isComparing()) return {};
  if (const ComparedSession* session = m_compared->find(one.session)) return session->markedName();
  return isRecording() ? QFileInfo(m_replay->path()).completeBaseName()
                       : QString::fromUtf8(m_shown->kind().name);
}

QString RuleWatch::sentenceOf(const BrokenRule& one) const {
  return fromUtf8(one.moment.robot) + QStringLiteral(": ") + fromUtf8(ruleOf(one).text);
}

int RuleWatch::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_broken.size());
}

int RuleWatch::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant RuleWatch::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const BrokenRule& one = m_broken[static_cast<std::size_t>(index.row())];
  const telemetry::FoundMoment& moment = one.moment;
  const telemetry::Rule& rule = ruleOf(one);
  if (role == Qt::ForegroundRole && index.column() == Severity) {
    return severityColor(rule.severity);
  }
  if (role == Qt::DecorationRole && index.column() == Session) {
    const ComparedSession* session = m_compared->find(one.session);
    return session != nullptr ? QVariant(sessionColor(session->number())) : QVariant();
  }
  if (role == Qt::ToolTipRole) return fromUtf8(rule.question.condition);
  if (role != Qt::DisplayRole && role != sortRole) return {};
  const bool isShown = role == Qt::DisplayRole;
  const double duration = moment.range.end - moment.range.begin;
  switch (index.column()) {
    case Severity: {
      const std::string_view name = nameOf(rule.severity);
      if (!isShown) return static_cast<int>(rule.severity);
      return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
    }
    case Session:
      return sessionText(one);
    case Name:
      return fromUtf8(rule.name);
    case Robot:
      return fromUtf8(moment.robot);
    case From:
      return isShown ? QVariant(momentText(one.from(), 2, m_shown->clock())) : QVariant(one.from());
    case Duration:
      if (!isShown) return duration;
      return QStringLiteral("%1 s%2")
          .arg(duration, 0, 'f', 2)
          .arg(one.goesOn ? QStringLiteral(", goes on") : QString());
    case Worst:
      if (!isShown) return moment.value.value_or(std::numeric_limits<double>::quiet_NaN());
      return moment.value ? QString::number(*moment.value, 'g', 4) : QStringLiteral("–");
    case Text:
      return fromUtf8(rule.text);
    default:
      return {};
  }
}

QVariant RuleWatch::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  static const char* const names[columns] = {"Severity", "Session",  "Rule",  "Robot",
                                             "Time",     "Duration", "Worst", "What"};
  return QString::fromUtf8(names[section]);
}

QColor severityColor(RuleSeverity severity) {
  switch (severity) {
    case RuleSeverity::Error:
      return theme().errorText;
    case RuleSeverity::Warning:
      return theme().warningText;
    case RuleSeverity::Note:
      break;
  }
  return theme().secondaryText;
}

}  // namespace pitchboard::ui
