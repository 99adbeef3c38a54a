// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Robots whose blackboard is on this computer: any System V segment, which is only read. A thread
// of its own samples each at a fixed rate. LiveWatch shows them like robots on the network; beside
// a simulated match they are rows. If a segment is removed this is reported, and sampling continues
// when it exists again.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/frame/match_frame.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

struct AttachedBoard {
  static constexpr double slowest = 0.1, fastest = 1000.0;
  int key = 100;
  std::string catalogFile;  ///< variable map; empty: the published one
  std::size_t bytes = 0;    ///< size of the segment; 0: as the catalog says
  int robot = 0;            ///< number on the shirt; 0: key / 100
  double rate = 60.0;       ///< samples per second
  TeamColor team = TeamColor::Blue;
  bool operator==(const AttachedBoard&) const = default;
  int number() const { return robot > 0 ? robot : std::max(1, key / 100); }
};

/// Reads "100,catalog=FILE,size=4096,robot=3,rate=100,team=red". Errors name the wrong part.
Result<AttachedBoard> parseAttachedBoard(std::string_view text);
/// Returns a text that parseAttachedBoard() reads back, if the catalog's path has no comma.
std::string attachedBoardText(const AttachedBoard& board);
/// Fails for a number out of range, two boards with one key, or a catalog that cannot be read.
Result<void> validate(const std::vector<AttachedBoard>& boards);

/// Returns the names of their groups, as in a simulation ("B3"). If a name occurs twice or is among
/// `taken`, the key is appended.
std::vector<std::string> boardNames(const std::vector<AttachedBoard>& boards,
                                    const std::vector<std::string>& taken = {});

/// Returns the link of a robot whose blackboard is read `rate` times a second. `age`: seconds since
/// the last sample. `detached`: the blackboard no longer exists, which counts as a timeout.
telemetry::LinkHealth boardLink(double age, double rate, bool detached);

/// A sample of a blackboard, as RowView.
struct BoardRow {
  double time = 0.0;  ///< s, of the source
  std::vector<std::uint32_t> words;
  std::vector<double> values{};
};

/// The state of one board.
struct AttachedStatus {
  AttachedBoard board;
  bool attached = false;
  std::string problem;  ///< why it is not attached; empty if it is
  std::uint64_t samples = 0, missed = 0;
  double rate = 0.0;  ///< samples per second, measured over the last second
};

/// Takes the rows of a board; called for each batch.
using BoardRowsTaker =
    std::function<void(const telemetry::GroupInfo& group, std::span<const BoardRow> rows)>;

/// How attached blackboards are shown: as robots of Live, or as rows beside a simulated match, to
/// whose robots they do not belong.
enum class AttachedTo : std::uint8_t { Live, Match };

class AttachedRobots {
 public:
  /// `seconds` returns the time for rows in s and is called on any thread. `catalog` is used for
  /// boards that name none.
  explicit AttachedRobots(std::function<double()> seconds, AttachedTo place = AttachedTo::Live,
                          VariableCatalog catalog = VariableCatalog::published());
  ~AttachedRobots();

  /// Attaches exactly these valid boards; unchanged ones continue.
  /// `taken` are names that their groups must not have.
  void set(const std::vector<AttachedBoard>& boards, const std::vector<std::string>& taken = {});
  /// Returns each board that was ever attached as a robot, with the name of its group.
  std::vector<RobotFrame> robots(
      const sim::FieldSpec& field,
      const telemetry::BatteryLimits& battery = telemetry::defaultBattery) const;
  /// Returns the rows since the last call.
  void drainRows(const BoardRowsTaker& take);
  std::vector<AttachedStatus> status() const;

 private:
  class Reader;
  const std::function<double()> m_seconds;
  const AttachedTo m_place;
  const VariableCatalog m_catalog;
  std::vector<std::unique_ptr<Reader>> m_readers;
};

/// Passes rows of boards to a sink, with a group per board.
class BoardRowKeeper {
 public:
  explicit BoardRowKeeper(std::shared_ptr<telemetry::RowSink> sink) : m_sink(std::move(sink)) {}
  /// The present name of a group, and what is known besides the facts of its board.
  struct Facts {
    std::string name;
    telemetry::RobotFacts robot;
    bool operator==(const Facts&) const = default;
  };
  /// Adds rows of a board that its name identifies.
  void take(const telemetry::GroupInfo& group, std::span<const BoardRow> rows) {
    take({}, group, {group.name, {}}, rows);
  }
  /// Adds rows of a board that `id` identifies (GroupInfo::id).
  void take(const std::string& id, const telemetry::GroupInfo& group, const Facts& facts,
            std::span<const BoardRow> rows);
  /// Gives groups other names and facts, all at once. `facts` is by id. Groups that are
  /// missing in it are not received any more; they keep their names, but give way.
  void describe(const std::map<std::string, Facts>& facts);

 private:
  struct Known {
    telemetry::GroupId id = 0;
    telemetry::GroupInfo info;
    std::optional<telemetry::RobotFacts> own;  // of the board
    void describe(const Facts& facts);
  };
  std::shared_ptr<telemetry::RowSink> m_sink;
  std::map<std::string, Known> m_groups;  // by GroupInfo::id, or by name
};

}  // namespace pitchboard::link
