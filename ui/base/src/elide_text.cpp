// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/elide_text.h>

#include <QList>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>

namespace pitchboard::ui {
namespace {

struct Part {
  QString text;
  bool isNumber = false;
};

bool isNumber(const QString& word) {
  static const QRegularExpression number(QStringLiteral("^[^\\p{L}\\d]?\\d"));
  constexpr qsizetype shortName = 4;
  const bool anyDigit = std::any_of(word.begin(), word.end(), [](QChar c) { return c.isDigit(); });
  return anyDigit && (word.size() <= shortName || number.match(word).hasMatch());
}

bool isUnit(const QString& word) {
  static const QRegularExpression unit(QStringLiteral("^[\\p{L}°%/²]{1,4}[,;.)]?$"));
  return unit.match(word).hasMatch();
}

/// Neighbouring words are one part; a number keeps its unit.
QList<Part> partsOf(const QString& text) {
  QList<Part> parts;
  bool takesUnit = false;
  for (const QString& word : text.split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
    const bool number = isNumber(word);
    const bool joins = !parts.isEmpty() &&
                       (takesUnit ? isUnit(word) && !number : !number && !parts.last().isNumber);
    if (joins)
      parts.last().text += QLatin1Char(' ') + word;
    else
      parts << Part{word, number};
    // Codes and names (B1) have no unit.
    takesUnit = number && !joins && !word.front().isLetter();
  }
  return parts;
}

/// Shortens words to a width; a remainder of one or two letters is left out, and a comma or dot
/// before the ellipsis.
QString shortened(const QFontMetricsF& metrics, const QString& words, double width) {
  constexpr qsizetype scrap = 2;  // letters
  QString shown = metrics.elidedText(words, Qt::ElideRight, width);
  if (shown == words || shown.isEmpty()) return shown;
  const qsizetype space = shown.lastIndexOf(QLatin1Char(' '));
  shown.truncate(space > 0 && shown.size() - space - 2 <= scrap ? space : shown.size() - 1);
  while (!shown.isEmpty() && !shown.back().isLetterOrNumber()) shown.chop(1);
  return shown + QChar(0x2026);
}

QString joined(const QList<Part>& parts) {
  QStringList texts;
  for (const Part& part : parts) texts << part.text;
  return texts.join(QLatin1Char(' '));
}

/// "…forward, fast": the last word tells it from the others of its kind, so those before it give
/// way, the first one first. Empty for other texts, and if nothing but that word would fit.
QString elidedBefore(const QFontMetricsF& metrics, const QString& text, double width) {
  static const QRegularExpression qualified(QStringLiteral("^[\\p{L} ]+, \\p{L}+$"));
  if (!qualified.match(text).hasMatch()) return {};
  QString rest = text;
  while (true) {
    const qsizetype space = rest.indexOf(QLatin1Char(' '));
    if (space < 0 || rest[space - 1] == QLatin1Char(',')) return {};
    rest.remove(0, space + 1);
    const QString shown = QChar(0x2026) + rest;
    if (metrics.horizontalAdvance(shown) <= width) return shown;
  }
}

/// "X 117 cm, Y 32 cm": each figure needs its name, so whole items give way, the last one first.
/// Empty for other texts, and if not even the first item fits.
QString elidedList(const QFontMetricsF& metrics, const QString& text, double width) {
  QStringList items = text.split(QStringLiteral(", "));
  const auto isNamed = [](const QString& item) {
    const QStringList words = item.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    return words.size() > 1 && !isNumber(words.first()) &&
           std::any_of(words.begin(), words.end(), isNumber);
  };
  if (items.size() < 2 || !std::all_of(items.begin(), items.end(), isNamed)) return {};
  const QString more = QStringLiteral(", …");
  while (items.size() > 1) {
    items.removeLast();
    const QString shown = items.join(QStringLiteral(", ")) + more;
    if (metrics.horizontalAdvance(shown) <= width) return shown;
  }
  return {};
}

}  // namespace

QString elideName(const QFontMetricsF& metrics, const QString& name, double width) {
  if (metrics.horizontalAdvance(name) <= width) return name;
  // The robot stays: without it the rest says nothing.
  const qsizetype blank = name.indexOf(QLatin1Char(' '));
  const QString variable = name.left(blank), robot = blank < 0 ? QString() : name.mid(blank);
  const qsizetype prefix = variable.indexOf(QLatin1Char('_'));
  const QString rest = prefix > 0 ? variable.mid(prefix + 1) : variable;
  const double room = width - metrics.horizontalAdvance(robot);
  const QString shown = metrics.elidedText(rest, Qt::ElideMiddle, std::max(room, 0.0));
  return shown.size() > 1 ? shown + robot : metrics.elidedText(name, Qt::ElideLeft, width);
}

QString elideText(const QFontMetricsF& metrics, const QString& text, double width) {
  const auto fits = [&](const QString& some) { return metrics.horizontalAdvance(some) <= width; };
  if (fits(text)) return text;
  for (const auto& special : {elidedBefore, elidedList}) {
    if (const QString shown = special(metrics, text, width); !shown.isEmpty()) return shown;
  }
  QList<Part> parts = partsOf(text);
  const QString dots = QStringLiteral("…");
  for (qsizetype i = parts.size() - 1; i >= 0; --i) {
    if (parts[i].isNumber) continue;
    const QString whole = parts[i].text;
    parts[i].text.clear();
    const double room = width - metrics.horizontalAdvance(joined(parts));
    parts[i].text = shortened(metrics, whole, std::max(room, 0.0));
    if (parts[i].text.size() > dots.size() && fits(joined(parts))) return joined(parts);
    // What stands in front of a number has to be short, or may be left out.
    parts.removeAt(i);
    if (!parts.isEmpty() && fits(joined(parts))) return joined(parts);
  }
  while (parts.size() > 1 && !fits(joined(parts))) parts.removeLast();
  if (parts.isEmpty()) return metrics.elidedText(text, Qt::ElideRight, width);
  QString number = parts.first().text;
  if (fits(number)) return number;
  const QString bare = number.section(QLatin1Char(' '), 0, 0);
  return fits(bare) ? bare : dots;
}

}  // namespace pitchboard::ui
