// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names of variables that people drag, type and choose: `GROUP/COLUMN` between panels,
// `GROUP.COLUMN` in expressions. UI thread only.

#include <QString>
#include <QStringList>

class QLineEdit;
class QMimeData;

namespace pitchboard::ui {

/// Returns the `GROUP/COLUMN` names that are dragged (variablesMimeType); empty if there are none.
/// At most 200.
QStringList draggedVariables(const QMimeData* data);
/// Returns the name as an expression writes it: `B1.NAME`, or in braces if it has other characters.
QString inExpression(const QString& name);
/// Offers these names for the word at the cursor of an expression, not for the whole line. Another
/// call replaces the names.
void completeNames(QLineEdit* edit, const QStringList& names);

}  // namespace pitchboard::ui
