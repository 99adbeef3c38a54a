// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_watch.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "variable_text.h"

namespace pitchboard::ui {

void ValueWatch::add(const UserWrite& written) {
  std::erase_if(m_watched, [&written](const UserWrite& other) {
    return other.group == written.group && other.column == written.column;
  });
  m_watched.push_back(written);
}

std::optional<OverwrittenValue> ValueWatch::check(const telemetry::SeriesStore& store) {
  constexpr double longEnough = 1.0;
  for (auto written = m_watched.begin(); written != m_watched.end();) {
    const auto id = store.find(written->group.toStdString(), written->column.toStdString());
    const auto view = id ? store.view(id->group) : nullptr;
    const auto range = view ? view->range() : std::nullopt;
    if (!range || range->end < written->time) {
      written = m_watched.erase(written);
      continue;
    }
    std::vector<telemetry::Sample> samples;
    view->samples(id->column, {written->time, written->time + longEnough}, samples);
    const auto other =
        std::find_if(samples.begin(), samples.end(), [&written](const telemetry::Sample& sample) {
          // A hole says that nothing is seen, not that somebody wrote.
          return sample.time > written->time && std::isfinite(sample.value) &&
                 sample.value != written->value;
        });
    if (other != samples.end()) {
      const OverwrittenValue found{*written, other->value, other->time - written->time};
      m_watched.erase(written);
      return found;
    }
    if (range->end > written->time + longEnough)
      written = m_watched.erase(written);
    else
      ++written;
  }
  return {};
}

QString overwrittenText(const OverwrittenValue& value, const telemetry::ColumnInfo& column) {
  const auto text = [&column](double number) {
    const QString label = labelOf(column, number);
    return valueText(column, number) +
           (label.isEmpty() ? QString() : QStringLiteral(" (%1)").arg(label));
  };
  const UserWrite& written = value.written;
  const QString name = written.group + QLatin1Char('/') + written.column;
  const QString after = ageText(value.after);
  return (value.found == written.before
              ? QStringLiteral("%1 returned to %2 %3 after you wrote %4")
                    .arg(name, text(value.found), after, text(written.value))
              : QStringLiteral("%1 was overwritten with %2 %3 after you wrote %4")
                    .arg(name, text(value.found), after, text(written.value))) +
         QStringLiteral(
             ": a process of the robot writes it too. To keep your value, stop that process "
             "(Processes) or choose behaviour “none” on the robot's card.");
}

}  // namespace pitchboard::ui
