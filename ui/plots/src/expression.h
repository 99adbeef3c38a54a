// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// telemetry::Expression as the plots use it, with the window's texts. One object for one thread at
// a time.

#include <QString>
#include <QStringList>

#include <telemetry/expression/expression.h>

namespace pitchboard::ui {

class PlotExpression {
 public:
  /// Fails with a sentence that names the place.
  static Result<PlotExpression> parse(const QString& text) {
    auto parsed = telemetry::Expression::parse(text.toStdString());
    if (!parsed) return tl::unexpected(parsed.error());
    return PlotExpression(std::move(*parsed));
  }

  /// `GROUP/NAME` of each, in the order in which they appear first.
  const QStringList& variables() const { return m_variables; }
  /// Values in the order of variables(). What cannot be computed is NaN.
  double evaluate(double time, std::span<const double> values) {
    return m_expression.evaluate(time, values);
  }

 private:
  explicit PlotExpression(telemetry::Expression expression) : m_expression(std::move(expression)) {
    for (const std::string& name : m_expression.variables()) {
      m_variables << QString::fromStdString(name);
    }
  }

  telemetry::Expression m_expression;
  QStringList m_variables;
};

}  // namespace pitchboard::ui
