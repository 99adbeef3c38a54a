// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/opened_recordings.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <base/try.h>

namespace pitchboard::link {
namespace {

using telemetry::RecordedItem;

}  // namespace

std::string fileNameOf(const std::string& path) {
  const std::filesystem::path whole(path);
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

Result<void> OpenedRecording::step() {
  item = TRY(reader->next());
  if (item == RecordedItem::Message) {
    const telemetry::RecordedMessage& message = reader->message();
    if (timing.clock == RecordingClock::Log || !message.stamp || *message.stamp <= 0) {
      time = message.logTime;
    } else {
      time = timing.clock == RecordingClock::Header ? *message.stamp : stamps.timeOf(message);
    }
  } else if (item == RecordedItem::Datagram) {
    time = reader->datagram().time;
  }
  if (timing.offset != 0.0) time += std::llround(timing.offset * 1e9);
  return {};
}

Result<std::vector<OpenedRecording>> openTogether(const std::vector<std::string>& files,
                                                  const std::vector<MappedRecording>& recordings,
                                                  const std::function<bool(double)>& progress) {
  std::vector<OpenedRecording> opened;
  std::vector<std::string> others;
  const auto add = [&](const std::vector<std::string>& paths,
                       const MappedRecording& timing) -> Result<void> {
    for (auto& reader : TRY(telemetry::openRecordings(paths, progress))) {
      opened.emplace_back();
      opened.back().reader = std::move(reader);
      opened.back().timing = timing;
    }
    return {};
  };
  for (const std::string& file : files) {
    const auto known = std::ranges::find(recordings, fileNameOf(file), &MappedRecording::file);
    if (known == recordings.end()) {
      others.push_back(file);
    } else {
      TRY(add({file}, *known));
    }
  }
  if (!others.empty()) TRY(add(others, {}));
  return opened;
}

OpenedRecording* earliestOf(std::vector<OpenedRecording>& recordings) {
  OpenedRecording* next = nullptr;
  for (OpenedRecording& one : recordings) {
    if (one.item == RecordedItem::End) continue;
    if (next == nullptr || one.time < next->time) next = &one;
  }
  return next;
}

std::vector<telemetry::RecordedTopic> topicsOf(const std::vector<OpenedRecording>& recordings) {
  std::vector<telemetry::RecordedTopic> topics;
  for (const OpenedRecording& one : recordings) {
    const auto& own = one.reader->topics();
    topics.insert(topics.end(), own.begin(), own.end());
  }
  return topics;
}

}  // namespace pitchboard::link
