// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_feed.h"

#include <QTimer>

#include <ui/base/time_axis.h>
#include <ui/sources/linked_time.h>

namespace pitchboard::ui {
namespace {

/// `GROUP/COLUMN`.
std::optional<telemetry::SeriesId> idOf(const telemetry::SeriesStore& rows, const QString& name) {
  const qsizetype slash = name.indexOf(QLatin1Char('/'));
  if (slash <= 0) return {};
  return rows.find(name.left(slash).toStdString(), name.mid(slash + 1).toStdString());
}

}  // namespace

PlotFeed::PlotFeed(FrameSource* source, LinkedTime* time, QObject* parent)
    : QObject(parent), m_source(source), m_time(time), m_timer(new QTimer(this)) {
  m_timer->setInterval(refreshMilliseconds);
  connect(m_timer, &QTimer::timeout, this, &PlotFeed::refresh);
  connect(source, &FrameSource::restarted, this, &PlotFeed::forget);
}

void PlotFeed::setRunning(bool on) {
  if (on == m_timer->isActive()) return;
  if (on) {
    refresh();
    m_timer->start();
  } else {
    m_timer->stop();
    // Views keep their rows in memory.
    m_views.clear();
  }
}

void PlotFeed::forget() {
  m_found.clear();
  m_views.clear();
  m_store.reset();
  ++m_generation;
  if (m_timer->isActive()) refresh();
}

void PlotFeed::refresh() {
  const auto store = m_source->series();
  const quint64 revision = store ? store->groupsRevision() : 0;
  if (store != m_store) {
    m_store = store;
    m_storeRevision = revision;
    m_found.clear();
    ++m_generation;
  } else if (revision != m_storeRevision) {
    m_storeRevision = revision;
    lookAgain();
  }
  m_views.clear();
  m_time->setData(m_store ? m_store->range() : std::nullopt);
  emit refreshed();
}

// A robot that is heard for the first time says nothing new of the others: their derived curves
// stay.
void PlotFeed::lookAgain() {
  bool changed = false;
  std::erase_if(m_found, [&](const auto& known) {
    const bool other = idOf(*m_store, known.first) != known.second;
    changed = changed || other;
    return other;
  });
  // What is waited for may have come.
  if (m_missed || changed) ++m_generation;
  m_missed = false;
}

ColumnView PlotFeed::find(const QString& name) {
  if (!m_store) return {};
  auto known = m_found.find(name);
  if (known == m_found.end()) {
    const auto id = idOf(*m_store, name);
    if (!id) {
      m_missed = true;
      return {};
    }
    known = m_found.emplace(name, *id).first;
  }
  auto& view = m_views[known->second.group];
  if (!view) view = m_store->view(known->second.group);
  if (!view) return {};
  return {view, known->second.column};
}

void PlotFeed::setCompared(std::shared_ptr<const telemetry::SeriesStore> rows, double offset,
                           const QString& caption) {
  if (rows != m_compared) ++m_comparedGeneration;
  m_compared = std::move(rows);
  m_comparedOffset = offset;
  m_comparedCaption = caption;
}

ColumnView PlotFeed::compared(const QString& name) const {
  const auto id = m_compared ? idOf(*m_compared, name) : std::nullopt;
  if (!id) return {};
  return {m_compared->view(id->group), id->column};
}

QString PlotFeed::timeText(double time, int decimals) const {
  return momentText(time, decimals, m_clock);
}

QStringList PlotFeed::names() const {
  QStringList all;
  if (!m_store) return all;
  for (telemetry::GroupId group = 0; group < m_store->groups(); ++group) {
    const auto view = m_store->view(group);
    if (!view) continue;
    const QString prefix = QString::fromStdString(view->info().name) + QLatin1Char('/');
    for (const auto& column : view->info().columns) {
      all << prefix + QString::fromStdString(column.name);
    }
  }
  return all;
}

}  // namespace pitchboard::ui
