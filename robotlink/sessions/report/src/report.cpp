// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/report.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include <base/base64.h>
#include <base/duration_text.h>
#include <robotlink/report/report_page.h>
#include <robotlink/report/session_tally.h>

#include "report_parts.h"

namespace pitchboard::link {
namespace {

constexpr double width = 440, height = 110;                    // of the drawing
constexpr double left = 40, right = 6, top = 10, bottom = 20;  // room round the curve
constexpr double plotWidth = width - left - right, plotHeight = height - top - bottom;

std::string frame(const std::string& highest, telemetry::TimeRange range,
                  const std::string& inside) {
  const auto at = [](double value) { return fixed(value, 1); };
  const double foot = top + plotHeight;
  std::string out = "<svg class=\"chart\" viewBox=\"0 0 " + at(width) + ' ' + at(height) + "\">";
  for (const double y : {top, top + plotHeight / 2, foot}) {
    out += "<line class=\"grid\" x1=\"" + at(left) + "\" y1=\"" + at(y) + "\" x2=\"" +
           at(width - right) + "\" y2=\"" + at(y) + "\"/>";
  }
  out += inside;
  const auto text = [&](double x, double y, const char* anchor, const std::string& label) {
    out += "<text class=\"axis\" x=\"" + at(x) + "\" y=\"" + at(y) + "\" text-anchor=\"" + anchor +
           "\">" + label + "</text>";
  };
  text(left - 5, top + 4, "end", highest);
  text(left - 5, foot + 4, "end", "0");
  text(left, height - 4, "start", clockText(range.begin));
  text(left + plotWidth / 2, height - 4, "middle", clockText((range.begin + range.end) / 2));
  text(width - right, height - 4, "end", clockText(range.end));
  return out + "</svg>";
}

/// A round number at or above `value`, for the top of an axis.
double axisTop(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= step * power) return step * power;
  }
  return 10.0 * power;
}

/// A curve over the time of the report; `most` is the top of the axis. NaN parts are gaps.
std::string curveChart(const std::vector<double>& values, double most, const std::string& unit,
                       telemetry::TimeRange range) {
  const double foot = top + plotHeight;
  std::string curve, area, run;
  double runStart = 0.0, lastX = 0.0;
  const auto endRun = [&] {
    if (run.empty()) return;
    curve += 'M' + run;
    area += 'M' + fixed(runStart, 1) + ' ' + fixed(foot, 1) + 'L' + run + 'L' + fixed(lastX, 1) +
            ' ' + fixed(foot, 1) + 'Z';
    run.clear();
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      endRun();
      continue;
    }
    const double x =
        left + plotWidth * (static_cast<double>(i) + 0.5) / static_cast<double>(values.size());
    const double y = foot - plotHeight * std::clamp(values[i] / most, 0.0, 1.0);
    if (run.empty()) {
      runStart = x;
    } else {
      run += 'L';
    }
    run += fixed(x, 1) + ' ' + fixed(y, 1);
    lastX = x;
  }
  endRun();
  return frame(
      fixed(most, most < 1 ? 1 : 0) + (unit.empty() ? "" : " " + unit), range,
      "<path class=\"area\" d=\"" + area + "\"/><path class=\"curve\" d=\"" + curve + "\"/>");
}

/// Shares from 0 to 1, a bar for each part.
std::string shareChart(const std::vector<double>& shares, telemetry::TimeRange range) {
  std::string bars;
  const double each = plotWidth / static_cast<double>(std::max<std::size_t>(1, shares.size()));
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double tall = plotHeight * std::clamp(shares[i], 0.0, 1.0);
    if (tall < 0.1) continue;
    bars += "<rect class=\"bar\" x=\"" + fixed(left + each * static_cast<double>(i), 2) +
            "\" y=\"" + fixed(top + plotHeight - tall, 1) + "\" width=\"" + fixed(each * 0.9, 2) +
            "\" height=\"" + fixed(tall, 1) + "\"/>";
  }
  return frame("100 %", range, bars);
}

constexpr std::size_t maxEvents = 5000;
constexpr double lowUptime = 0.9;

std::string wallText(telemetry::WallTime time) {
  if (time.time_since_epoch().count() <= 0) return {};
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::seconds>(time));
  std::tm parts{};
  char text[64];
  if (!::localtime_r(&seconds, &parts) ||
      std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &parts) == 0) {
    return {};
  }
  return text;
}

/// "blue, team 12 · by half 1 + 0".
std::string teamFacts(const TeamSummary& team) {
  std::string out(info(team.team).name);
  if (team.number.value_or(0) > 0) out += ", team " + std::to_string(*team.number);
  for (std::size_t i = 0; team.byHalf.size() > 1 && i < team.byHalf.size(); ++i) {
    out += (i == 0 ? " · by half " : " + ") + std::to_string(team.byHalf[i]);
  }
  return out;
}

std::string head(const ReportContent& c) {
  const MatchStatistics& s = c.statistics;
  std::string facts;
  const auto fact = [&facts](const std::string& text) {
    if (!text.empty()) facts += (facts.empty() ? "" : " · ") + text;
  };
  fact(escaped(wallText(c.session.start)));
  fact(clockText(s.range.end - s.range.begin) + " of play recorded");
  fact(c.session.source == "live"         ? "real robots"
       : c.session.source == "simulation" ? "simulated"
                                          : escaped(c.session.source));
  if (c.session.seed) fact("seed " + std::to_string(*c.session.seed));
  std::string out = "<h1>" + escaped(c.title.empty() ? "Match report" : c.title) +
                    "</h1>\n<p class=\"quiet\">" + facts + "</p>\n";
  for (const std::string& note : c.notes) out += "<p class=\"note\">" + escaped(note) + "</p>\n";
  return out;
}

std::string teams(const MatchStatistics& s) {
  if (s.teams.empty()) return {};
  std::string out = "<div class=\"score\">\n";
  for (const TeamSummary& team : s.teams) {
    out += "<div class=\"team " + teamClass(team.team) + "\">" + titleOf(team) +
           (team.name.empty() ? " team<b>" : "<b>") +
           (team.score ? std::to_string(*team.score) : "–") + "</b><span class=\"quiet\">" +
           teamFacts(team) + "<br>" + clockText(team.ballSeconds) + " with the ball · " +
           std::to_string(team.kicks) + (team.kicks == 1 ? " kick" : " kicks") + " · " +
           std::to_string(team.plays.passes) + (team.plays.passes == 1 ? " pass" : " passes") +
           " · " + std::to_string(team.falls) + (team.falls == 1 ? " fall" : " falls") + " · " +
           fixed(team.distance, 0) + " m</span></div>\n";
  }
  return out + "</div>\n";
}

std::string picture(const ReportContent& c) {
  if (c.picture.empty()) return {};
  const bool png = c.picture.starts_with("\x89PNG");
  return "<h2>Field</h2>\n<figure><img alt=\"The field\" src=\"data:image/" +
         std::string(png ? "png" : "svg+xml") + ";base64," + toBase64(c.picture) + "\">" +
         (c.pictureCaption.empty() ? ""
                                   : "<figcaption>" + escaped(c.pictureCaption) + "</figcaption>") +
         "</figure>\n";
}

std::string robots(const MatchStatistics& s) {
  std::string out = "<h2>Robots</h2>\n";
  if (s.robots.empty()) return out + "<p class=\"quiet\">No robot was recorded.</p>\n";
  out +=
      "<div class=\"scroll\"><table class=\"sorts\"><thead><tr><th class=\"l\">Robot</th>"
      "<th>Distance</th><th>Kicks</th><th>Passes</th><th>Shots</th><th>Balls won</th><th>Balls "
      "lost</th><th>Falls</th><th>Penalties</th><th>With the ball</th>";
  if (s.truthKnown) out += "<th>Belief error, median</th><th>90 %</th>";
  out += "</tr></thead><tbody>\n";
  for (const RobotSummary& r : s.robots) {
    out += "<tr>" + cell(badge(r), "l") + cell(r.distance ? fixed(*r.distance, 1) + " m" : "–") +
           cell(std::to_string(r.kicks)) + cell(std::to_string(r.plays.passes)) +
           cell(std::to_string(r.plays.shots)) + cell(std::to_string(r.plays.wins)) +
           cell(std::to_string(r.plays.losses)) + cell(std::to_string(r.falls)) +
           cell(std::to_string(r.penalties)) + cell(fixed(r.ballSeconds, 1) + " s");
    if (s.truthKnown) {
      out += cell(r.errorMedian ? fixed(*r.errorMedian, 1) + " cm" : "–") +
             cell(r.error90 ? fixed(*r.error90, 1) + " cm" : "–");
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string processes(const MatchStatistics& s) {
  if (s.robots.empty()) return {};
  std::string out =
      "<h2>Processes</h2>\n<p class=\"quiet\">Share of the time in which "
      "each process reported that it was working.</p>\n<div class=\"scroll\"><table><thead><tr><th "
      "class=\"l\">"
      "Robot</th>";
  for (const std::string_view name : telemetry::processNames)
    out += "<th>" + std::string(name) + "</th>";
  out += "</tr></thead><tbody>\n";
  for (const RobotSummary& r : s.robots) {
    out += "<tr>" + cell(badge(r), "l");
    for (const auto& share : r.uptime) {
      out +=
          share ? cell(fixed(100 * *share, 1) + " %", *share < lowUptime ? "low" : "") : cell("–");
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

/// "2 times, 37 s"
std::string outagesText(const RobotSummary::Link& link) {
  if (link.outages.empty()) return "never";
  double seconds = 0.0;
  for (const RobotSummary::Outage& outage : link.outages) seconds += outage.end - outage.begin;
  return (link.outages.size() == 1 ? "once" : std::to_string(link.outages.size()) + " times") +
         ", " + durationText(seconds);
}

std::string links(const MatchStatistics& s) {
  if (std::ranges::none_of(s.robots, [](const RobotSummary& r) { return r.link.has_value(); })) {
    return {};
  }
  std::string out =
      "<h2>Connection</h2>\n<div class=\"scroll\"><table><thead><tr><th class=\"l\">Robot"
      "</th><th>Received</th><th>Messages</th><th>Lost</th><th>Offline</th>"
      "<th>Least battery</th></tr></thead><tbody>\n";
  for (const RobotSummary& r : s.robots) {
    if (!r.link) continue;
    out +=
        "<tr>" + cell(badge(r), "l") +
        cell(fixed(100 * r.link->received, 1) + " %", r.link->received < lowUptime ? "low" : "") +
        cell(std::to_string(r.link->messages)) +
        cell(r.link->loss ? fixed(100 * *r.link->loss, 1) + " %" : "–") +
        cell(outagesText(*r.link)) +
        cell(r.link->minVolts ? fixed(*r.link->minVolts, 1) + " V" : "–") + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

/// When robots sent nothing, in order of time.
std::string outages(const MatchStatistics& s) {
  std::vector<std::pair<const RobotSummary*, RobotSummary::Outage>> all;
  for (const RobotSummary& r : s.robots) {
    if (!r.link) continue;
    for (const RobotSummary::Outage& outage : r.link->outages) all.emplace_back(&r, outage);
  }
  if (all.empty()) return {};
  std::ranges::stable_sort(all, {}, [](const auto& one) { return one.second.begin; });
  std::string out =
      "<h2>Outages</h2>\n<p class=\"quiet\">From the last message to the next one.</p>\n<div "
      "class=\"scroll\"><table><thead><tr><th class=\"l\">Robot</th><th>From</th><th>To</th>"
      "<th>Offline for</th></tr></thead><tbody>\n";
  for (const auto& [robot, outage] : all) {
    out += "<tr>" + cell(badge(*robot), "l") +
           cell(clockText(outage.begin) + tenths(outage.begin)) +
           cell(outage.isOver ? clockText(outage.end) + tenths(outage.end) : "not back") +
           cell(durationText(outage.end - outage.begin)) + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string charts(const MatchStatistics& s) {
  std::string errors, ball;
  // A robot that has just begun to look for itself is anywhere: the scale is that of ordinary play.
  double most = 0.0;
  for (const RobotSummary& r : s.robots) most = std::max(most, 2.0 * r.error90.value_or(0.0));
  for (const RobotSummary& r : s.robots) {
    if (r.errorCurve.empty()) continue;
    errors += "<figure class=\"" + teamClass(r.team) + "\"><h3><span>" + escaped(r.name) +
              "</span><span class=\"quiet\">median " + fixed(r.errorMedian.value_or(NAN), 1) +
              " cm</span></h3>" + curveChart(r.errorCurve, axisTop(most), "cm", s.range) +
              "</figure>\n";
  }
  for (const TeamSummary& team : s.teams) {
    if (team.ballCurve.empty()) continue;
    ball += "<figure class=\"" + teamClass(team.team) + "\"><h3><span>" + titleOf(team) +
            "</span><span class=\"quiet\">" + clockText(team.ballSeconds) + "</span></h3>" +
            shareChart(team.ballCurve, s.range) + "</figure>\n";
  }
  std::string out;
  if (!ball.empty()) {
    out +=
        "<h2>Who had the ball</h2>\n<p class=\"quiet\">Share of the time in which a robot of the "
        "team was nearest to the ball and within " +
        fixed(100 * ballReach, 0) + " cm of it.</p>\n<div class=\"charts\">\n" + ball + "</div>\n";
  }
  if (!errors.empty()) {
    out +=
        "<h2>Belief error</h2>\n<p class=\"quiet\">Distance between where a robot believed to be "
        "and "
        "where it was, averaged. Values beyond the scale are cut off.</p>\n<div "
        "class=\"charts\">\n" +
        errors + "</div>\n";
  }
  return out;
}

std::string eventTable(const std::vector<const MatchEvent*>& events) {
  std::string out =
      "<div class=\"scroll\"><table><thead><tr><th>Time</th><th class=\"l\">Event</th>"
      "<th class=\"l\">Robot</th><th class=\"l\">What</th></tr></thead><tbody>\n";
  for (const MatchEvent* e : events) {
    out += "<tr>" + cell(clockText(e->time) + tenths(e->time)) +
           cell(escaped(info(e->kind).name), "l") + cell(escaped(e->name), "l") +
           cell(escaped(sentenceOf(*e)), "l") + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string events(const ReportContent& c) {
  std::vector<const MatchEvent*> main, kicks;
  for (const auto& event : c.events) {
    if (event.time < c.statistics.range.begin || event.time > c.statistics.range.end) continue;
    // Kicks are many, and who sees the ball is for the timeline: without them the list shows how
    // the match went.
    if (event.kind == MatchEventKind::BallSeen || event.kind == MatchEventKind::BallLost) continue;
    auto& list = event.kind == MatchEventKind::Kick ? kicks : main;
    if (list.size() < maxEvents) list.push_back(&event);
  }
  std::string out = "<h2>Events</h2>\n";
  out += main.empty() ? "<p class=\"quiet\">No other events.</p>\n" : eventTable(main);
  if (!kicks.empty()) {
    out += "<details><summary>" + std::to_string(kicks.size()) +
           (kicks.size() == 1 ? " kick" : " kicks") + "</summary>\n" + eventTable(kicks) +
           "</details>\n";
  }
  return out;
}

}  // namespace

std::string reportHtml(const ReportContent& c) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>";
  out += escaped(c.title.empty() ? "Match report" : c.title) + "</title>\n<style>";
  out += reportStyle;
  out += "</style></head><body><main>\n";
  out += head(c) + teams(c.statistics) + figuresSection(c.statistics) + goalsSection(c) +
         robots(c.statistics) + setPlaysSection(c) + heatSection(c.statistics) + playsSection(c) +
         charts(c.statistics) + picture(c) + processes(c.statistics) + links(c.statistics) +
         outages(c.statistics) + events(c);
  out += "<footer>" + std::to_string(c.statistics.rows) + " rows, " +
         clockText(c.statistics.range.begin) + " to " + clockText(c.statistics.range.end) +
         (c.session.program.empty() ? "" : ", recorded by " + escaped(c.session.program)) +
         ".</footer>\n</main><script>";
  out += reportScript;
  out += "</script></body></html>\n";
  return out;
}

void keepRobots(ReportContent& content, const RobotChoice& robots) {
  std::erase_if(content.statistics.robots,
                [&](const RobotSummary& robot) { return !robots.has(robot.uid, robot.name); });
  std::erase_if(content.statistics.plays, [&](const PlayEvent& play) {
    return !play.name.empty() && !robots.has(play.robot, play.name);
  });
  std::erase_if(content.events, [&](const MatchEvent& event) {
    return !event.name.empty() && !robots.has(event.robot, event.name);
  });
}

Result<void> writeReport(const std::string& path, const ReportContent& content, IfExists ifExists,
                         const std::string& source) {
  return writeFile(path, reportHtml(content), ifExists, source);
}

}  // namespace pitchboard::link
