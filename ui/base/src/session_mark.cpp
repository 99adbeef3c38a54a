// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/session_mark.h>

#include <algorithm>
#include <array>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

struct SessionShades {
  const char* dark;
  const char* light;
};

// Far from the colours of teams and curves and from each other in OKLab; neighbours differ most.
constexpr std::array<SessionShades, maxComparedSessions> sessionShades{{{"#f7aafe", "#8e2698"},
                                                                        {"#46e8c7", "#1c6c5c"},
                                                                        {"#c09b8c", "#5f2d16"},
                                                                        {"#8bb54e", "#577d03"},
                                                                        {"#948cae", "#341c5d"},
                                                                        {"#c57599", "#412330"},
                                                                        {"#cbeab3", "#758768"},
                                                                        {"#50a0ac", "#03353b"},
                                                                        {"#fab8aa", "#89645d"},
                                                                        {"#4aaa4d", "#1f5c21"},
                                                                        {"#c16cc9", "#64006d"},
                                                                        {"#b8bb97", "#5f6228"},
                                                                        {"#b8afe7", "#70669a"},
                                                                        {"#98e188", "#309909"},
                                                                        {"#ffcbf6", "#9f819a"},
                                                                        {"#859a7b", "#193607"}}};

}  // namespace

QColor sessionColor(int number) {
  const int index = std::clamp(number, 1, maxComparedSessions) - 1;
  const SessionShades& shades = sessionShades[static_cast<std::size_t>(index)];
  return QColor(QLatin1String(isDarkTheme() ? shades.dark : shades.light));
}

QString sessionMark(int number) {
  QString mark(QChar(0x2032));  // ′
  if (number < 2) return mark;
  constexpr char16_t subscriptZero = 0x2080;
  for (const QChar digit : QString::number(number)) {
    mark += QChar(static_cast<char16_t>(subscriptZero + digit.digitValue()));
  }
  return mark;
}

}  // namespace pitchboard::ui
