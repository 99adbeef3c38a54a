// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_export.h"

#include <QBuffer>
#include <QPainter>
#include <QRegularExpression>
#include <QSaveFile>
#include <QSvgGenerator>
#include <algorithm>
#include <cmath>
#include <limits>

#include <base/csv_field.h>
#include <base/file_target.h>
#include <ui/base/picture_bytes.h>
#include <ui/base/save_file.h>
#include <ui/base/session_mark.h>
#include <ui/plots/axis_ticks.h>
#include <ui/plots/film_curves.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

#include "plot_feed.h"
#include "plot_page.h"

namespace pitchboard::ui {
namespace {

constexpr double pngRatio = 2.0;

tl::unexpected<Error> cannotWrite(const QFileDevice& file) {
  return failure(
      ErrorCode::SystemError,
      QStringLiteral("Could not write the file: %1.").arg(file.errorString()).toStdString(),
      file.fileName().toStdString());
}

QString csv(const QString& text) {
  return QString::fromStdString(csvField(text.toStdString()));
}

/// The desktop's "Sans Serif" is a name that only this computer knows.
QByteArray withKnownFonts(const QByteArray& svg) {
  static const QRegularExpression family(QStringLiteral("font-family=\"([^\"]*)\""));
  QString text = QString::fromUtf8(svg);
  text.replace(family,
               QStringLiteral("font-family=\"\\1, DejaVu Sans, Verdana, Arial, sans-serif\""));
  text.replace(QStringLiteral("font-family=\"Sans Serif, "), QStringLiteral("font-family=\""));
  return text.toUtf8();
}

/// Samples of one column, read piece by piece: a file may be larger than memory.
class SampleReader {
 public:
  /// `offset`: s, where second 0 of the column stands on the axis of `range`.
  SampleReader(const ColumnView& view, telemetry::TimeRange range, double offset = 0.0)
      : m_view(view), m_rest{range.begin - offset, range.end - offset}, m_offset(offset) {
    fill();
  }
  double time() const {
    return m_next < m_samples.size() ? m_samples[m_next].time + m_offset
                                     : std::numeric_limits<double>::infinity();
  }
  double take() {
    const double value = m_samples[m_next++].value;
    if (m_next == m_samples.size()) fill();
    return value;
  }

 private:
  void fill() {
    constexpr std::size_t piece = 1 << 14;
    m_samples.clear();
    m_next = 0;
    if (m_done) return;
    m_done = m_view.group->samples(m_view.column, m_rest, m_samples, piece);
    if (m_samples.empty()) return;
    // Samples of one time stay together, so that the next piece can begin after it.
    if (!m_done) {
      const double last = m_samples.back().time;
      while (m_samples.size() > 1 && m_samples.back().time == last) m_samples.pop_back();
      m_rest.begin = std::nextafter(m_samples.back().time, std::numeric_limits<double>::infinity());
    }
  }

  ColumnView m_view;
  telemetry::TimeRange m_rest;
  double m_offset;
  std::vector<telemetry::Sample> m_samples;
  std::size_t m_next = 0;
  bool m_done = false;
};

}  // namespace

QImage plotPicture(PlotPage& page, double ratio) {
  QWidget* widget = page.picture();
  QImage image(widget->size() * ratio, QImage::Format_RGB32);
  image.setDevicePixelRatio(ratio);
  image.fill(widget->palette().color(QPalette::Base));
  page.setForPicture(true);
  widget->render(&image);
  page.setForPicture(false);
  return image;
}

FilmCurves filmCurves(const PlotsDock& plots, int width) {
  PlotPage* page = plots.currentPage();
  if (page == nullptr || page->panes().isEmpty() || page->picture()->width() <= 0) return {};
  const double ratio = std::max(1.0, static_cast<double>(width) / page->picture()->width());
  const auto showValues = [&plots, page](bool on) {
    plots.feed()->setShowsValues(on);
    for (PlotPane* pane : page->panes()) pane->showValues();
  };
  showValues(false);
  FilmCurves curves{plotPicture(*page, ratio), page->pictureAxis()};
  showValues(true);
  curves.picture.setDevicePixelRatio(1.0);
  curves.axis.left *= ratio;
  curves.axis.width *= ratio;
  return curves;
}

QByteArray plotPng(PlotPage& page) {
  return pictureBytes(plotPicture(page, pngRatio));
}

Result<void> savePlotPicture(const QByteArray& bytes, const QString& path) {
  if (bytes.isEmpty()) return failure(ErrorCode::SystemError, "Could not render the picture.");
  return writeFile(path.toStdString(), {bytes.data(), std::size_t(bytes.size())},
                   IfExists::Replace);
}

QByteArray plotSvg(PlotPage& page) {
  QWidget* widget = page.picture();
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setSize(widget->size());
  generator.setViewBox(widget->rect());
  generator.setTitle(page.name());
  QPainter painter(&generator);
  painter.fillRect(widget->rect(), widget->palette().color(QPalette::Base));
  page.setForPicture(true);
  widget->render(&painter);
  page.setForPicture(false);
  painter.end();
  return withKnownFonts(bytes);
}

namespace {

/// A curve as it is exported: the source's, or that of a compared session.
struct ExportedCurve {
  QString name;
  ColumnView view, ordinate;
  double offset = 0.0;  // s
};

std::vector<ExportedCurve> exportedCurves(const PlotPane& pane, const Curve& curve) {
  std::vector<ExportedCurve> all{{curve.name(), curve.view(), curve.ordinate()}};
  for (const ComparedRows& session : pane.feed().compared()) {
    const Curve::Compared* other = curve.compared(session);
    if (session.isFuture() || other == nullptr || !other->view) continue;
    all.push_back(
        {QStringLiteral("%1%2 %3").arg(curve.name(), sessionMark(session.number), session.caption),
         other->view, other->ordinate, session.offset});
  }
  std::erase_if(all, [](const ExportedCurve& one) { return !one.view; });
  return all;
}

}  // namespace

void writeCsv(QIODevice& device, const QList<PlotPane*>& panes, telemetry::TimeRange range) {
  QStringList names{QStringLiteral("time [s]")};
  std::vector<SampleReader> readers;
  for (const PlotPane* pane : panes) {
    for (const Curve& curve : pane->curves()) {
      for (const ExportedCurve& one : exportedCurves(*pane, curve)) {
        names << csv(curve.unit().isEmpty()
                         ? one.name
                         : QStringLiteral("%1 [%2]").arg(one.name, curve.unit()));
        readers.emplace_back(one.view, range, one.offset);
        if (!one.ordinate) continue;
        names << csv(curveName(variableCurve(curve.spec().inputs.value(1))));
        readers.emplace_back(one.ordinate, range, one.offset);
      }
    }
  }
  device.write(names.join(QLatin1Char(',')).toUtf8() + "\r\n");
  while (true) {
    double time = std::numeric_limits<double>::infinity();
    for (const SampleReader& reader : readers) time = std::min(time, reader.time());
    if (!std::isfinite(time)) return;
    QByteArray line = QByteArray::number(time, 'g', 15);
    for (SampleReader& reader : readers) {
      line += ',';
      if (reader.time() != time) continue;
      const double value = reader.take();
      // Unknown is an empty cell, as in every table.
      if (std::isfinite(value))
        line += QByteArray::number(value, 'g', 17);
      else if (!std::isnan(value))
        line += value > 0 ? "inf" : "-inf";
    }
    if (device.write(line + "\r\n") < 0) return;
  }
}

Result<void> savePlotCsv(const QList<PlotPane*>& panes, telemetry::TimeRange range,
                         const QString& path) {
  for (const PlotPane* pane : panes) {
    for (const Curve& curve : pane->curves()) {
      for (const ExportedCurve& one : exportedCurves(*pane, curve)) {
        if (one.view.group->hasEveryRow({range.begin - one.offset, range.end - one.offset}))
          continue;
        return failure(
            ErrorCode::Unsupported,
            "This range is not in memory. Zoom in and try again, or use Timeline > Export….");
      }
    }
  }
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly)) return cannotWrite(file);
  writeCsv(file, panes, range);
  if (!commitWhole(file)) return cannotWrite(file);
  return {};
}

QString valuesText(const QList<PlotPane*>& panes, std::optional<double> time) {
  QString text;
  for (const PlotPane* pane : panes) {
    for (const Curve& curve : pane->curves()) {
      const auto add = [&](const QString& name, std::optional<double> value) {
        text += name + QLatin1Char('\t') + (value ? QString::number(*value, 'g', 15) : QString()) +
                QLatin1Char('\t') + curve.unit() + QLatin1Char('\n');
      };
      add(curve.name(), curve.valueAt(time));
      const double shown = time.value_or(pane->feed().time()->shown()->time());
      for (const ExportedCurve& one : exportedCurves(*pane, curve)) {
        if (one.name != curve.name()) add(one.name, valueIn(one.view, shown - one.offset));
      }
    }
  }
  return text;
}

}  // namespace pitchboard::ui
