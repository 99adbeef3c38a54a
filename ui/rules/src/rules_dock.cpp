// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/rules/rules_dock.h>

#include <QApplication>
#include <QClipboard>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollBar>
#include <QTableView>
#include <algorithm>
#include <cmath>

#include <base/file_target.h>
#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/base/table_style.h>
#include <ui/base/text_filter.h>
#include <ui/sources/rule_watch.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

/// Sorts and filters long lists without a QVariant for each cell.
class RulesFilter : public TextFilter {
 public:
  using TextFilter::TextFilter;

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& /*parent*/) const override {
    const auto& rules = *static_cast<const RuleWatch*>(sourceModel());
    const auto isInNumbers = [&rules, row](const QString& word) {
      constexpr int numbers[] = {RuleWatch::From, RuleWatch::Duration, RuleWatch::Worst};
      return std::ranges::any_of(numbers, [&](int column) {
        return rules.index(row, column).data().toString().contains(word);
      });
    };
    return std::ranges::all_of(words(), [&](const QString& word) {
      return rules.contains(rules.broken()[static_cast<std::size_t>(row)], word) ||
             (isNumeric(word) && isInNumbers(word));
    });
  }
  bool lessThan(const QModelIndex& a, const QModelIndex& b) const override {
    if (a.column() != RuleWatch::From) return TextFilter::lessThan(a, b);
    const auto& broken = static_cast<const RuleWatch*>(sourceModel())->broken();
    return broken[static_cast<std::size_t>(a.row())].from() <
           broken[static_cast<std::size_t>(b.row())].from();
  }
};

class RulesDock : public QWidget {
 public:
  RulesDock(RuleWatch* rules, ShownMoment* shown, QWidget* parent)
      : QWidget(parent),
        m_rules(rules),
        m_shown(shown),
        m_open(new QPushButton(QStringLiteral("Open rules…"), this)),
        m_again(new QPushButton(this)),
        m_filter(new QLineEdit(this)),
        m_state(new QLabel(this)),
        m_progress(new QProgressBar(this)),
        m_save(new QPushButton(QStringLiteral("Save CSV…"), this)),
        m_message(new InPlaceMessage(this)),
        m_table(new QTableView(this)),
        m_sorted(new RulesFilter(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyRules"))) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(makeBar());
    column->addWidget(m_message);
    column->addWidget(m_table, 1);
    column->addWidget(m_empty, 1);
    makeTable();
    m_message->clear();
    connect(rules, &RuleWatch::changed, this, &RulesDock::showState);
    showState();
  }
  QSize sizeHint() const override { return {scaled(this, 900), scaled(this, 240)}; }

 private:
  QHBoxLayout* makeBar() {
    m_open->setObjectName(QStringLiteral("openRules"));
    m_open->setToolTip(QStringLiteral("Opens a file with rules (docs/rules.md) and checks them"));
    connect(m_open, &QPushButton::clicked, this, [this] { askForRules(m_rules, this); });
    m_again->setObjectName(QStringLiteral("checkRulesAgain"));
    connect(m_again, &QPushButton::clicked, this,
            [this] { m_rules->isReading() ? m_rules->cancel() : m_rules->again(); });
    m_filter->setObjectName(QStringLiteral("rulesFilter"));
    m_filter->setAccessibleName(QStringLiteral("Filter"));
    m_filter->setPlaceholderText(QStringLiteral("Filter: rule, robot, severity, session"));
    m_filter->setClearButtonEnabled(true);
    connect(m_filter, &QLineEdit::textChanged, m_sorted, &TextFilter::setFilterText);
    connect(m_filter, &QLineEdit::textChanged, this, &RulesDock::showState);
    m_state->setObjectName(QStringLiteral("rulesState"));
    m_state->setFont(themeFont(TypeRole::Secondary));
    m_state->setForegroundRole(QPalette::PlaceholderText);
    m_progress->setObjectName(QStringLiteral("rulesProgress"));
    m_progress->setRange(0, 100);
    m_progress->setTextVisible(false);
    m_progress->setFixedSize(scaled(this, 140), scaled(this, 8));
    m_save->setObjectName(QStringLiteral("saveRules"));
    connect(m_save, &QPushButton::clicked, this, [this] { askAndSave(); });
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    row->addWidget(m_open);
    row->addWidget(m_again);
    row->addWidget(m_filter, 1);
    row->addWidget(m_progress);
    row->addWidget(m_state);
    row->addWidget(m_save);
    return row;
  }

  void makeTable() {
    m_table->setObjectName(QStringLiteral("rulesTable"));
    m_sorted->setSourceModel(m_rules);
    m_sorted->setSortRole(RuleWatch::sortRole);
    m_table->setModel(m_sorted);
    styleTable(m_table);
    m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_table->setSortingEnabled(true);
    m_table->sortByColumn(RuleWatch::From, Qt::AscendingOrder);
    m_table->setIconSize(QSize(scaled(this, 8), scaled(this, 8)));
    // px of the mock
    constexpr int widths[RuleWatch::columns] = {72, 120, 150, 60, 96, 120, 72, 200};
    for (int column = 0; column < RuleWatch::columns; ++column) {
      m_table->setColumnWidth(column, scaled(this, widths[column]));
    }
    const auto go = [this](const QModelIndex& index) {
      m_shown->seek(index.siblingAtColumn(RuleWatch::From).data(RuleWatch::sortRole).toDouble());
    };
    connect(m_table, &QTableView::clicked, this, go);
    connect(m_table, &QTableView::activated, this, go);
    // While a match runs, the newest row stays in view unless somebody has scrolled away from it.
    connect(m_sorted, &QAbstractItemModel::rowsAboutToBeInserted, this, [this] {
      const QScrollBar* bar = m_table->verticalScrollBar();
      m_followsEnd = bar->value() == bar->maximum() && m_shown->kind().hasPresent;
    });
    connect(m_sorted, &QAbstractItemModel::rowsInserted, m_table, [this] {
      if (m_followsEnd) m_table->scrollToBottom();
    });
    auto* copy = new QAction(QStringLiteral("Copy"), m_table);
    copy->setObjectName(QStringLiteral("copyRules"));
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    connect(copy, &QAction::triggered, this, [this] { copySelection(); });
    m_table->addAction(copy);
    m_table->setContextMenuPolicy(Qt::ActionsContextMenu);
  }

  std::vector<const BrokenRule*> rowsShown(bool onlySelected) const {
    std::vector<const BrokenRule*> out;
    for (int row = 0; row < m_sorted->rowCount(); ++row) {
      if (onlySelected && !m_table->selectionModel()->isRowSelected(row, {})) continue;
      const int source = m_sorted->mapToSource(m_sorted->index(row, 0)).row();
      out.push_back(&m_rules->broken()[static_cast<std::size_t>(source)]);
    }
    return out;
  }

  /// With tabs, for a spreadsheet.
  void copySelection() const {
    QString text;
    for (int row = 0; row < m_sorted->rowCount(); ++row) {
      if (!m_table->selectionModel()->isRowSelected(row, {})) continue;
      for (int column = 0; column < RuleWatch::columns; ++column) {
        if (m_table->isColumnHidden(column)) continue;
        text += m_sorted->index(row, column).data().toString() +
                QLatin1Char(column + 1 < RuleWatch::columns ? '\t' : '\n');
      }
    }
    QApplication::clipboard()->setText(text);
  }

  /// What the filter lets through, as `pitchboard-cli check --csv` writes it.
  void askAndSave() {
    std::string text = telemetry::brokenRuleCsvHead();
    for (const BrokenRule* one : rowsShown(false)) {
      text += telemetry::brokenRuleCsv(m_rules->sourceNameOf(*one).toStdString(),
                                       m_rules->ruleOf(*one), one->moment);
    }
    const QString path =
        askToSave(this, QStringLiteral("Save the list of broken rules"),
                  QStringLiteral("rules.csv"), QStringLiteral("CSV files (*.csv)"));
    if (path.isEmpty()) return;
    const auto written =
        writeFile(path.toStdString(), {text.data(), text.size()}, IfExists::Replace);
    m_message->showMessage(written ? InPlaceMessage::Tone::Note : InPlaceMessage::Tone::Error,
                           written ? QStringLiteral("Saved as %1").arg(path)
                                   : QString::fromStdString(written.error().text()));
  }

  QString stateText() const {
    if (m_rules->isCancelled()) return QStringLiteral("Cancelled");
    if (m_rules->rules().empty()) return {};
    const auto all = m_rules->broken().size();
    const QString of = QFileInfo(m_rules->path()).fileName();
    const QString name = QStringLiteral("%1: %2 rules, ").arg(of).arg(m_rules->rules().size());
    if (all == 0) {
      return name +
             (m_rules->isReading() ? QStringLiteral("checking…") : QStringLiteral("never broken"));
    }
    const QString shown =
        m_filter->text().isEmpty() ? QString() : QStringLiteral("%1 of ").arg(m_sorted->rowCount());
    return name + QStringLiteral("broken %1%2 times").arg(shown).arg(all) +
           (m_rules->isCut() ? QStringLiteral(", the newest ones") : QString());
  }

  void showState() {
    const bool isWorking = m_rules->isReading();
    const bool hasRules = !m_rules->rules().empty();
    m_again->setText(isWorking ? QStringLiteral("Cancel") : QStringLiteral("Check again"));
    m_again->setToolTip(isWorking ? QString()
                                  : QStringLiteral("Reads the file again and checks its rules"));
    m_again->setEnabled(!m_rules->path().isEmpty());
    m_progress->setVisible(isWorking);
    m_progress->setValue(static_cast<int>(std::lround(100.0 * m_rules->progress())));
    m_state->setText(stateText());
    m_state->setToolTip(m_rules->path());
    m_filter->setEnabled(hasRules);
    m_save->setEnabled(!m_rules->broken().empty());
    m_table->setVisible(hasRules);
    m_table->setColumnHidden(RuleWatch::Session, !m_rules->isComparing());
    m_empty->setVisible(!hasRules);
    m_empty->setText(
        m_rules->path().isEmpty()
            ? QStringLiteral(
                  "A rule is a condition that must not hold, such as BELIEF_ERROR > 50 for 2 s. "
                  "Open a file with rules to see when they are broken: in a recording and those "
                  "that are compared with it, in Live and in a simulated match.")
            : QStringLiteral("This file has no rules that can be checked. Correct it, then press "
                             "Check again, or open another file."));
    const QString problems = shortListOf(m_rules->problems());
    if (std::exchange(m_said, problems) == problems) return;
    if (problems.isEmpty()) {
      m_message->clear();
    } else {
      m_message->showMessage(hasRules ? InPlaceMessage::Tone::Warning : InPlaceMessage::Tone::Error,
                             problems);
    }
  }

  RuleWatch* m_rules;
  ShownMoment* m_shown;
  QPushButton* m_open;
  QPushButton* m_again;
  QLineEdit* m_filter;
  QLabel* m_state;
  QProgressBar* m_progress;
  QPushButton* m_save;
  InPlaceMessage* m_message;
  QTableView* m_table;
  RulesFilter* m_sorted;
  QLabel* m_empty;
  QString m_said;
  bool m_followsEnd = true;
};

}  // namespace

QWidget* makeRulesDock(RuleWatch* rules, ShownMoment* shown, QWidget* parent) {
  return new RulesDock(rules, shown, parent);
}

void askForRules(RuleWatch* rules, QWidget* parent) {
  const QString path = askToOpen(parent, QStringLiteral("Open rules"),
                                 QStringLiteral("Rules (*.json);;All files (*)"));
  if (!path.isEmpty()) (void)rules->open(path);
}

}  // namespace pitchboard::ui
