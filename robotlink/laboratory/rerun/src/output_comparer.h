// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Compares the outputs of a rerun with the recorded ones while it runs. A program that has no fixed
// cycle acts a little earlier or later each time; with a slack, a value counts as the same if the
// other side had it, too, within that time. Private to the module; one thread at a time.

#include <deque>
#include <span>
#include <utility>
#include <vector>

#include <robotlink/rerun/compared_variable.h>

namespace pitchboard::link {

class OutputComparer {
 public:
  /// `slack` in s. `unchanged` says where the unchanged program differs (--same): these stretches
  /// are left out. `exact`: every distance is a difference.
  OutputComparer(std::span<const telemetry::ColumnInfo> columns, double slack,
                 std::vector<ComparedVariable> unchanged, bool exact);

  /// Adds a moment with a value for each column, in order of time.
  void add(double time, std::span<const ComparedValue> values);
  void finish();

  const std::vector<ComparedVariable>& variables() const { return m_variables; }
  struct Begun {
    std::size_t variable = 0;
    DifferentStretch stretch;
  };
  /// Returns the stretches that began since the last call.
  std::vector<Begun> drainBegun() { return std::exchange(m_begun, {}); }

 private:
  struct Moment {
    double time = 0.0;
    ComparedValue value;
  };
  struct Track {
    std::deque<Moment> moments;  // within the slack of the next one that is judged
    std::size_t next = 0;        // of them: not judged yet
    bool isOpen = false;         // the last stretch
  };
  void judge(std::size_t index, const Moment& moment);
  void close(std::size_t index, double time);
  void judgeTo(std::size_t index, double time);
  bool isAlike(const ComparedVariable& variable, double a, double b) const;
  bool isLate(std::size_t index, const Moment& moment) const;
  bool differsUnchanged(const std::string& name, double time) const;

  std::vector<ComparedVariable> m_variables, m_unchanged;
  std::vector<Track> m_tracks;
  std::vector<Begun> m_begun;
  double m_slack;
};

}  // namespace pitchboard::link
