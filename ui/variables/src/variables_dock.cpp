// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/beat.h>
#include <ui/variables/variables_dock.h>

#include <QApplication>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QSettings>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <set>

#include <ui/base/in_place_message.h>
#include <ui/base/plot_target.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>
#include <ui/sources/attached_boards.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>

#include "catalog_choice.h"
#include "value_writer.h"
#include "variables_filter.h"
#include "variables_header.h"
#include "variables_menu.h"
#include "variables_model.h"
#include "variables_view.h"

namespace pitchboard::ui {
namespace {

const QString favouritesKey = QStringLiteral("variables/favourites");
const QString headerKey = QStringLiteral("variables/header");

class VariablesDock : public QWidget {
 public:
  VariablesDock(const VariablesContext& context, QWidget* parent)
      : QWidget(parent),
        m_context(context),
        m_model(new VariablesModel(this)),
        m_filter(new VariablesFilter(m_model, this)),
        m_view(new VariablesView(m_model, m_filter, this)),
        m_message(new InPlaceMessage(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyVariables"))),
        m_writer(new ValueWriter(context.controller, m_model, m_message, this)) {
    m_model->setObjectName(QStringLiteral("variablesModel"));
    m_catalog = new CatalogChoice(context.controller, context.settings, m_message, this);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(makeTools());
    column->addWidget(m_message);
    m_view->setMinimumHeight(scaled(this, 38));  // below the field it leaves room for that
    column->addWidget(m_view, 1);
    column->addWidget(m_empty, 1);
    connect(m_view->header(), &QHeaderView::sortIndicatorChanged, this, [this] {
      if (m_filter->sortsByNumbers()) m_filter->update();
    });
    connectView();
    adoptSettings();
    connect(context.shown, &FrameSource::restarted, this, [this] { adoptSource(); });
    connect(context.shown, &ShownMoment::sourceChosen, this, [this] { adoptSource(); });
    connect(context.controller->edits(), &MatchEdits::lockedChanged, this,
            [this] { allowEditing(m_lock->isChecked()); });
    if (context.selection != nullptr) {
      connect(context.selection, &RobotSelection::blackboardRequested, this,
              [this](RobotUid robot) { showBlackboard(robot); });
    }
    constexpr Beat::Milliseconds least{100}, most{500};
    m_refresh = Beat::display().add(
        this, least, [this] { poll(); }, most);
    connect(context.shown, &FrameSource::frameReceived, this, [this] { m_refresh->want(); });
    adoptSource();
  }

  ~VariablesDock() override {
    if (m_context.settings) {
      m_context.settings->setValue(headerKey,
                                   static_cast<VariablesHeader*>(m_view->header())->stateToKeep());
    }
  }

 protected:
  void showEvent(QShowEvent* event) override {
    QWidget::showEvent(event);
    poll();
  }

 private:
  QToolButton* makeButton(const char* name, const char* icon, const QString& tip) {
    auto* button = new QToolButton(this);
    button->setObjectName(QLatin1String(name));
    if (icon != nullptr) button->setIcon(themedIcon(QLatin1String(icon)));
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    return button;
  }

  QHBoxLayout* makeTools() {
    m_filterText = new QLineEdit(this);
    m_filterText->setObjectName(QStringLiteral("variablesFilter"));
    m_filterText->setPlaceholderText(QStringLiteral("Filter, e.g. ball dist"));
    m_filterText->setToolTip(
        QStringLiteral("Show rows that contain all words in robot, process, name or unit. "
                       "Enter selects the first, and Enter again plots it"));
    m_filterText->setClearButtonEnabled(true);
    m_filterText->addAction(themedIcon(QStringLiteral("view-filter")), QLineEdit::LeadingPosition);
    connect(m_filterText, &QLineEdit::textChanged, this, [this](const QString& text) {
      m_filter->setFilterText(text);
      filterChanged();
    });
    connect(m_filterText, &QLineEdit::returnPressed, m_view, &VariablesView::goToFirst);
    m_stars = makeButton("favouritesOnly", "starred-symbolic",
                         QStringLiteral("Show favourites only. Press * on a variable to add it."));
    m_stars->setCheckable(true);
    connect(m_stars, &QToolButton::toggled, this, [this](bool on) {
      m_filter->setFavouritesOnly(on);
      filterChanged();
    });
    m_changed = makeButton("changedOnly", nullptr, QString());
    m_changed->setText(QStringLiteral("Changed"));
    m_changed->setCheckable(true);
    connect(m_changed, &QToolButton::toggled, this, [this] { applyChanged(); });
    m_lock = makeButton("editValues", "object-locked", QString());
    m_lock->setCheckable(true);
    connect(m_lock, &QToolButton::toggled, this, [this](bool on) { allowEditing(on); });
    auto* more = makeButton("variablesMenu", "application-menu",
                            QStringLiteral("Columns, sampling, catalog, other blackboards"));
    m_menu = new VariablesMenu(m_context, m_view, m_filter, m_catalog, more);
    more->setMenu(m_menu);
    connect(m_menu, &VariablesMenu::changedWithinChosen, this, [this] {
      if (m_changed->isChecked())
        applyChanged();
      else
        m_changed->setChecked(true);
    });
    more->setPopupMode(QToolButton::InstantPopup);
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    row->addWidget(m_filterText, 1);
    for (QToolButton* button : {m_stars, m_changed, m_lock, more}) row->addWidget(button);
    return row;
  }

  void showMenu(QPoint at) {
    const QModelIndex index = m_filter->mapToSource(m_view->indexAt(at).siblingAtColumn(0));
    if (!index.isValid()) return;
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const QStringList names = m_view->selectedVariables();
    if (!names.isEmpty()) {
      menu->addAction(QStringLiteral("Plot"), this, [this, names] {
        if (m_context.plots) m_context.plots->plotVariables(names);
      });
      menu->addAction(QStringLiteral("Favourite"), m_view, &VariablesView::requestFavourites);
      menu->addAction(QStringLiteral("Copy"), m_view, &VariablesView::copySelection);
      menu->addAction(QStringLiteral("Edit value"), m_view, &VariablesView::editCurrent);
    }
    const auto group = m_model->groupOf(index);
    for (const link::AttachedStatus& board : boards()) {
      const int key = board.board.key;
      if (keyOf(group->info()) != key) continue;
      const QString name = QString::fromStdString(group->info().name);
      menu->addAction(QStringLiteral("Detach %1").arg(name), this, [this, key, name] {
        m_context.boards->detach(key);
        m_model->setNote(name, {QStringLiteral("detached"), {}, 0.0});
      });
    }
    if (menu->isEmpty())
      delete menu;
    else
      menu->popup(m_view->viewport()->mapToGlobal(at));
  }

  std::vector<link::AttachedStatus> boards() const {
    if (m_context.boards == nullptr || !m_context.shown->kind().hasPresent) return {};
    return m_context.boards->list().empty() ? std::vector<link::AttachedStatus>()
                                            : m_context.boards->status();
  }

  /// The System V key of an attached blackboard's group; 0: it is another group.
  static int keyOf(const telemetry::GroupInfo& group) {
    return factsOf(group).attached ? factsOf(group).boardKey.value_or(0) : 0;
  }

  /// Notes beside the groups of attached blackboards, and a message when one was removed.
  void describeBoards() {
    for (const link::AttachedStatus& status : boards()) {
      if (status.attached) {
        m_attached.insert(status.board.key);
      } else if (m_attached.erase(status.board.key) != 0) {
        m_message->showMessage(InPlaceMessage::Tone::Warning,
                               QString::fromStdString(status.problem));
      }
      for (int row = 0; row < m_model->rowCount(); ++row) {
        const auto group = m_model->groupOf(m_model->index(row, 0));
        if (keyOf(group->info()) != status.board.key) continue;
        m_model->setNote(
            QString::fromStdString(group->info().name),
            {status.attached ? QString() : QStringLiteral("removed, waiting"),
             status.missed == 0 ? QString()
                                : QStringLiteral("The computer was busy and missed %1 samples.")
                                      .arg(status.missed),
             status.attached ? status.rate : 0.0});
      }
    }
  }

  void connectView() {
    m_view->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(m_view, &QWidget::customContextMenuRequested, this,
            [this](QPoint at) { showMenu(at); });
    connect(m_view, &VariablesView::plotRequested, this, [this](const QStringList& names) {
      if (m_context.plots) m_context.plots->plotVariables(names);
    });
    connect(m_view, &VariablesView::favouriteRequested, m_model, &VariablesModel::toggleFavourites);
    connect(m_view, &VariablesView::editRefused, this, [this](const QModelIndex& index) {
      const QString why = m_model->whyNotEditable(index);
      if (!why.isEmpty())
        m_message->showMessage(InPlaceMessage::Tone::Note, why);
      else
        m_message->showMessage(InPlaceMessage::Tone::Note,
                               QStringLiteral("Editing is off to prevent accidents."),
                               QStringLiteral("Edit values"), [this] { m_lock->setChecked(true); });
    });
    connect(m_model, &VariablesModel::favouritesChanged, this, [this] {
      if (m_context.settings) m_context.settings->setValue(favouritesKey, m_model->favourites());
      m_view->viewport()->update();
      filterChanged();
    });
  }

  void adoptSettings() {
    allowEditing(false);
    if (const QSettings* settings = m_context.settings) {
      m_model->setFavourites(settings->value(favouritesKey).toStringList());
      const QByteArray header = settings->value(headerKey).toByteArray();
      if (!header.isEmpty()) m_view->header()->restoreState(header);
      m_view->header()->setSortIndicator(-1, Qt::AscendingOrder);
    }
    applyChanged();
  }

  void adoptSource() {
    m_writer->forget();
    m_store = m_context.shown->series();
    m_model->setStore(m_store, m_context.shown->kind());
    const bool simulated = m_context.shown->kind().canBeEdited;
    m_lock->setEnabled(simulated);
    if (!simulated) m_lock->setChecked(false);
    allowEditing(m_lock->isChecked());
    poll();
  }

  void allowEditing(bool on) {
    const bool past = m_context.controller->edits()->isLocked();
    on = on && !past;
    m_model->setEditingAllowed(on);
    m_lock->setEnabled(m_context.shown->kind().canBeEdited && !past);
    m_lock->setIcon(
        themedIcon(on ? QStringLiteral("object-unlocked") : QStringLiteral("object-locked")));
    const QString why = QString::fromUtf8(m_context.shown->kind().whyNotEditable);
    m_lock->setToolTip(
        !why.isEmpty() ? why
        : past         ? QStringLiteral("You are viewing the past. Press Now to edit values.")
                       : QStringLiteral(
                             "Edit values: double-click a value of a simulated robot to change it"));
    m_lock->setAccessibleName(QStringLiteral("Edit values"));
  }

  /// The variables of one robot, in front of everything, and where others find them.
  void showBlackboard(RobotUid uid) {
    const FramePtr frame = m_context.shown->frame();
    const link::RobotFrame* robot = frame ? frame->robot(uid) : nullptr;
    if (robot == nullptr) return;
    m_stars->setChecked(false);
    m_changed->setChecked(false);
    // With the slash B1 is not B11, too.
    m_filterText->setText(robotName(robot->identity) + QLatin1Char('/'));
    if (robot->boardKey)
      m_message->showMessage(InPlaceMessage::Tone::Note, whereText(*robot->boardKey));
    if (auto* dock = qobject_cast<QDockWidget*>(parentWidget())) {
      dock->show();
      dock->raise();
    }
  }

  static QString whereText(int key) {
    return key == 0 ? QStringLiteral(
                          "This blackboard is in the studio's own memory, so other programs cannot "
                          "open it. To share it, use Simulation > Run robot processes.")
                    : QStringLiteral(
                          "System V shared memory, key %1, 2048 bytes. In a terminal: "
                          "pitchboard-cli blackboard watch --key %1")
                          .arg(key);
  }

  void applyChanged() {
    const bool on = m_changed->isChecked();
    const int seconds = m_menu->changedWithin();
    m_changed->setToolTip(
        seconds == 1 ? QStringLiteral("Only what changed within the last second")
                     : QStringLiteral("Only what changed within the last %1 s").arg(seconds));
    m_filter->setChangedWithin(on ? std::optional<double>(seconds) : std::nullopt);
    filterChanged();
  }

  void filterChanged() {
    m_view->followFilter();
    refresh();
  }

  void poll() {
    // The source's rows may begin without a restart.
    if (m_context.shown->series() != m_store) {
      adoptSource();
      return;
    }
    m_writer->check();
    if (!isVisible()) return;
    m_model->setMoment(m_context.shown->chosenTime());
    m_model->updateGroups();
    describeBoards();
    m_model->refreshSet(m_view->rowsInSight());
    constexpr int filterMilliseconds = 450;
    const bool busy = m_view->isEditing() || QApplication::mouseButtons() != Qt::NoButton;
    if (!busy && (!m_filtered.isValid() || m_filtered.elapsed() >= filterMilliseconds)) {
      m_filtered.start();
      m_filter->update();
    }
    // A line of some seconds hardly moves in a tenth of one.
    constexpr int sparkMilliseconds = 190;
    const bool sparks = !m_sparks.isValid() || m_sparks.elapsed() >= sparkMilliseconds;
    refresh(sparks);
  }

  void refresh(bool sparks = true) {
    const bool any = m_filter->rowCount() > 0;
    m_view->setVisible(any);
    m_empty->setVisible(!any);
    if (any) {
      if (sparks) m_sparks.start();
      m_model->refresh(m_view->rowsInSight(), sparks ? m_view->sparkPixels() : 0);
      m_view->fitNumbers();
    } else {
      m_empty->setText(emptyText());
    }
  }

  QString emptyText() const {
    if (m_model->rowCount() == 0) {
      const QString why = m_context.shown->frame() ? QString() : m_context.shown->emptyText();
      return why.isEmpty()
                 ? QStringLiteral("No variables yet. They appear with the first values of a robot.")
                 : why;
    }
    if (!m_filterText->text().trimmed().isEmpty()) return QStringLiteral("No matching variables.");
    if (m_stars->isChecked() && m_model->favourites().isEmpty()) {
      return QStringLiteral("No favourites yet. Select a variable and press * to add it.");
    }
    if (m_changed->isChecked()) {
      return QStringLiteral("Nothing changed within the last %1 s.").arg(m_menu->changedWithin());
    }
    return QStringLiteral("This match has none of your favourites.");
  }

  VariablesContext m_context;
  VariablesModel* m_model;
  VariablesFilter* m_filter;
  VariablesView* m_view;
  InPlaceMessage* m_message;
  QLabel* m_empty;
  std::unique_ptr<Beat::Part> m_refresh;
  QElapsedTimer m_filtered, m_sparks;  // since they were renewed
  ValueWriter* m_writer;
  CatalogChoice* m_catalog = nullptr;
  VariablesMenu* m_menu = nullptr;
  QLineEdit* m_filterText = nullptr;
  QToolButton *m_stars = nullptr, *m_changed = nullptr, *m_lock = nullptr;
  std::shared_ptr<const telemetry::SeriesStore> m_store;
  std::set<int> m_attached;  // keys of blackboards that could be read
};

}  // namespace

QWidget* makeVariablesDock(const VariablesContext& context, QWidget* parent) {
  return new VariablesDock(context, parent);
}

}  // namespace pitchboard::ui
