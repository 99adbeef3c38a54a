// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/live_controller.h>

namespace pitchboard::ui {

LiveController::LiveController(QObject* parent) : FrameSource(parent) {}

LiveController::~LiveController() = default;

void LiveController::start() {
  if (m_watch) return;
  m_watch = std::make_unique<link::LiveWatch>(m_options, [this] {
    QMetaObject::invokeMethod(this, &LiveController::deliver, Qt::QueuedConnection);
  });
  for (const auto& observer : m_observers) m_watch->observe(observer);
  emit restarted();
}

void LiveController::stop() {
  if (!m_watch) return;
  m_watch.reset();
  m_frame.reset();
  emit restarted();
}

void LiveController::setOptions(const link::LiveOptions& options) {
  if (const auto good = link::validate(options); !good) {
    emit errorOccurred(tr("Live keeps its settings: %1")
                           .arg(QString::fromStdString(good.error().text())));
    return;
  }
  m_options = options;
  if (m_watch) m_watch->setOptions(options);
  emit optionsChanged();
}

void LiveController::setOurTeam(int number) {
  if (number == m_options.ourTeam) return;
  link::LiveOptions options = m_options;
  options.ourTeam = number;
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
  emit restarted();
}

QString LiveController::portsText() const {
  return tr("UDP %1–%2").arg(m_options.portBase + 1).arg(m_options.portBase + m_options.robots);
}

QString LiveController::emptyText() const {
  const QString address = m_options.bind.value == 0
                              ? tr("every address of this computer")
                              : QString::fromStdString(m_options.bind.text());
  return tr("Nothing heard yet.\nListening at %1 on %2 for robots and UDP %3 for the referee.\n"
            "Robot 1 sends to port %4, robot 2 to %5. Check that this computer is in the robots' "
            "network and that no firewall keeps UDP out. Nothing is sent to robots.")
      .arg(address, portsText())
      .arg(m_options.refereePort)
      .arg(m_options.portBase + 1)
      .arg(m_options.portBase + 2);
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

void LiveController::deliver() {
  if (!m_watch) return;   // stopped while this was on its way
  m_frame = m_watch->latest();
  if (m_frame) emit frameReceived(m_frame);
  // A receiver may have stopped it.
  if (!m_watch) return;
  if (const auto events = m_watch->takeEvents(); !events.empty()) emit eventsReceived(events);
  if (!m_watch) return;
  const auto lines = m_watch->takeLog();
  if (lines.empty()) return;
  emit logReceived(lines);
  for (const link::LogLine& line : lines) {
    if (line.warning && line.origin == "network") {
      emit errorOccurred(QString::fromStdString(line.text));
    }
  }
}

}  // namespace pitchboard::ui
