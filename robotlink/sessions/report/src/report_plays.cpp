// SPDX-License-Identifier: GPL-3.0-or-later
// The sections of a report about play: figures of both teams, pictures of the goals, heat maps, set
// plays, and the list of plays.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <base/duration_text.h>
#include <robotlink/report/field_svg.h>
#include <robotlink/report/report_page.h>

#include "report_parts.h"

namespace pitchboard::link {

std::string clockText(double seconds) {
  const auto total = static_cast<long long>(std::clamp(std::floor(seconds), -1e9, 1e9));
  const long long s = std::abs(total);
  const auto two = [](long long value) { return (value < 10 ? "0" : "") + std::to_string(value); };
  const std::string sign = total < 0 ? "−" : "";
  if (s >= 3600)
    return sign + std::to_string(s / 3600) + ':' + two(s / 60 % 60) + ':' + two(s % 60);
  return sign + std::to_string(s / 60) + ':' + two(s % 60);
}

std::string tenths(double seconds) {
  return '.' + std::to_string(static_cast<int>(std::fmod(std::abs(seconds), 1.0) * 10.0));
}

std::string capital(std::string_view word) {
  std::string out(word);
  if (!out.empty() && out[0] >= 'a' && out[0] <= 'z')
    out[0] = static_cast<char>(out[0] - 'a' + 'A');
  return out;
}

std::string cell(const std::string& text, const char* kind, const std::string& sortsBy) {
  return std::string("<td") + (*kind ? std::string(" class=\"") + kind + '"' : "") +
         (sortsBy.empty() ? "" : " data-v=\"" + sortsBy + '"') + '>' + text + "</td>";
}

std::string teamClass(TeamColor team) {
  return std::string(info(team).name);
}

std::string titleOf(const TeamSummary& team) {
  return team.name.empty() ? capital(info(team.team).name) : escaped(team.name);
}

std::string badge(const RobotSummary& robot) {
  return "<span class=\"badge " + teamClass(robot.team) + "\">" + escaped(robot.name) + "</span>" +
         (robot.ownName.empty() ? "" : " " + escaped(robot.ownName));
}

std::string momentText(const ReportContent& content, double time) {
  const std::string text = clockText(time) + tenths(time);
  const auto clip = std::ranges::find_if(content.clips, [time](const ReportClip& one) {
    return time >= one.range.begin && time <= one.range.end;
  });
  return clip == content.clips.end() ? text
                                     : "<a href=\"" + escaped(clip->href) + "\">" + text + "</a>";
}

std::string momentCell(const ReportContent& content, double time) {
  return cell(momentText(content, time), "", fixed(time, 3));
}

namespace {

constexpr std::size_t maxPlays = 5000;
/// The colours of teams on the field of a picture, as the studio's dark field has them.
std::string fieldColour(TeamColor team) {
  static const std::pair<TeamColor, const char*> colours[] = {{TeamColor::Blue, "#4f8fe3"},
                                                              {TeamColor::Red, "#e5645e"},
                                                              {TeamColor::Black, "#8b939d"},
                                                              {TeamColor::Orange, "#e8a25c"},
                                                              {TeamColor::Yellow, "#d8c04a"}};
  for (const auto& [colour, text] : colours) {
    if (colour == team) return text;
  }
  return "#dfe3e8";
}

std::string percent(double part, double whole) {
  return whole > 0.0 ? fixed(100.0 * part / whole, 0) + " %" : "–";
}

struct Figure {
  const char* name;
  std::function<double(const TeamSummary&)> value;
  std::function<std::string(const TeamSummary&)> text;
};

}  // namespace

/// Two teams side by side, with bars: what a coach looks at first.
std::string figuresSection(const MatchStatistics& s) {
  if (s.teams.size() != 2) return {};
  const double ball = s.teams[0].ballSeconds + s.teams[1].ballSeconds;
  const auto count = [](double value) { return fixed(value, 0); };
  const auto passes = [](const PlayCounts& p) { return p.passes + p.intercepted; };
  const Figure figures[] = {
      {"Possession", [](const TeamSummary& t) { return t.ballSeconds; },
       [&](const TeamSummary& t) { return percent(t.ballSeconds, ball); }},
      {"Shots", [](const TeamSummary& t) { return t.plays.shots; },
       [&](const TeamSummary& t) { return count(t.plays.shots); }},
      {"On target", [](const TeamSummary& t) { return t.plays.onTarget; },
       [&](const TeamSummary& t) { return count(t.plays.onTarget); }},
      {"Passes completed", [](const TeamSummary& t) { return t.plays.passes; },
       [&](const TeamSummary& t) {
         return count(t.plays.passes) + " of " + count(passes(t.plays));
       }},
      {"Balls won", [](const TeamSummary& t) { return t.plays.wins; },
       [&](const TeamSummary& t) { return count(t.plays.wins); }},
      {"Distance", [](const TeamSummary& t) { return t.distance; },
       [](const TeamSummary& t) { return fixed(t.distance, 0) + " m"; }},
      {"Falls", [](const TeamSummary& t) { return t.falls; },
       [&](const TeamSummary& t) { return count(t.falls); }},
      {"Penalties", [](const TeamSummary& t) { return t.penalties; },
       [&](const TeamSummary& t) { return count(t.penalties); }}};
  const TeamSummary &left = s.teams[0], &right = s.teams[1];
  std::string out = "<div class=\"figures\">\n";
  for (const Figure& one : figures) {
    const double a = one.value(left), b = one.value(right);
    const double share = a + b > 0.0 ? 100.0 * a / (a + b) : 50.0;
    out += "<div><b>" + one.text(left) + "</b><span>" + one.name + "</span><b>" + one.text(right) +
           "</b></div><div class=\"duel" + (a + b > 0.0 ? "" : " none") + "\"><i class=\"" +
           teamClass(left.team) + "\" style=\"width:" + fixed(share, 1) + "%\"></i><i class=\"" +
           teamClass(right.team) + "\" style=\"width:" + fixed(100.0 - share, 1) +
           "%\"></i></div>\n";
  }
  return out + "</div>\n";
}

std::string goalsSection(const ReportContent& c) {
  const MatchStatistics& s = c.statistics;
  if (s.goals.empty()) return {};
  std::string out =
      "<h2>Goals</h2>\n<p class=\"quiet\">White: the ball's last seconds. Circles: the robots when "
      "it went in, with their way.</p>\n<div class=\"pictures\">\n";
  for (const GoalScene& scene : s.goals) {
    std::vector<FieldTrajectory> paths;
    for (const GoalScene::Path& robot : scene.robots) {
      paths.push_back({robot.points, fieldColour(robot.team), 0.9, 0.05, robot.name});
    }
    paths.push_back({scene.ball, "#ffffff", 1.0, 0.06});
    const PlayEvent& goal = scene.goal;
    const TeamSummary* team = s.team(goal.team);
    std::string text = "<b>" + (team ? titleOf(*team) : std::string(info(goal.team).name)) + "</b>";
    if (!goal.name.empty()) text += ", " + escaped(goal.name);
    if (goal.from) {
      const double x = std::copysign(s.field.halfLength(), scene.ball.back().x);
      text += " from " + fixed(distance(*goal.from, {x, 0.0}), 1) + " m";
    }
    out += "<figure class=\"" + teamClass(goal.team) + "\">" + fieldSvg(s.field, paths) +
           "<figcaption>" + momentText(c, goal.time) + ' ' + text + "</figcaption></figure>\n";
  }
  return out + "</div>\n";
}

std::string heatSection(const MatchStatistics& s) {
  std::string out;
  for (const RobotSummary& robot : s.robots) {
    const HeatMap& heat = robot.heat;
    if (heat.seconds.empty()) continue;
    const float most = *std::ranges::max_element(heat.seconds);
    if (!(most > 0.0F)) continue;
    std::string squares;
    for (int i = 0; i < heat.columns * heat.rows; ++i) {
      const double share = std::sqrt(heat.seconds[static_cast<std::size_t>(i)] / most);
      if (share < 0.03) continue;
      const int column = i % heat.columns, row = i / heat.columns;
      const double size = 100.0 * HeatMap::square;
      const double x = column * size - 100.0 * (s.field.halfLength() + s.field.border);
      const double y = 100.0 * (s.field.halfWidth() + s.field.border) - (row + 1) * size;
      squares += "<rect x=\"" + fixed(x, 0) + "\" y=\"" + fixed(y, 0) + "\" width=\"" +
                 fixed(size, 0) + "\" height=\"" + fixed(size, 0) +
                 "\" fill=\"#f2c14e\" opacity=\"" + fixed(0.9 * share, 2) + "\"/>";
    }
    out += "<figure>" + fieldSvg(s.field, {}, squares) + "<figcaption>" + badge(robot) + " " +
           (robot.distance ? fixed(*robot.distance, 0) + " m in " : "") + clockText(robot.seconds) +
           "</figcaption></figure>\n";
  }
  if (out.empty()) return {};
  return "<h2>Where they played</h2>\n<p class=\"quiet\">Each team plays to the right. Bright: the "
         "robot was there for long.</p>\n<div class=\"pictures small\">\n" +
         out + "</div>\n";
}

std::string setPlaysSection(const ReportContent& c) {
  std::string rows;
  for (const PlayEvent& play : c.statistics.plays) {
    if (play.kind != PlayKind::SetPlay) continue;
    rows += "<tr>" + momentCell(c, play.time) + cell(escaped(capital(play.detail)), "l") +
            cell("<span class=\"badge " + teamClass(play.team) + "\">" +
                     std::string(info(play.team).name) + "</span>",
                 "l") +
            cell(escaped(play.name), "l") + cell(capital(labelOf(play.outcome)), "l") + "</tr>\n";
  }
  if (rows.empty()) return {};
  return "<h2>Set plays</h2>\n<div class=\"scroll\"><table "
         "class=\"sorts\"><thead><tr><th>Time</th><th "
         "class=\"l\">Set play</th><th class=\"l\">Team</th><th class=\"l\">Taken by</th><th "
         "class=\"l\">What came of it</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string playsSection(const ReportContent& c) {
  std::string rows;
  std::size_t count = 0;
  for (const PlayEvent& play : c.statistics.plays) {
    if (play.kind == PlayKind::SetPlay || ++count > maxPlays) continue;
    rows += "<tr>" + momentCell(c, play.time) + cell(capital(labelOf(play.kind)), "l") +
            cell("<span class=\"badge " + teamClass(play.team) + "\">" +
                     escaped(play.name.empty() ? info(play.team).name : play.name) + "</span>",
                 "l") +
            cell(escaped(sentenceOf(play)), "l") + "</tr>\n";
  }
  if (rows.empty()) return {};
  return "<h2>Play by play</h2>\n<div class=\"scroll\"><table "
         "class=\"sorts\"><thead><tr><th>Time</th><th class=\"l\">Kind</th><th "
         "class=\"l\">Robot</th><th class=\"l\">What</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

}  // namespace pitchboard::link
