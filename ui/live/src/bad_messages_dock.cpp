// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/beat.h>
#include <ui/live/bad_messages_dock.h>

#include <QLabel>
#include <QStackedWidget>
#include <QTableView>

#include <ui/base/table_style.h>
#include <ui/sources/live_controller.h>

#include "bad_messages_model.h"

namespace pitchboard::ui {
namespace {

class BadMessagesDock : public QStackedWidget {
 public:
  BadMessagesDock(LiveController* live, QWidget* parent)
      : QStackedWidget(parent),
        m_live(live),
        m_model(new BadMessagesModel(this)),
        m_table(new QTableView(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("noBadMessages"))) {
    constexpr Beat::Milliseconds most{500};
    m_model->setObjectName(QStringLiteral("badMessages"));
    m_table->setModel(m_model);
    styleTable(m_table);
    const int widths[] = {180, 230, 80};
    for (int column = 0; column < 3; ++column) {
      m_table->setColumnWidth(column, scaled(m_table, widths[column]));
    }
    addWidget(m_empty);
    addWidget(m_table);
    m_refresh = Beat::display().add(
        this, most, [this] { refresh(); }, most);
    refresh();
  }

 protected:
  void showEvent(QShowEvent* event) override {
    refresh();
    QStackedWidget::showEvent(event);
  }

 private:
  void refresh() {
    m_model->update(m_live->details());
    m_empty->setText(m_live->isListening()
                         ? QStringLiteral("No bad messages. Messages that cannot be decoded appear "
                                          "here with the reason and their text.")
                         : QStringLiteral("Live is not listening. Choose Live in the tool bar."));
    setCurrentWidget(m_model->rowCount() > 0 ? static_cast<QWidget*>(m_table) : m_empty);
  }

  LiveController* m_live;
  BadMessagesModel* m_model;
  QTableView* m_table;
  QLabel* m_empty;
  std::unique_ptr<Beat::Part> m_refresh;
};

}  // namespace

QWidget* makeBadMessagesDock(LiveController* live, QWidget* parent) {
  return new BadMessagesDock(live, parent);
}

}  // namespace pitchboard::ui
