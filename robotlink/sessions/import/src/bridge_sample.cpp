// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/bridge_sample.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>

#include <telemetry/foxglove/foxglove_client.h>
#include <telemetry/recordings/decoded_topics.h>
#include <telemetry/sockets/live_clock.h>

namespace pitchboard::link {
namespace {

using telemetry::FoxgloveChannel;
using telemetry::RecordedItem;
using SteadyClock = std::chrono::steady_clock;

constexpr auto longestConnecting = std::chrono::seconds(10);

struct KeptMessage {
  std::uint32_t channel;
  std::uint64_t logTime;
  std::string payload;
};

struct BridgeMessages {
  std::map<std::uint32_t, FoxgloveChannel> channels;
  std::vector<KeptMessage> messages;
  std::size_t bytes = 0;
};

telemetry::MessageSchema schemaOf(const FoxgloveChannel& channel) {
  return {channel.schemaName, channel.schemaEncoding, channel.encoding, channel.schema};
}

class BridgeReader : public telemetry::RecordingReader {
 public:
  explicit BridgeReader(std::shared_ptr<const BridgeMessages> kept) : m_kept(std::move(kept)) {
    for (const auto& [id, channel] : m_kept->channels) {
      m_topicOf[id] = m_topics.add(channel.topic, schemaOf(channel), 0);
    }
  }
  const std::vector<telemetry::RecordedTopic>& topics() const override { return m_topics.topics(); }
  Result<RecordedItem> next() override {
    while (m_at < m_kept->messages.size()) {
      const KeptMessage& message = m_kept->messages[m_at++];
      const auto topic = m_topicOf.find(message.channel);
      if (topic == m_topicOf.end() || !m_topics.isWanted(topic->second)) continue;
      if (m_topics.decode(topic->second, message.payload,
                          static_cast<std::int64_t>(message.logTime), m_message)) {
        return RecordedItem::Message;
      }
    }
    return RecordedItem::End;
  }
  double progress() const override {
    return m_kept->messages.empty()
               ? 1.0
               : static_cast<double>(m_at) / static_cast<double>(m_kept->messages.size());
  }
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    m_topics.addNotes(notes);
    return notes;
  }

 private:
  std::shared_ptr<const BridgeMessages> m_kept;
  telemetry::DecodedTopics m_topics;
  std::map<std::uint32_t, std::size_t> m_topicOf;
  std::size_t m_at = 0;
};

/// Takes what the client has received. Images are not asked for.
class BridgeListener {
 public:
  explicit BridgeListener(const telemetry::FoxgloveAddress& address)
      : m_client(
            address, [] { return telemetry::LiveClock().now(); }, [this] { wake(); }) {}

  void waitUntil(SteadyClock::time_point time) {
    std::unique_lock lock(m_mutex);
    m_changed.wait_until(lock, time, [this] { return m_isWoken; });
    m_isWoken = false;
  }
  void take() {
    for (telemetry::FoxgloveEvent& event : m_client.take()) {
      if (const auto* begun = std::get_if<telemetry::FoxgloveBegun>(&event)) {
        m_session = begun->session;
      } else if (const auto* added = std::get_if<telemetry::FoxgloveChannelsAdded>(&event)) {
        subscribe(*added);
      } else if (auto* message = std::get_if<telemetry::FoxgloveReceived>(&event)) {
        kept->bytes += message->payload.size() + sizeof(KeptMessage);
        kept->messages.push_back({message->channel, message->logTime, std::move(message->payload)});
      }
    }
  }
  std::string problem() const { return m_client.status().problem; }

  std::shared_ptr<BridgeMessages> kept = std::make_shared<BridgeMessages>();

 private:
  void wake() {
    {
      const std::lock_guard lock(m_mutex);
      m_isWoken = true;
    }
    m_changed.notify_one();
  }
  void subscribe(const telemetry::FoxgloveChannelsAdded& added) {
    for (const FoxgloveChannel& channel : added.channels) {
      if (!kept->channels.try_emplace(channel.id, channel).second) continue;
      const std::size_t topic = m_topics.add(channel.topic, schemaOf(channel), 0);
      if (m_topics.isWanted(topic)) m_wanted.push_back(channel.id);
    }
    m_client.subscribe(m_session, m_wanted);
  }

  std::mutex m_mutex;
  std::condition_variable m_changed;
  bool m_isWoken = false;  ///< guarded by m_mutex
  telemetry::DecodedTopics m_topics;
  std::vector<std::uint32_t> m_wanted;
  std::uint64_t m_session = 0;
  telemetry::FoxgloveClient m_client;  ///< last: it calls wake() until it ends
};

}  // namespace

Result<OpenRecordings> listenToBridge(const telemetry::FoxgloveAddress& address, double seconds,
                                      const std::function<bool()>& goesOn) {
  constexpr auto betweenQuestions = std::chrono::milliseconds(100);
  BridgeListener listener(address);
  auto end = SteadyClock::now() + longestConnecting;
  bool isConnected = false;
  for (auto now = SteadyClock::now(); now < end; now = SteadyClock::now()) {
    if (goesOn && !goesOn()) return failure(ErrorCode::Conflict, "Listening was stopped.");
    listener.waitUntil(std::min(now + betweenQuestions, end));
    listener.take();
    if (!isConnected && !listener.kept->channels.empty()) {
      isConnected = true;
      end = SteadyClock::now() + std::chrono::duration_cast<SteadyClock::duration>(
                                     std::chrono::duration<double>(seconds));
    }
    if (listener.kept->bytes > maxBridgeSample) break;
  }
  if (!isConnected) {
    const std::string problem = listener.problem();
    if (!problem.empty()) return failure(ErrorCode::SystemError, problem, address.text());
    return failure(ErrorCode::NotFound, "It offers no topics.", address.text());
  }
  return OpenRecordings(
      [kept = std::shared_ptr<const BridgeMessages>(listener.kept)](
          const std::vector<MappedRecording>&) -> Result<std::vector<OpenedRecording>> {
        std::vector<OpenedRecording> opened(1);
        opened.front().reader = std::make_unique<BridgeReader>(kept);
        return opened;
      });
}

}  // namespace pitchboard::link
