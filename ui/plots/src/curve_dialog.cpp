// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCompleter>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <ui/base/number_box.h>
#include <ui/base/theme.h>
#include <ui/base/variable_names.h>

#include "expression.h"
#include "plot_feed.h"

namespace pitchboard::ui {
namespace {

// In the order of CurveKind.
constexpr std::array<const char*, 8> kindNames{
    "Variable",          "Derivative (per second)", "Integral over time", "Moving average",
    "Difference of two", "Wrapped angle",           "Other unit",         "Expression"};

NumberBox* numberBox(QWidget* parent) {
  auto* box = new NumberBox(parent);
  box->setRange(-1e9, 1e9);
  box->setDecimals(6);
  box->setButtonSymbols(QAbstractSpinBox::NoButtons);
  return box;
}

/// `each/NAME` of what two groups have at least, and `first/NAME` of all that robots have.
QStringList templateNames(const QStringList& names) {
  std::map<QString, int> groups;
  for (const QString& name : names) {
    const QString group = name.section(QLatin1Char('/'), 0, 0);
    if (group == QLatin1String("curve") || group == QLatin1String("match")) continue;
    ++groups[name.section(QLatin1Char('/'), 1)];
  }
  QStringList each, first;
  for (const auto& [column, count] : groups) {
    if (count > 1) each << QStringLiteral("each/") + column;
    first << QStringLiteral("first/") + column;
  }
  return each + first;
}

/// Letters that have to be put in, left out or changed.
int distanceOf(const QString& a, const QString& b) {
  std::vector<int> row(static_cast<std::size_t>(b.size()) + 1);
  std::iota(row.begin(), row.end(), 0);
  for (qsizetype i = 0; i < a.size(); ++i) {
    int before = row[0]++;
    for (std::size_t j = 1; j < row.size(); ++j) {
      const int change = before + (a[i] == b[static_cast<qsizetype>(j) - 1] ? 0 : 1);
      before = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

/// What somebody may have meant; empty where nothing is near.
QString nearestName(const QString& written, const QStringList& names) {
  QString best;
  int least = 1 + std::max(3, static_cast<int>(written.size()) / 2);
  for (const QString& name : names) {
    // A part of a name is nearer than other letters.
    const bool part =
        std::min(written.size(), name.size()) > 2 && (name.contains(written, Qt::CaseInsensitive) ||
                                                      written.contains(name, Qt::CaseInsensitive));
    const int apart = part ? 1 : distanceOf(written.toUpper(), name.toUpper());
    if (apart >= least) continue;
    least = apart;
    best = name;
  }
  return best;
}

QDialogButtonBox* buttons(QDialog* dialog) {
  auto* box = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, dialog);
  QObject::connect(box, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  QObject::connect(box, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  return box;
}

QLabel* problemLabel(QWidget* parent) {
  auto* label = new QLabel(parent);
  label->setObjectName(QStringLiteral("problem"));
  label->setWordWrap(true);
  label->setFont(themeFont(TypeRole::Secondary));
  QPalette palette = label->palette();
  palette.setColor(QPalette::WindowText, theme().errorText);
  label->setPalette(palette);
  label->setMinimumHeight(2 * label->fontMetrics().height());
  return label;
}

}  // namespace

CurveDialog::CurveDialog(PlotFeed* feed, const CurveSpec& curve, QWidget* parent)
    : QDialog(parent),
      m_feed(feed),
      m_curve(curve),
      m_names(feed->names() + templateNames(feed->names())),
      m_form(new QFormLayout(this)),
      m_kind(new QComboBox(this)),
      m_first(new QLineEdit(this)),
      m_second(new QLineEdit(this)),
      m_expression(new QLineEdit(this)),
      m_parameter(numberBox(this)),
      m_offset(numberBox(this)),
      m_unit(new QLineEdit(this)),
      m_title(new QLineEdit(this)),
      m_problem(problemLabel(this)) {
  setWindowTitle(QStringLiteral("Curve"));
  setMinimumWidth(scaled(this, 460));
  for (const char* name : kindNames) m_kind->addItem(QString::fromUtf8(name));
  m_kind->setObjectName(QStringLiteral("curveKind"));
  m_first->setObjectName(QStringLiteral("firstVariable"));
  m_second->setObjectName(QStringLiteral("secondVariable"));
  m_expression->setObjectName(QStringLiteral("expression"));
  m_parameter->setObjectName(QStringLiteral("parameter"));
  for (QLineEdit* edit : {m_first, m_second}) {
    auto* completer = new QCompleter(m_names, edit);
    completer->setFilterMode(Qt::MatchContains);
    completer->setCaseSensitivity(Qt::CaseInsensitive);
    completer->setMaxVisibleItems(15);
    edit->setCompleter(completer);
    edit->setPlaceholderText(QStringLiteral("part of a name, e.g. ball_dist"));
  }
  m_expression->setPlaceholderText(QStringLiteral("B1.VISION_BALL_DIST / 100"));
  m_expression->setToolTip(
      QStringLiteral("Operators + - * / ^, comparisons, condition ? a : b; functions sin, "
                     "cos, atan2, sqrt, abs, min, max, hypot, deg, rad, wrap(angle, turn); "
                     "pi; t is the time in seconds. Variables: GROUP.NAME; each.NAME for every "
                     "robot, first.NAME for the first; {curve/NAME} is another computed curve"));
  completeNames(m_expression, m_names);
  m_title->setPlaceholderText(QStringLiteral("same as the variable"));
  m_unit->setPlaceholderText(QStringLiteral("same as the variable"));
  m_form->addRow(QStringLiteral("Kind"), m_kind);
  m_form->addRow(QStringLiteral("Variable"), m_first);
  m_form->addRow(QStringLiteral("Minus"), m_second);
  m_form->addRow(QStringLiteral("Expression"), m_expression);
  m_form->addRow(QStringLiteral("Parameter"), m_parameter);
  m_form->addRow(QStringLiteral("Plus"), m_offset);
  m_form->addRow(QStringLiteral("Unit"), m_unit);
  m_form->addRow(QStringLiteral("Name"), m_title);
  m_form->addRow(m_problem);
  QDialogButtonBox* box = buttons(this);
  m_accept = box->button(QDialogButtonBox::Ok);
  m_form->addRow(box);

  m_kind->setCurrentIndex(static_cast<int>(curve.kind));
  m_first->setText(curve.inputs.value(0));
  m_second->setText(curve.inputs.value(1));
  m_expression->setText(curve.expression);
  m_parameter->setValue(curve.parameter);
  m_offset->setValue(curve.offset);
  m_unit->setText(curve.unit);
  m_title->setText(curve.title);
  connect(m_kind, &QComboBox::currentIndexChanged, this, &CurveDialog::showKind);
  for (QLineEdit* edit : {m_first, m_second, m_expression}) {
    connect(edit, &QLineEdit::textChanged, this, &CurveDialog::check);
  }
  connect(m_parameter, &NumberBox::valueChanged, this, &CurveDialog::check);
  showKind();
}

void CurveDialog::showKind() {
  const auto kind = static_cast<CurveKind>(m_kind->currentIndex());
  const bool expression = kind == CurveKind::Expression;
  const bool parameter = kind == CurveKind::MovingAverage || kind == CurveKind::WrapAngle ||
                         kind == CurveKind::Conversion;
  const auto show = [this](QWidget* field, bool on) {
    field->setVisible(on);
    m_form->labelForField(field)->setVisible(on);
  };
  show(m_first, !expression);
  show(m_second, kind == CurveKind::Difference);
  show(m_expression, expression);
  show(m_parameter, parameter);
  show(m_offset, kind == CurveKind::Conversion);
  auto* label = qobject_cast<QLabel*>(m_form->labelForField(m_parameter));
  label->setText(kind == CurveKind::MovingAverage ? QStringLiteral("Window (s)")
                 : kind == CurveKind::WrapAngle   ? QStringLiteral("Full turn")
                                                  : QStringLiteral("Factor"));
  if (m_parameter->value() == 0.0) {
    m_parameter->setValue(kind == CurveKind::WrapAngle ? 360.0 : 1.0);
  }
  check();
}

QString CurveDialog::problem() const {
  const CurveSpec spec = curve();
  if (spec.kind == CurveKind::Expression) {
    const auto parsed = PlotExpression::parse(spec.expression);
    return parsed ? QString() : QString::fromStdString(parsed.error().message);
  }
  for (const QString& input : spec.inputs) {
    if (input.indexOf(QLatin1Char('/')) <= 0) {
      return QStringLiteral("A variable is written GROUP/NAME, e.g. B1/VISION_BALL_DIST.");
    }
  }
  if (spec.kind == CurveKind::MovingAverage && spec.parameter <= 0.0) {
    return QStringLiteral("The window must be longer than 0 s.");
  }
  if (spec.kind == CurveKind::WrapAngle && spec.parameter <= 0.0) {
    return QStringLiteral("A full turn is 360 in degrees, 6.283185 in radians.");
  }
  return {};
}

QString CurveDialog::unknownVariable() const {
  const CurveSpec spec = curve();
  QStringList inputs = spec.inputs;
  if (spec.kind == CurveKind::Expression) {
    const auto parsed = PlotExpression::parse(spec.expression);
    if (!parsed) return {};
    inputs = parsed->variables();
  }
  for (const QString& input : std::as_const(inputs)) {
    const QString group = input.section(QLatin1Char('/'), 0, 0);
    const QString column = input.section(QLatin1Char('/'), 1);
    if (m_names.isEmpty() || m_names.contains(input) || m_feed->find(input)) continue;
    QStringList groups, columns;
    for (const QString& name : m_names) {
      const QString known = name.section(QLatin1Char('/'), 0, 0);
      if (!groups.contains(known)) groups << known;
      if (known == group) columns << name.section(QLatin1Char('/'), 1);
    }
    const QString near =
        columns.isEmpty() ? nearestName(group, groups) : nearestName(column, columns);
    const QString explanation = columns.isEmpty()
                                    ? QStringLiteral("There is no %1.").arg(group)
                                    : QStringLiteral("%1 has no variable %2.").arg(group, column);
    return near.isEmpty() ? explanation
                          : explanation + QStringLiteral(" Did you mean %1?").arg(near);
  }
  return {};
}

void CurveDialog::check() {
  const QString wrong = problem();
  m_accept->setEnabled(wrong.isEmpty());
  // An empty form needs no complaint yet. What is not there now may come: that is no error.
  const bool empty = m_first->text().isEmpty() && m_expression->text().isEmpty();
  QPalette palette = m_problem->palette();
  palette.setColor(QPalette::WindowText, wrong.isEmpty() ? theme().warningText : theme().errorText);
  m_problem->setPalette(palette);
  m_problem->setText(empty ? QString() : wrong.isEmpty() ? unknownVariable() : wrong);
}

CurveSpec CurveDialog::curve() const {
  CurveSpec spec = m_curve;
  spec.kind = static_cast<CurveKind>(m_kind->currentIndex());
  const bool two = spec.kind == CurveKind::Difference ||
                   (spec.kind == CurveKind::Variable && m_curve.inputs.size() == 2);
  spec.inputs.clear();
  if (spec.kind != CurveKind::Expression) spec.inputs << m_first->text().trimmed();
  if (two) spec.inputs << m_second->text().trimmed();
  spec.expression = spec.kind == CurveKind::Expression ? m_expression->text().trimmed() : QString();
  const bool parameter = spec.kind == CurveKind::MovingAverage ||
                         spec.kind == CurveKind::WrapAngle || spec.kind == CurveKind::Conversion;
  spec.parameter = parameter ? m_parameter->value() : 0.0;
  spec.offset = spec.kind == CurveKind::Conversion ? m_offset->value() : 0.0;
  spec.unit = m_unit->text().trimmed();
  spec.title = m_title->text().trimmed();
  return spec;
}

AxesDialog::AxesDialog(const PaneSpec& pane, ValueLimits shown,
                       std::optional<ValueLimits> shownRight, QWidget* parent)
    : QDialog(parent),
      m_pane(pane),
      m_form(new QFormLayout(this)),
      m_title(new QLineEdit(pane.title, this)),
      m_problem(problemLabel(this)) {
  setWindowTitle(QStringLiteral("Title and axes"));
  setMinimumWidth(scaled(this, 340));
  m_form->addRow(QStringLiteral("Title"), m_title);
  m_left = addAxis(QStringLiteral("Value axis"), {}, pane.valueTitle, !pane.autoValues,
                   pane.autoValues ? shown : pane.values);
  if (shownRight) {
    m_right = addAxis(QStringLiteral("Right axis"), QStringLiteral("right"), pane.rightTitle,
                      !pane.autoRight, pane.autoRight ? *shownRight : pane.right);
  }
  m_form->addRow(m_problem);
  QDialogButtonBox* box = buttons(this);
  m_accept = box->button(QDialogButtonBox::Ok);
  m_form->addRow(box);
  check();
}

AxesDialog::Axis AxesDialog::addAxis(const QString& caption, const QString& prefix,
                                     const QString& title, bool fixed, ValueLimits limits) {
  Axis axis{new QLineEdit(title, this), new QCheckBox(QStringLiteral("Fixed limits"), this),
            new QLineEdit(QString::number(limits.low), this),
            new QLineEdit(QString::number(limits.high), this)};
  axis.fixed->setChecked(fixed);
  const std::pair<QWidget*, const char*> names[] = {
      {axis.fixed, "fixedLimits"}, {axis.low, "lowLimit"}, {axis.high, "highLimit"}};
  for (const auto& [widget, name] : names) {
    widget->setObjectName(prefix + QLatin1String(name));
  }
  m_form->addRow(caption, axis.title);
  m_form->addRow(axis.fixed);
  m_form->addRow(QStringLiteral("From"), axis.low);
  m_form->addRow(QStringLiteral("To"), axis.high);
  connect(axis.fixed, &QCheckBox::toggled, this, &AxesDialog::check);
  for (QLineEdit* edit : {axis.low, axis.high}) {
    connect(edit, &QLineEdit::textChanged, this, &AxesDialog::check);
  }
  return axis;
}

QString AxesDialog::Axis::problem() const {
  if (!fixed->isChecked()) return {};
  const auto lower = numberFromText(low->text()), upper = numberFromText(high->text());
  if (!lower || !upper) return QStringLiteral("Both limits must be numbers.");
  return *lower < *upper ? QString()
                         : QStringLiteral("The first limit must be smaller than the second.");
}

ValueLimits AxesDialog::Axis::limits() const {
  return {numberFromText(low->text()).value_or(0.0), numberFromText(high->text()).value_or(0.0)};
}

void AxesDialog::check() {
  QString problem;
  for (const Axis& axis : {m_left, m_right}) {
    if (axis.fixed == nullptr) continue;
    axis.low->setEnabled(axis.fixed->isChecked());
    axis.high->setEnabled(axis.fixed->isChecked());
    if (problem.isEmpty()) problem = axis.problem();
  }
  m_problem->setText(problem);
  m_accept->setEnabled(problem.isEmpty());
}

PaneSpec AxesDialog::pane() const {
  PaneSpec pane = m_pane;
  pane.title = m_title->text().trimmed();
  pane.valueTitle = m_left.title->text().trimmed();
  pane.autoValues = !m_left.fixed->isChecked();
  pane.values = m_left.limits();
  if (m_right.fixed == nullptr) return pane;
  pane.rightTitle = m_right.title->text().trimmed();
  pane.autoRight = !m_right.fixed->isChecked();
  pane.right = m_right.limits();
  return pane;
}

}  // namespace pitchboard::ui
