// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/plots/plot_menus.h>

#include <QApplication>
#include <QClipboard>
#include <QColorDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QMenu>
#include <QMimeData>
#include <QPixmap>
#include <functional>

#include <telemetry/series/derived_curve.h>
#include <ui/base/action_reason.h>
#include <ui/base/file_dialog.h>
#include <ui/base/theme.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

#include "chart_pane.h"
#include "curve_dialog.h"
#include "curve_extreme.h"
#include "curve_template.h"
#include "plot_export.h"
#include "plot_page.h"
#include "plot_presets.h"

namespace pitchboard::ui {
namespace {

/// Asks where to, puts the suffix there, writes, and says what went wrong. Time goes on while it
/// asks: what is written was taken before.
void saveAs(PlotsDock* dock, const QString& title, const QString& name, const QString& filter,
            const std::function<Result<void>(const QString&)>& write) {
  QString path = askToSave(dock, title, name, filter);
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QLatin1Char('.') + QFileInfo(name).suffix();
  if (const auto written = write(path))
    dock->settleNotice();
  else
    dock->showNotice(QString::fromStdString(written.error().text()));
}

void addExports(QMenu* menu, PlotsDock* dock) {
  menu->addAction(QStringLiteral("Export picture (PNG)…"), dock, [dock] {
    saveAs(dock, QStringLiteral("Export plots as picture"), QStringLiteral("plots.png"),
           QStringLiteral("Pictures (*.png)"),
           [picture = plotPng(*dock->currentPage())](const QString& path) {
             return savePlotPicture(picture, path);
           });
  });
  menu->addAction(QStringLiteral("Export drawing (SVG)…"), dock, [dock] {
    saveAs(dock, QStringLiteral("Export plots as drawing"), QStringLiteral("plots.svg"),
           QStringLiteral("Drawings (*.svg)"),
           [drawing = plotSvg(*dock->currentPage())](const QString& path) {
             return savePlotPicture(drawing, path);
           });
  });
  menu->addAction(QStringLiteral("Export visible data (CSV)…"), dock, [dock] {
    saveAs(dock, QStringLiteral("Export visible data"), QStringLiteral("plots.csv"),
           QStringLiteral("Tables (*.csv)"),
           [dock, range = dock->time()->range()](const QString& path) {
             return savePlotCsv(dock->currentPage()->panes(), range, path);
           });
  });
  menu->addSeparator();
  menu->addAction(QStringLiteral("Copy picture"), dock, [dock] {
    QApplication::clipboard()->setImage(
        plotPicture(*dock->currentPage(), dock->devicePixelRatioF()));
  });
  menu->addAction(QStringLiteral("Copy values"), dock, [dock] {
    QApplication::clipboard()->setText(
        valuesText(dock->currentPage()->panes(), dock->time()->readAt()));
  });
}

void openLayout(PlotsDock* dock, const Result<PlotLayout>& layout) {
  if (!layout) {
    dock->showNotice(QString::fromStdString(layout.error().text()));
    return;
  }
  dock->settleNotice();
  dock->setLayoutSpec(*layout);
}

void addPresets(QMenu* menu, PlotsDock* dock) {
  menu->addAction(QStringLiteral("Save layout as…"), dock, [dock] {
    bool taken = false;
    const QString name = QInputDialog::getText(
        dock, QStringLiteral("Save layout"), QStringLiteral("Name of the layout:"),
        QLineEdit::Normal, dock->currentPage()->name(), &taken);
    if (!taken || name.trimmed().isEmpty()) return;
    PlotPresets(dock->context().settings).save(name.trimmed(), dock->layoutSpec());
  });
  QMenu* open = menu->addMenu(QStringLiteral("Open layout"));
  QMenu* remove = menu->addMenu(QStringLiteral("Delete layout"));
  QObject::connect(menu, &QMenu::aboutToShow, open, [dock, open, remove] {
    open->clear();
    remove->clear();
    for (const QString& name : PlotPresets(dock->context().settings).names()) {
      open->addAction(name, dock, [dock, name] {
        openLayout(dock, PlotPresets(dock->context().settings).load(name));
      });
      remove->addAction(name, dock,
                        [dock, name] { PlotPresets(dock->context().settings).remove(name); });
    }
    const QString none =
        open->isEmpty() ? QStringLiteral("No layout has been saved yet") : QString();
    enableUnless(*open->menuAction(), none);
    enableUnless(*remove->menuAction(), none);
  });
  menu->addAction(QStringLiteral("Import layout…"), dock, [dock] {
    const QString path = askToOpen(dock, QStringLiteral("Import plot layout"),
                                   QStringLiteral("Layouts (*.json);;All files (*)"));
    if (!path.isEmpty()) openLayout(dock, PlotPresets::readFile(path));
  });
  menu->addAction(QStringLiteral("Export layout…"), dock, [dock] {
    saveAs(dock, QStringLiteral("Export plot layout"), QStringLiteral("plots.json"),
           QStringLiteral("Layouts (*.json)"), [dock](const QString& path) {
             return PlotPresets::writeFile(path, dock->layoutSpec());
           });
  });
}

QIcon swatch(const QColor& color) {
  QPixmap pixmap(12, 12);
  pixmap.fill(color);
  return pixmap;
}

/// A menu of values of one member of a curve.
template <class Value>
void addChoices(QMenu* menu, PlotPane* pane, int curve, Value CurveSpec::*member,
                const std::vector<std::pair<QString, Value>>& choices) {
  const CurveSpec now = pane->description(curve);
  for (const auto& [name, value] : choices) {
    CurveSpec changed = now;
    changed.*member = value;
    QAction* action =
        menu->addAction(name, pane, [pane, curve, changed] { pane->setCurve(curve, changed); });
    action->setCheckable(true);
    action->setChecked(now.*member == value);
  }
}

void addLooks(QMenu* menu, PlotPane* pane, int curve) {
  const CurveSpec now = pane->description(curve);
  QMenu* colors = menu->addMenu(QStringLiteral("Colour"));
  for (int number = 0; number < curveColors; ++number) {
    CurveSpec changed = now;
    changed.colorNumber = number;
    changed.color = QColor();
    colors->addAction(swatch(curveColor(number)), QStringLiteral("Colour %1").arg(number + 1), pane,
                      [pane, curve, changed] { pane->setCurve(curve, changed); });
  }
  colors->addAction(QStringLiteral("Other…"), pane, [pane, curve, now] {
    const QColor color =
        QColorDialog::getColor(now.color.isValid() ? now.color : curveColor(now.colorNumber), pane);
    if (!color.isValid()) return;
    CurveSpec changed = now;
    changed.color = color;
    pane->setCurve(curve, changed);
  });
  addChoices<CurveStyle>(menu->addMenu(QStringLiteral("Style")), pane, curve, &CurveSpec::style,
                         {{QStringLiteral("Line"), CurveStyle::Line},
                          {QStringLiteral("Steps"), CurveStyle::Steps},
                          {QStringLiteral("Points"), CurveStyle::Points},
                          {QStringLiteral("Line and points"), CurveStyle::LineAndPoints}});
  addChoices<double>(menu->addMenu(QStringLiteral("Width")), pane, curve, &CurveSpec::width,
                     {{QStringLiteral("Thin"), 1.0},
                      {QStringLiteral("Normal"), 1.5},
                      {QStringLiteral("Thick"), 2.5},
                      {QStringLiteral("Very thick"), 4.0}});
  if (pane->kind() != PaneKind::Chart) return;
  using Side = CurveSpec::Side;
  addChoices<Side>(menu->addMenu(QStringLiteral("Value axis")), pane, curve, &CurveSpec::side,
                   {{QStringLiteral("By its unit"), Side::ByUnit},
                    {QStringLiteral("Left"), Side::Left},
                    {QStringLiteral("Right"), Side::Right}});
}

/// One description for all robots, now and in other matches.
void addForEach(QMenu* menu, PlotPane* pane, int curve) {
  const CurveSpec now = pane->description(curve);
  const CurveSpec each = forEachGroup(now);
  if (each == now) return;
  menu->addAction(QStringLiteral("For every robot"), pane,
                  [pane, curve, each] { pane->setCurve(curve, each); });
}

/// Curves that can be computed from this one.
void addDerived(QMenu* menu, PlotPage* page, PlotPane* pane, int index) {
  const Curve& curve = pane->curves()[static_cast<std::size_t>(index)];
  if (curve.spec().kind != CurveKind::Variable || pane->kind() == PaneKind::Xy) return;
  QMenu* derived = menu->addMenu(QStringLiteral("Derived curve"));
  const CurveSpec base = variableCurve(curve.spec().inputs.value(0));
  const auto offer = [derived, page, pane](const QString& name, const CurveSpec& spec,
                                           bool ownPlot) {
    derived->addAction(name, page, [page, pane, spec, ownPlot] {
      if (!ownPlot && pane->kind() == PaneKind::Chart) {
        pane->addCurve(spec);
        return;
      }
      PaneSpec chart;
      chart.curves << spec;
      page->insertPane(static_cast<int>(page->panes().indexOf(pane)) + 1, chart);
    });
  };
  const auto with = [&base](CurveKind kind, double parameter) {
    CurveSpec spec = base;
    spec.kind = kind;
    spec.parameter = parameter;
    return spec;
  };
  // What has another unit gets a plot of its own, which has more room for it than a second axis.
  offer(QStringLiteral("Derivative"), with(CurveKind::Derivative, 0.0), true);
  offer(QStringLiteral("Integral"), with(CurveKind::Integral, 0.0), true);
  for (const double seconds : {0.2, 1.0, 5.0}) {
    offer(QStringLiteral("Moving average, %1 s").arg(seconds),
          with(CurveKind::MovingAverage, seconds), false);
  }
  const std::string unit = curve.isWaiting() ? std::string() : curve.view().info().unit;
  offer(QStringLiteral("Wrapped angle"),
        with(CurveKind::WrapAngle, unit == "rad" ? 6.283185307179586 : 360.0), false);
  for (const auto& conversion : telemetry::unitConversionsFrom(unit)) {
    CurveSpec spec = with(CurveKind::Conversion, conversion.factor);
    spec.unit = QString::fromUtf8(conversion.to.data(), qsizetype(conversion.to.size()));
    offer(QStringLiteral("In %1").arg(spec.unit), spec, true);
  }
  for (const Curve& other : pane->curves()) {
    if (&other == &curve || other.spec().kind != CurveKind::Variable) continue;
    CurveSpec spec = with(CurveKind::Difference, 0.0);
    spec.inputs << other.spec().inputs.value(0);
    offer(QStringLiteral("Minus %1").arg(other.name()), spec, false);
  }
}

/// The same curves drawn in another way.
void addKinds(QMenu* menu, PlotPage* page, PlotPane* pane) {
  const auto offer = [menu, page, pane](const QString& name, PaneSpec spec, PaneKind kind) {
    spec.kind = kind;
    menu->addAction(name, page, [page, pane, spec] { page->replacePane(pane, spec); });
  };
  const PaneSpec spec = pane->spec();
  const bool several = std::ranges::any_of(spec.curves, isTemplate);
  if (pane->kind() == PaneKind::Chart && spec.curves.size() >= 2 && !several) {
    PaneSpec xy = spec;
    xy.kind = PaneKind::Xy;
    xy.autoValues = true;
    xy.curves.clear();
    const auto input = [](const CurveSpec& curve) {
      return curve.kind == CurveKind::Variable ? curve.inputs.value(0)
                                               : QStringLiteral("curve/") + curveName(curve);
    };
    bool computed = false;
    for (qsizetype i = 0; i + 1 < spec.curves.size(); i += 2) {
      CurveSpec pair = variableCurve(input(spec.curves[i]));
      pair.inputs << input(spec.curves[i + 1]);
      pair.colorNumber = spec.curves[i].colorNumber;
      computed = computed || spec.curves[i].kind != CurveKind::Variable ||
                 spec.curves[i + 1].kind != CurveKind::Variable;
      xy.curves << pair;
    }
    const QString label = QStringLiteral("Show as XY plot");
    if (computed) {
      // What is computed is computed where it is shown over time: that stays.
      menu->addAction(label, page, [page, pane, xy] {
        page->insertPane(static_cast<int>(page->panes().indexOf(pane)) + 1, xy);
      });
    } else {
      offer(label, xy, PaneKind::Xy);
    }
  }
  if (pane->kind() == PaneKind::Xy) {
    PaneSpec chart = spec;
    chart.curves.clear();
    for (const CurveSpec& pair : spec.curves) {
      for (const QString& input : pair.inputs) {
        chart.curves << variableCurve(input);
        chart.curves.back().colorNumber = static_cast<int>(chart.curves.size()) - 1;
      }
    }
    offer(QStringLiteral("Show over time"), chart, PaneKind::Chart);
  }
  if (pane->kind() == PaneKind::Chart) offer(QStringLiteral("Show as lanes"), spec, PaneKind::Lane);
  if (pane->kind() == PaneKind::Lane)
    offer(QStringLiteral("Show as curves"), spec, PaneKind::Chart);
}

/// Shows the moment at which the curve is highest or lowest, in the selected range or in all of its
/// past. Rows that are not in memory are read first.
void goToExtreme(PlotsDock* dock, const ColumnView& view, Extreme which) {
  ShownMoment* shown = dock->context().shown;
  const auto range = shown->selection() ? shown->selection() : view.group->range();
  if (!range) return;
  const auto time = extremeTime(*view.group, view.column, *range, which);
  if (!time) return;
  shown->seek(*time);
  const telemetry::TimeRange around{*time - 1.0, *time + 1.0};
  if (view.group->hasEveryRow(around) || !view.group->isReading(around)) return;
  QObject::connect(
      dock->feed(), &PlotFeed::refreshed, dock,
      [dock, view, which] { goToExtreme(dock, view, which); },
      static_cast<Qt::ConnectionType>(Qt::QueuedConnection | Qt::SingleShotConnection));
}

void addExtremes(QMenu* menu, PlotsDock* dock, const PlotPane* pane, int index) {
  const Curve& curve = pane->curves()[static_cast<std::size_t>(index)];
  if (pane->kind() != PaneKind::Chart) return;
  for (const Extreme which : {Extreme::Maximum, Extreme::Minimum}) {
    QAction* go = menu->addAction(
        which == Extreme::Maximum ? QStringLiteral("Go to maximum")
                                  : QStringLiteral("Go to minimum"),
        dock, [dock, view = curve.view(), which] { goToExtreme(dock, view, which); });
    go->setToolTip(QStringLiteral(
        "Shows the moment at which it is reached: in the selected range, else in the whole past"));
    enableUnless(*go, curve.isWaiting() ? QStringLiteral("There are no values yet") : QString());
  }
}

void askForAxes(PlotsDock* dock, PlotPane* pane) {
  const auto* chart = qobject_cast<ChartPane*>(pane);
  AxesDialog dialog(pane->spec(), chart != nullptr ? chart->valueScale().limits : ValueLimits{},
                    chart != nullptr && chart->hasRightAxis()
                        ? std::optional(chart->rightScale().limits)
                        : std::nullopt,
                    dock);
  if (dialog.exec() == QDialog::Accepted) pane->setOptions(dialog.pane());
}

}  // namespace

QMenu* makePlotsMenu(PlotsDock* dock) {
  auto* menu = new QMenu(QStringLiteral("&Plots"), dock);
  menu->addAction(QStringLiteral("Add curve…"), dock, [dock] { askForCurve(dock); });
  menu->addAction(QStringLiteral("Rename tab…"), dock,
                  [dock] { dock->renamePage(int(dock->pages().indexOf(dock->currentPage()))); });
  menu->addAction(QStringLiteral("Remove all plots of this tab"), dock,
                  [dock] { dock->currentPage()->removeAll(); });
  menu->addSeparator();
  addPresets(menu, dock);
  menu->addSeparator();
  addExports(menu, dock);
  return menu;
}

void askForCurve(PlotsDock* dock) {
  CurveDialog dialog(dock->feed(), CurveSpec{}, dock);
  if (dialog.exec() != QDialog::Accepted) return;
  const CurveSpec curve = dialog.curve();
  if (curve.kind == CurveKind::Variable)
    dock->currentPage()->addVariables(curve.inputs);
  else
    dock->currentPage()->addCurve(curve);
}

void editCurve(PlotsDock* dock, PlotPane* pane, int curve) {
  CurveDialog dialog(dock->feed(), pane->description(curve), dock);
  if (dialog.exec() == QDialog::Accepted) pane->setCurve(curve, dialog.curve());
}

void showPlotMenu(PlotsDock* dock, PlotPage* page, PlotPane* pane, int curve, const QPoint& at) {
  auto* menu = new QMenu(dock);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->setObjectName(QStringLiteral("plotMenu"));
  const auto offerCurve = [&](QMenu* into, int index) {
    into->addAction(QStringLiteral("Edit…"), dock,
                    [dock, pane, index] { editCurve(dock, pane, index); });
    if (pane->kind() != PaneKind::Lane) {
      const bool hidden = pane->curves()[static_cast<std::size_t>(index)].isHidden();
      into->addAction(hidden ? QStringLiteral("Show") : QStringLiteral("Hide"), pane,
                      [pane, index] { pane->toggleCurve(index); });
      into->addAction(QStringLiteral("Show only this one"), pane,
                      [pane, index] { pane->showOnly(index); });
      addLooks(into, pane, index);
    }
    addForEach(into, pane, index);
    addDerived(into, page, pane, index);
    addExtremes(into, dock, pane, index);
    into->addAction(themedIcon(QStringLiteral("edit-delete")), QStringLiteral("Remove curve"), page,
                    [page, pane, index] {
                      if (pane->spec().curves.size() == 1)
                        page->removePane(pane);
                      else
                        pane->removeCurve(index);
                    });
  };
  if (curve >= 0) {
    offerCurve(menu, curve);
  } else {
    for (std::size_t i = 0; i < pane->curves().size(); ++i) {
      const Curve& each = pane->curves()[i];
      QMenu* sub = menu->addMenu(swatch(each.color()), each.name());
      offerCurve(sub, static_cast<int>(i));
    }
    menu->addAction(QStringLiteral("Add curve…"), dock, [dock] { askForCurve(dock); });
    menu->addSeparator();
    if (pane->kind() != PaneKind::Lane) {
      menu->addAction(QStringLiteral("Title and axes…"), dock,
                      [dock, pane] { askForAxes(dock, pane); });
    }
    pane->extendMenu(menu);
    addKinds(menu, page, pane);
    if (pane->isOverTime()) {
      const double moment = pane->timeAxis().time(pane->surface()->mapFromGlobal(at).x());
      menu->addAction(QStringLiteral("Show the field at this moment"), dock,
                      [dock, moment] { dock->context().shown->seek(moment); });
    }
    menu->addSeparator();
    addExports(menu, dock);
    menu->addSeparator();
    menu->addAction(themedIcon(QStringLiteral("edit-delete")), QStringLiteral("Remove plot"), page,
                    [page, pane] { page->removePane(pane); });
  }
  menu->popup(at);
}

}  // namespace pitchboard::ui
