// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/library/session_overview.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include <base/lenient_json.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_choice.h>
#include <robotlink/session/session_events.h>
#include <telemetry/series/group_order.h>

namespace pitchboard::link {
namespace {

namespace lenient = lenient;
using Json = nlohmann::ordered_json;

constexpr std::size_t maxNoteBytes = 4096, maxNames = 200;
constexpr double beforeGoal = 0.1;  // s; then the ball is about to cross the line

std::string teamText(const MatchFrame& frame, const GameTeam& team) {
  if (const auto name = teamName(team.number, frame.teams); !name.empty()) return std::string(name);
  return team.colour == TeamColor::Unknown ? "team " + std::to_string(team.number)
                                           : std::string(info(team.colour).name);
}

/// Of a simulated match, whose teams are known by their colours.
std::string teamText(const MatchFrame& frame, Side side) {
  std::vector<sim::RobotIdentity> robots;
  for (const RobotFrame& robot : frame.robots) robots.push_back(robot.identity);
  const TeamColor colour = teamOn(side, robots);
  const auto known = std::ranges::find(frame.teams, colour, &Team::colour);
  return known == frame.teams.end() || known->name.empty() ? std::string(info(colour).name)
                                                           : known->name;
}

/// Where neither a referee nor a simulation says it: the teams that the robots belong to.
std::vector<std::string> teamsOfRobots(const telemetry::SessionReader& session) {
  std::vector<std::string> teams;
  for (const telemetry::SessionGroup& group : session.groups()) {
    const telemetry::RobotFacts& facts = factsOf(group.info);
    std::string name = facts.teamName;
    if (name.empty() && facts.team) name = info(*facts.team).name;
    if (!name.empty() && std::ranges::find(teams, name) == teams.end()) teams.push_back(name);
  }
  return teams;
}

void takeEnd(const telemetry::SessionReader& session, double end, SessionOverview& out) {
  RecordedFrames frames(backdropOf(session));
  const MatchFrame frame = frames.frameAt(session, end);
  if (frame.game) {
    const GameTeam &left = frame.game->teamAt(false), &right = frame.game->teamAt(true);
    out.teams = {teamText(frame, left), teamText(frame, right)};
    out.score = {left.score, right.score};
  } else if (out.source == "simulation" && frame.ballKnown) {
    out.teams = {teamText(frame, Side::Left), teamText(frame, Side::Right)};
    out.score = {frame.snapshot.score.left, frame.snapshot.score.right};
  } else {
    out.teams = teamsOfRobots(session);
  }
}

void takeRobots(const telemetry::SessionReader& session, SessionOverview& out) {
  std::set<RobotUid> known;
  for (const std::size_t g :
       telemetry::listedOrder(session.groups(), &telemetry::SessionGroup::info)) {
    const telemetry::GroupInfo& group = session.groups()[g].info;
    const RobotUid uid = uidOf(group, static_cast<telemetry::GroupId>(g));
    if (uid != RobotUid{} && known.insert(uid).second) out.robots.push_back(group.name);
  }
}

void takeEvents(const telemetry::SessionReader& session, telemetry::TimeRange range,
                SessionOverview& out) {
  std::optional<double> goal, kick;
  std::size_t bytes = 0;
  for (const MatchEvent& event : eventsOf(session)) {
    if (event.kind == MatchEventKind::Bookmark) {
      ++out.bookmarks;
      bytes += event.detail.size();
      if (!event.detail.empty() && bytes <= maxNoteBytes) out.notes.push_back(event.detail);
      continue;
    }
    ++out.events;
    if (event.kind == MatchEventKind::Goal) goal = event.time - beforeGoal;
    if (event.kind == MatchEventKind::Kick) kick = event.time;
  }
  const double middle = (range.begin + range.end) / 2.0;
  out.telling = std::clamp(goal ? *goal : kick.value_or(middle), range.begin, range.end);
}

std::string problemOf(const telemetry::SessionReader& session) {
  if (session.isGrowing()) return "Still being recorded.";
  if (!session.complete() || session.isDamaged()) {
    return "Truncated or damaged; the readable part is shown.";
  }
  return session.range() ? std::string() : "The recording is empty.";
}

}  // namespace

SessionOverview overviewOf(const std::string& path, const std::function<bool()>& goOn) {
  SessionOverview out;
  telemetry::McapReaderOptions reading;
  if (goOn) reading.progress = [&goOn](double) { return goOn(); };
  const auto session = telemetry::SessionReader::open(path, reading);
  if (!session) {
    out.problem = session.error().message;
    return out;
  }
  if (session->isForeign()) {
    out.problem =
        session->notes().empty() ? "Another program recorded this file." : session->notes().back();
    return out;
  }
  out.isReadable = true;
  out.created = session->info().created;
  out.source = session->info().source;
  out.title = session->info().title;
  takeRobots(*session, out);
  if (const auto range = session->range()) {
    out.length = range->end - range->begin;
    takeEnd(*session, range->end, out);
    takeEvents(*session, *range, out);
  }
  out.problem = problemOf(*session);  // what was read may have been damaged
  return out;
}

std::string overviewJson(const SessionOverview& overview) {
  Json json{{"readable", overview.isReadable}};
  if (!overview.problem.empty()) json["problem"] = overview.problem;
  if (overview.isReadable) {
    using Seconds = std::chrono::duration<double>;
    json["created"] = Seconds(overview.created.time_since_epoch()).count();
    json["source"] = overview.source;
    json["title"] = overview.title;
    json["length"] = overview.length;
    json["teams"] = overview.teams;
    json["score"] = overview.score ? Json{overview.score->first, overview.score->second} : Json();
    json["robots"] = overview.robots;
    json["events"] = overview.events;
    json["bookmarks"] = overview.bookmarks;
    json["notes"] = overview.notes;
    json["telling_moment"] = overview.telling;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<SessionOverview> overviewFromJson(std::string_view text) {
  const Json json = lenient::parsed<Json>(text);
  if (!json.is_object() || lenient::member(json, "readable") == nullptr) return {};
  SessionOverview out;
  out.isReadable = lenient::flag(json, "readable");
  out.problem = lenient::text(json, "problem");
  constexpr double maxCreated = 9e9;  // s since 1970; nanoseconds must fit
  const double created = lenient::number(json, "created").value_or(0.0);
  if (created > 0.0 && created < maxCreated) {
    out.created = telemetry::WallTime(std::chrono::microseconds(std::llround(created * 1e6)));
  }
  out.source = lenient::text(json, "source");
  out.title = lenient::text(json, "title");
  out.length = std::max(0.0, lenient::number(json, "length").value_or(0.0));
  const auto texts = [&json](const char* key, std::vector<std::string>& to) {
    lenient::each(json, key, maxNames, [&to](std::size_t, const Json& one) {
      if (one.is_string()) to.push_back(one.get<std::string>());
    });
  };
  texts("teams", out.teams);
  texts("robots", out.robots);
  texts("notes", out.notes);
  std::vector<int> score;
  lenient::each(json, "score", 2, [&score](std::size_t, const Json& one) {
    if (one.is_number_integer()) score.push_back(one.get<int>());
  });
  if (score.size() == 2) out.score = {score[0], score[1]};
  out.events = lenient::whole<std::uint64_t>(json, "events");
  out.bookmarks = lenient::whole<std::uint64_t>(json, "bookmarks");
  out.telling = lenient::number(json, "telling_moment").value_or(0.0);
  return out;
}

std::string teamsText(const SessionOverview& overview) {
  std::string text;
  for (const std::string& team : overview.teams) text += (text.empty() ? "" : " – ") + team;
  return text;
}

std::string scoreText(const SessionOverview& overview) {
  return overview.score ? std::to_string(overview.score->first) + " : " +
                              std::to_string(overview.score->second)
                        : std::string();
}

}  // namespace pitchboard::link
