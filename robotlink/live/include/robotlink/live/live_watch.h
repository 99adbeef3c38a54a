// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Watches a match of real robots. It receives and decodes their messages on threads of its own and
// provides frames (only the newest is kept) and events, with times of one clock (LiveClock). It
// sends nothing, except the monitor request to a referee if that is turned on. All public functions
// may be called from any thread.

#include <functional>
#include <memory>

#include <robotlink/live/live_observer.h>
#include <robotlink/live/live_options.h>
#include <telemetry/sockets/live_clock.h>

namespace pitchboard::link {

class LiveWatch {
 public:
  /// `onFrame` is called on the watch's thread when a new frame can be taken; it must not block.
  /// The options must be valid, see validate().
  explicit LiveWatch(LiveOptions options, std::function<void()> onFrame = {},
                     telemetry::ClockSource clock = telemetry::ClockSource::system());
  ~LiveWatch();  ///< stops receiving and waits for the threads
  LiveWatch(const LiveWatch&) = delete;
  LiveWatch& operator=(const LiveWatch&) = delete;

  /// Changes the options. Robots, link states and counters are kept; sockets are bound again if the
  /// ports differ.
  void setOptions(LiveOptions options);
  /// Forgets robots, referee and counters.
  void clear();
  /// Forgets a robot or second sender. It appears again with its next message.
  void forget(RobotUid robot);

  /// Returns the news and requests the next `onFrame`. Never waits for decoding: the frame is the
  /// last one that was finished.
  LiveNews take();
  /// Returns the details at the time of the last frame. Never waits for decoding.
  LiveDetails details() const;

  /// Returns the time of day at 0 s, by the computer's clock at that moment.
  telemetry::WallTime began() const;
  /// Calls the observer on the watch's thread, from the next datagram on that arrives.
  void observe(std::shared_ptr<LiveObserver> observer);
  /// The observer is not called after this returns: it waits until the watch's thread has passed on
  /// what has arrived. Not to be called by an observer.
  void stopObserving(const std::shared_ptr<LiveObserver>& observer);

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::link
