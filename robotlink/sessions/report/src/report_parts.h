// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parts that the files of a match report share: cells, names and times as HTML, and the sections
// about play. Pure functions; any thread; seconds of the source.

#include <string>

#include <robotlink/report/report.h>

namespace pitchboard::link {

/// "1:02:05", "12:05", "0:07".
std::string clockText(double seconds);
/// ".4", behind a clockText().
std::string tenths(double seconds);
std::string capital(std::string_view word);
/// `sortsBy`: what the column is sorted by, if that is not the text.
std::string cell(const std::string& text, const char* kind = "", const std::string& sortsBy = {});
std::string teamClass(TeamColor team);
/// The name of the team, escaped.
std::string titleOf(const TeamSummary& team);
std::string badge(const RobotSummary& robot);
/// A time that leads to the clip with this moment, if there is one; as a cell, sorted by the time.
std::string momentText(const ReportContent& content, double time);
std::string momentCell(const ReportContent& content, double time);

// Sections; empty if there is nothing to show.
std::string figuresSection(const MatchStatistics& statistics);
std::string goalsSection(const ReportContent& content);
std::string heatSection(const MatchStatistics& statistics);
std::string setPlaysSection(const ReportContent& content);
std::string playsSection(const ReportContent& content);

}  // namespace pitchboard::link
