// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Puts recordings of one match on one clock by an event that all of them have, such as the
// kick-off, whatever their clocks say. The states of the game come from the referee's log, or from
// the topic that the mapping names as the referee. Runs on the calling thread.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/live/topic_mapping.h>

namespace pitchboard::telemetry {
struct SessionInfo;
}

namespace pitchboard::link {

/// Makes each of `files` (files or folders) a recording of its own in the mapping. Fails with
/// Conflict if two have the same name, because the mapping could not tell them apart.
Result<void> nameRecordings(const std::vector<std::string>& files, TopicMapping& mapping);

/// Sets the offsets of `files`, which nameRecordings() has named, so that the event happens in all
/// when it happens in the first one. A kick-off is taken with that of the same half at the same
/// score, so that a recording may begin after the first goal. Fails with InvalidArgument if there
/// is one recording only, with NotFound if a recording does not have the event, with Conflict if
/// `goesOn` returns false, and as openTogether() does; then the mapping is as it was.
Result<void> alignRecordings(const std::vector<std::string>& files, AlignEvent event,
                             TopicMapping& mapping, const std::function<bool()>& goesOn = {});

/// Keeps in an imported session how its recordings were put on one clock.
void keepAlignment(const TopicMapping& mapping, telemetry::SessionInfo& info);
/// Returns a line for people, such as "aligned by the kick-off: robot3.mcap +2.500 s"; nothing for
/// sessions whose recordings have their own times.
std::optional<std::string> alignmentText(const telemetry::SessionInfo& info);

}  // namespace pitchboard::link
