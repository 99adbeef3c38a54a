// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/live_controller.h>

#include <algorithm>

#include <robotlink/frame/join_boards.h>
#include <telemetry/series/series_store.h>

namespace pitchboard::ui {
namespace {
constexpr Beat::Milliseconds manyPeriod{32};  // between frames, while many are received
constexpr std::size_t fewRobots = 8;
}  // namespace

LiveController::LiveController(QObject* parent)
    : FrameSource(parent),
      m_news(Beat::display().addSource([this] { deliver(); })),
      m_rowNews(Beat::display().addSource([this] {
        if (m_series) m_series->heard();
        emit rowsAppended();
      })) {}

// The watch's thread posts to this object: it ends while this is whole.
LiveController::~LiveController() {
  m_watch.reset();
}

void LiveController::start() {
  if (m_watch) return;
  m_watch = std::make_unique<link::LiveWatch>(m_options,
                                              [this] { m_toUi.post([this] { m_news->want(); }); });
  keepRows();
  for (const auto& observer : m_observers) m_watch->observe(observer);
  emit restarted();
}

void LiveController::stop() {
  if (!m_watch) return;
  m_watch.reset();
  m_frame.reset();
  m_series.reset();
  m_memory.reset();
  emit restarted();
}

void LiveController::setOptions(const link::LiveOptions& options) {
  if (const auto good = link::validate(options); !good) {
    emit errorOccurred(QStringLiteral("Live settings not changed: %1")
                           .arg(QString::fromStdString(good.error().text())));
    return;
  }
  m_options = options;
  if (m_watch) m_watch->setOptions(options);
  emit optionsChanged();
}

void LiveController::setOurTeam(int number) {
  if (number == m_options.ourTeam && !m_options.ourColour) return;
  link::LiveOptions options = m_options;
  options.ourTeam = number;
  options.ourColour.reset();
  setOptions(options);
}

void LiveController::setMonitor(std::optional<telemetry::Address> referee) {
  if (referee == m_options.monitor) return;
  link::LiveOptions options = m_options;
  options.monitor = referee;
  setOptions(options);
}

void LiveController::clear() {
  if (!m_watch) return;
  m_watch->clear();
  m_frame.reset();
  keepRows();
  emit restarted();
}

void LiveController::forget(RobotUid robot) {
  if (m_watch) m_watch->forget(robot);
}

void LiveController::setMemoryBudget(std::size_t bytes) {
  m_memoryBudget = bytes;
  if (m_series) m_series->setMemoryBudget(bytes);
}

void LiveController::keepRows() {
  if (m_memory) m_watch->stopObserving(m_memory);
  m_series = std::make_shared<telemetry::SeriesStore>(telemetry::SeriesOptions{m_memoryBudget});
  m_series->setListener([this] { m_toUi.post([this] { m_rowNews->want(); }); });
  m_memory = std::make_shared<link::LiveMemory>(m_series);
  m_moments = std::make_unique<link::LiveMoments>();
  link::FrameSettings backdrop;
  backdrop.field = m_options.field;
  m_boardFrames = std::make_unique<link::RecordedFrames>(backdrop);
  m_watch->observe(m_memory);
}

FramePtr LiveController::frameAt(double time) const {
  if (!m_memory) return nullptr;
  auto frame = m_moments->frameAt(*m_memory, time);
  // Blackboards are rows.
  if (frame && m_series) joinBoards(*frame, m_boardFrames->boardsAt(*m_series, time));
  return frame ? std::make_shared<link::MatchFrame>(std::move(*frame)) : nullptr;
}

telemetry::WallTime LiveController::began() const {
  return m_watch ? m_watch->began() : telemetry::WallTime{};
}

std::optional<QDateTime> LiveController::clock() const {
  if (!m_watch) return {};
  const auto began =
      std::chrono::duration_cast<std::chrono::milliseconds>(m_watch->began().time_since_epoch());
  return QDateTime::fromMSecsSinceEpoch(began.count());
}

QString LiveController::portsText() const {
  link::LiveOptions options = m_options;
  options.monitor.reset();
  auto ports = portsOf(options).value_or(std::vector<std::uint16_t>{});
  std::erase(ports, static_cast<std::uint16_t>(m_options.refereePort));
  QStringList ranges;
  for (const std::string& range : telemetry::portRanges(std::move(ports))) {
    ranges << QString::fromStdString(range);
  }
  // The bar has room for two; the settings say all.
  if (ranges.size() > 2) {
    ranges = {ranges.first(), QStringLiteral("… %1").arg(ranges.last().section(QChar(0x2013), -1))};
  }
  return QStringLiteral("UDP ") + ranges.join(QStringLiteral(", "));
}

QString LiveController::emptyText() const {
  const QString address = m_options.bind.value == 0
                              ? QStringLiteral("all addresses of this computer")
                              : QString::fromStdString(m_options.bind.text());
  return QStringLiteral(
             "Waiting for robots…\nListening on %1: %2 for robots and UDP %3 for the "
             "referee.\n%4Check that this computer is in the robots' network and that no firewall "
             "blocks UDP. Live sends nothing to robots.%5")
      .arg(address, portsText())
      .arg(m_options.refereePort)
      .arg(m_options.team.teams.empty()
               ? QStringLiteral("Robot 1 sends to port %1, robot 2 to %2. ")
                     .arg(m_options.portBase + 1)
                     .arg(m_options.portBase + 2)
               : QString())
      .arg(details().ignoredSimulated > 0
               ? QStringLiteral("\nA match is simulated on this computer. To show its robots here, "
                                "turn on Receive simulated matches under Live > Settings and "
                                "teams.")
               : QString());
}

link::LiveDetails LiveController::details() const {
  return m_watch ? m_watch->details() : link::LiveDetails{};
}

void LiveController::observe(std::shared_ptr<link::LiveObserver> observer) {
  if (m_watch) m_watch->observe(observer);
  m_observers.push_back(std::move(observer));
}

void LiveController::stopObserving(const std::shared_ptr<link::LiveObserver>& observer) {
  if (m_watch) m_watch->stopObserving(observer);
  std::erase(m_observers, observer);
}

// A frame that comes after a rest is shown at once. Where many robots send often, half as many
// pictures of them tell as much and cost half.
void LiveController::deliver() {
  if (!m_watch) return;  // stopped while this was on its way
  const link::LiveNews news = m_watch->take();
  m_frame = news.frame;
  const bool many = m_frame && m_frame->robots.size() > fewRobots;
  m_news->setLeast(many ? manyPeriod : Beat::Milliseconds(0));
  if (m_frame) {
    emit frameReceived(m_frame);
  }
  if (!news.lines.empty()) emit logReceived(news.lines);
  const std::vector<link::MatchEvent>& events = news.events;
  // A receiver may have stopped it.
  if (!m_watch || events.empty()) return;
  emit eventsReceived(events);
  std::vector<const link::MatchEvent*> ports;
  for (const link::MatchEvent& event : events) {
    if (event.kind == link::MatchEventKind::PortLost) ports.push_back(&event);
    if (event.kind == link::MatchEventKind::PortsShared && !event.detail.empty()) {
      emit errorOccurred(QString::fromStdString(sentenceOf(event)));
    }
  }
  if (ports.empty()) return;
  const QString first = QString::fromStdString(sentenceOf(*ports.front()));
  emit errorOccurred(ports.size() == 1 ? first
                                       : QStringLiteral("Cannot receive on %1 ports. The first: %2")
                                             .arg(ports.size())
                                             .arg(first));
}

}  // namespace pitchboard::ui
