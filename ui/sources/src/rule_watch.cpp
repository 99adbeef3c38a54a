// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/rule_watch.h>

#include <QSettings>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <telemetry/query/moment_watch.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

using telemetry::RuleSeverity;

constexpr int pauseMilliseconds = 250;  // while rows come
const QString rulesFileKey = QStringLiteral("rules/file");

QString fromUtf8(const std::string& text) {
  return QString::fromStdString(text);
}

}  // namespace

/// What the worker has; only one of its orders runs at a time.
struct RuleWatch::Search {
  explicit Search(std::vector<telemetry::MomentQuestion> questions) : watch(std::move(questions)) {}
  telemetry::MomentWatch watch;
  std::string path;  // of a recording; empty: rows in memory
  std::atomic<bool> cancelled = false;
};

struct RuleWatch::Progress {
  std::vector<BrokenRule> found;
  std::vector<telemetry::UnansweredQuestion> unanswered;
  std::optional<Error> error;
};

RuleWatch::RuleWatch(ShownMoment* shown, ReplayController* replay, QSettings* settings,
                     QObject* parent)
    : QAbstractTableModel(parent), m_shown(shown), m_replay(replay), m_settings(settings) {
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
  if (settings != nullptr) m_path = settings->value(rulesFileKey).toString();
  if (!m_path.isEmpty()) again();
}

RuleWatch::~RuleWatch() {
  if (m_search) m_search->cancelled = true;
}

Result<void> RuleWatch::open(const QString& path) {
  m_path = path;
  if (m_settings != nullptr) m_settings->setValue(rulesFileKey, path);
  auto rules = telemetry::rulesFromFile(path.toStdString());
  beginResetModel();
  m_broken.clear();
  m_rules = rules ? std::move(*rules) : std::vector<telemetry::Rule>();
  endResetModel();
  restart();
  if (rules) return {};
  m_problems = QStringList{fromUtf8(rules.error().text())};
  emit changed();
  return tl::unexpected(rules.error());
}

void RuleWatch::again() {
  (void)open(m_path);
}

void RuleWatch::close() {
  m_path.clear();
  if (m_settings != nullptr) m_settings->remove(rulesFileKey);
  beginResetModel();
  m_broken.clear();
  m_rules.clear();
  endResetModel();
  restart();
}

void RuleWatch::cancel() {
  if (m_search) m_search->cancelled = true;
  m_search.reset();
  m_running = false;
  m_cancelled = true;
  emit changed();
}

bool RuleWatch::isRecording() const {
  return m_shown->source() == m_replay;
}

void RuleWatch::restart() {
  if (m_search) m_search->cancelled = true;
  m_search.reset();
  m_pause.stop();
  m_running = m_cancelled = false;
  m_progress = 0.0;
  m_problems.clear();
  if (!m_broken.empty()) {
    beginResetModel();
    m_broken.clear();
    endResetModel();
  }
  listEvents();
  m_since = m_shown->now();
  if (!m_rules.empty() && (!isRecording() || !m_replay->path().isEmpty())) {
    m_search = std::make_shared<Search>(telemetry::questionsOf(m_rules));
    if (isRecording()) m_search->path = m_replay->path().toStdString();
    advance();
  }
  emit changed();
}

void RuleWatch::takeRows() {
  if (m_search && m_search->path.empty() && !m_running && !m_pause.isActive()) m_pause.start();
}

void RuleWatch::advance() {
  const auto rows = m_shown->series();
  if (!m_search || m_running || (m_search->path.empty() && rows == nullptr)) return;
  m_running = true;
  m_worker.start([this, search = m_search, rows] {
    if (search->cancelled) return;
    int shown = 0;
    const auto progress = [&](double part) {
      constexpr int steps = 100;
      if (const int step = static_cast<int>(part * steps); std::exchange(shown, step) != step) {
        m_ui.post([this, part, search] {
          if (search != m_search) return;
          m_progress = part;
          emit changed();
        });
      }
      return !search->cancelled;
    };
    Progress out;
    if (search->path.empty()) {
      const telemetry::QueryRows memory(*rows);
      // The newest moment may have no row of some robots yet.
      const auto range = memory.range();
      const double until = range ? std::nextafter(range->end, -1.0) : 0.0;
      if (range && !search->watch.advance(memory, until, progress)) return;
    } else {
      telemetry::McapReaderOptions reading;
      reading.progress = [&](double) { return progress(0.0); };
      const auto session = telemetry::SessionReader::open(search->path, reading);
      const auto range = session ? session->range() : std::nullopt;
      if (!session) out.error = session.error();
      if (range && !search->watch.advance(*session, range->end, progress)) return;
    }
    for (auto& one : search->watch.takeEnded()) out.found.push_back({std::move(one), false});
    for (auto& one : search->watch.open()) {
      out.found.push_back({std::move(one), search->path.empty()});
    }
    out.unanswered = search->watch.unanswered();
    m_ui.post([this, search, out = std::make_shared<Progress>(std::move(out))] {
      take(search, std::move(*out));
    });
  });
}

void RuleWatch::take(const std::shared_ptr<Search>& search, Progress&& found) {
  if (search != m_search) return;
  m_running = false;
  m_progress = 1.0;
  m_problems.clear();
  if (found.error) m_problems << fromUtf8(found.error->text());
  for (const telemetry::UnansweredQuestion& one : found.unanswered) {
    m_problems << QStringLiteral("%1 is not checked: %2")
                      .arg(fromUtf8(m_rules[one.question].name), fromUtf8(one.error.message));
  }
  constexpr std::size_t many = 100;
  if (found.found.size() > many) {
    beginResetModel();
    std::erase_if(m_broken, &BrokenRule::goesOn);
    m_broken.insert(m_broken.end(), found.found.begin(), found.found.end());
    std::ranges::stable_sort(m_broken, {},
                             [](const BrokenRule& one) { return one.moment.range.begin; });
    if (m_broken.size() > maxBroken) m_broken.erase(m_broken.begin(), m_broken.end() - maxBroken);
    endResetModel();
    listEvents();
  } else {
    QString sentence;
    int news = 0;
    for (BrokenRule& one : found.found) {
      const QString own = sentenceOf(one);
      if (list(std::move(one)) && news++ == 0) sentence = own;
    }
    if (news > 1) sentence += QStringLiteral(" (and %1 more)").arg(news - 1);
    if (news > 0) emit broke(sentence);
  }
  emit changed();
}

/// Adds a line, or continues that of a rule that was broken already. Returns whether it is new and
/// somebody should know now.
bool RuleWatch::list(BrokenRule&& one) {
  const auto known = std::ranges::find_if(m_broken, [&one](const BrokenRule& other) {
    return other.goesOn && other.moment.question == one.moment.question &&
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
  const auto place =
      std::ranges::upper_bound(m_broken, one.moment.range.begin, {},
                               [](const BrokenRule& each) { return each.moment.range.begin; });
  const int row = static_cast<int>(place - m_broken.begin());
  m_shown->events()->add(eventOf(one));
  beginInsertRows({}, row, row);
  m_broken.insert(place, std::move(one));
  endInsertRows();
  if (m_broken.size() > maxBroken) {
    beginRemoveRows({}, 0, 0);
    m_broken.erase(m_broken.begin());
    endRemoveRows();
  }
  return isNews;
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
  for (const BrokenRule& one : m_broken) events.push_back(eventOf(one));
  m_shown->events()->replace(link::MatchEventKind::RuleBroken, std::move(events));
}

QString RuleWatch::sourceName() const {
  return isRecording() ? m_replay->path() : QString::fromUtf8(m_shown->kind().name);
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
    case Name:
      return fromUtf8(rule.name);
    case Robot:
      return fromUtf8(moment.robot);
    case From:
      return isShown ? QVariant(momentText(moment.range.begin, 2, m_shown->clock()))
                     : QVariant(moment.range.begin);
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
  static const char* const names[columns] = {"Severity", "Rule",  "Robot", "Time",
                                             "Duration", "Worst", "What"};
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
